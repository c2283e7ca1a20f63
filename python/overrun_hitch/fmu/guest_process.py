"""What runs in a guest's process (see guest.py): requests from stdin, replies to stdout, whatever the code there does.

Started by its path, so that nothing but the standard library is needed before the host has told where packages are.
"""

from __future__ import annotations

import os
import pickle
import shutil
import signal
import sys
import threading
import time
import traceback
from typing import Any, BinaryIO

LOOK_EVERY = 0.5  # s, for a host that has died


def serve(host: int, folder: str) -> None:
    """Serve the process `host` until it closes stdin or dies, and leave nothing in `folder`."""
    requests, replies = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    nowhere = os.open(os.devnull, os.O_RDWR)
    for standard in (0, 1, 2):  # code here may print as it likes
        os.dup2(nowhere, standard)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the host decides when to stop
    threading.Thread(target=_end_with, args=(host, folder), daemon=True).start()
    try:
        sys.path[:] = pickle.load(requests)
        _answer(requests, replies)
    except (EOFError, BrokenPipeError):
        shutil.rmtree(folder, ignore_errors=True)
    os._exit(0)  # what is loaded is not trusted to be taken down in order


def _answer(requests: BinaryIO, replies: BinaryIO) -> None:
    from overrun_hitch.parameters import HitchError

    try:
        enter, arguments = pickle.load(requests)
        with enter(*arguments) as resident:
            _reply(replies, None)
            while True:
                function, arguments = pickle.load(requests)
                try:
                    _reply(replies, function(resident, *arguments))
                except HitchError as error:  # after which it goes on
                    _reply(replies, None, error)
    except (EOFError, BrokenPipeError):
        raise
    except HitchError as error:
        _reply(replies, None, error, goes_on=False)
    except BaseException:
        _reply(replies, None, RuntimeError(traceback.format_exc()), goes_on=False)


def _reply(replies: BinaryIO, value: Any, error: Exception | None = None, goes_on: bool = True) -> None:
    replies.write(pickle.dumps((value, error, goes_on), protocol=pickle.HIGHEST_PROTOCOL))
    replies.flush()


def _end_with(host: int, folder: str) -> None:
    """End this process, and those that it has made, soon after the host; also out of code that never returns."""
    while os.getppid() == host:
        time.sleep(LOOK_EVERY)
    shutil.rmtree(folder, ignore_errors=True)
    os.killpg(0, signal.SIGKILL)


if __name__ == "__main__":
    serve(int(sys.argv[1]), sys.argv[2])
