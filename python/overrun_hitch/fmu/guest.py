"""A guest: a process of its own for code that is not ours, such as an FMU's.

It may crash, hang, print, or change what a process has one of: all that stays there, and two guests never meet. The
process is killed where it takes too long, and replaced at the next call.

Not multiprocessing, nor what is built on it: there a worker imports the caller's main module again, so every script
would need `if __name__ == "__main__"`; Dask's workers may have no children; and a worker that hangs outlives its host.
"""

from __future__ import annotations

import io
import math
import os
import pickle
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from contextlib import AbstractContextManager, suppress
from functools import cache
from pathlib import Path
from typing import Any

from overrun_hitch.fmu import guest_process
from overrun_hitch.parameters import HitchError
from overrun_hitch.threads import ONE_THREAD

START = 60.0  # s, at least, to get ready: Python starts, and a busy machine is not the FMU's fault
PATIENCE = 2.0  # s, for a guest to leave by itself
LOOK_EVERY = 0.25  # s, at most
PLACE = "HITCH_PLACE"  # in the environment of a guest: the file in which `tell` leaves its word
OURS = -1  # the place of work that takes as long as it takes


class GuestLost(HitchError):
    """The guest's process has ended in mid-call; the next call gets another."""


class GuestLate(GuestLost):
    """We have ended it, because it did not finish in time."""


class Guest:
    """A process in which the context manager `enter(*arguments)` is entered; calls are made on what it gives.

    All of it is pickled. The process starts at once and gets ready while the host goes on. `name` is for messages;
    `limit` is what a call may take, in s.
    """

    def __init__(
        self, name: str, limit: float, enter: Callable[..., AbstractContextManager[Any]], *arguments: Any
    ) -> None:
        self._name, self._limit, self._entry = name, limit, (enter, arguments)
        self._is_closed = False
        self.place = 0  # at which the last one was lost
        self._process: _Process | None = _Process(self._entry)

    def __enter__(self) -> Guest:
        return self

    def __exit__(self, kind: object, *_: object) -> None:
        self.close(patience=PATIENCE if kind is None else 0.0)

    def call(self, function: Callable[..., Any], *arguments: Any) -> Any:
        """`function(what was entered, *arguments)`, computed there. Raises what was raised there, and GuestLost."""
        process = self._process = self._process or _Process(self._entry)
        try:
            if self._is_closed:  # meanwhile, by another thread
                process.end(0.0)
                raise EOFError
            if not process.is_ready:
                process.reply(max(self._limit, START))
            process.send((function, arguments))
            return process.reply(self._limit)
        except (EOFError, BrokenPipeError, pickle.UnpicklingError):
            self.place = process.place()
            raise self._lost(process) from None
        finally:
            if not process.is_ready:
                process.end(0.0)
                self._process = None

    def _lost(self, process: _Process) -> HitchError:
        status = process.end(PATIENCE)
        if self._is_closed:
            return HitchError(f"{self._name}: its process has been closed")
        if process.is_late:
            return GuestLate(f"{self._name}: did not finish within {process.limit:g} s (--time-limit)")
        return GuestLost(f"{self._name}: {_ending(status)}")

    def close(self, patience: float = 0.0) -> None:
        """End the process, by force after `patience` s; any thread may, also while another waits in `call`."""
        self._is_closed = True
        process = self._process
        if process is not None:
            process.end(patience)


class _Process:
    """One life of a guest."""

    def __init__(self, entry: object) -> None:
        self.is_ready = False  # for the next request
        self.is_late = False
        self._folder = tempfile.mkdtemp(prefix="hitch-")
        self._place = Path(self._folder, "place")
        self.limit, self._deadline = 0.0, math.inf
        self._lock = threading.Lock()  # what the deadline is, and whether it has been killed
        self._is_killed = False
        self._is_over = threading.Event()
        try:
            self._popen = subprocess.Popen(
                [sys.executable, "-I", guest_process.__file__, str(os.getpid()), self._folder],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                start_new_session=True,  # out of reach of Ctrl-C and of the terminal
                env={**ONE_THREAD, **os.environ, "TMPDIR": self._folder, PLACE: str(self._place)},
            )
        except BaseException:
            shutil.rmtree(self._folder)
            raise
        threading.Thread(target=self._watch, daemon=True).start()
        with suppress(BrokenPipeError):  # the first reply will tell
            self.send(sys.path)
            self.send(entry)

    def send(self, what: object) -> None:
        """BrokenPipeError where nobody is there any more."""
        assert self._popen.stdin is not None
        self._popen.stdin.write(pickle.dumps(what, protocol=pickle.HIGHEST_PROTOCOL))
        self._popen.stdin.flush()

    def reply(self, limit: float) -> Any:
        """What comes next, within `limit` s. EOFError where nothing comes any more."""
        assert self._popen.stdout is not None
        with self._lock:
            self.limit, self._deadline = limit, time.monotonic() + limit
        try:
            self.is_ready = False
            value, error, self.is_ready = pickle.load(self._popen.stdout)
        finally:
            with self._lock:
                self._deadline = math.inf
        if error is not None:
            raise error
        return value

    def place(self) -> int:
        """What `tell` was told last there."""
        try:
            return int.from_bytes(self._place.read_bytes(), "little", signed=True)
        except OSError:
            return 0

    def end(self, patience: float) -> int:
        """End it, by force after `patience` s, remove what it has left, and return its exit status."""
        assert self._popen.stdin is not None and self._popen.stdout is not None
        if patience:
            with suppress(OSError):
                self._popen.stdin.close()
            with suppress(subprocess.TimeoutExpired):
                self._popen.wait(patience)
        self._kill()
        self._is_over.set()
        status = self._popen.wait()
        for pipe in (self._popen.stdin, self._popen.stdout):
            with suppress(OSError):
                pipe.close()
        shutil.rmtree(self._folder, ignore_errors=True)
        return status

    def _kill(self) -> None:
        """The process and those that it has made, once: later its number may be another's."""
        with self._lock:
            if not self._is_killed:
                self._is_killed = True
                with suppress(OSError):
                    os.killpg(self._popen.pid, signal.SIGKILL) if hasattr(os, "killpg") else self._popen.kill()

    def _watch(self) -> None:
        """Kill it when its time is over; where it tells its place, each has the whole time."""
        place = 0
        while not self._is_over.wait(min(LOOK_EVERY, max(0.01, 0.1 * self.limit))):
            now = self.place()
            with self._lock:
                if now != place and self._deadline < math.inf:
                    self._deadline = time.monotonic() + self.limit
                self.is_late = self._deadline < time.monotonic() and now != OURS
            place = now
            if self.is_late or self._popen.poll() is not None:  # then its children may hold our pipe open
                self._kill()
                return


def tell(place: int) -> None:
    """In a guest: what it is at, a number that outlives it; a change starts its time limit anew, OURS ends it."""
    file = _place_file()
    if file is not None:
        file.seek(0)
        file.write(place.to_bytes(8, "little", signed=True))


@cache
def _place_file() -> io.FileIO | None:
    """None in a process that is no guest."""
    path = os.environ.get(PLACE)
    return open(path, "wb", buffering=0) if path else None


def _ending(status: int) -> str:
    """In words."""
    if status < 0:
        return f"crashed: {(signal.strsignal(-status) or f'signal {-status}').lower()}"
    return f"crashed: it ended its process, with exit status {status}"
