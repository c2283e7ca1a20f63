"""`hitch live`: the page with knobs, in a browser."""

from __future__ import annotations

import sys
import threading
import webbrowser
from typing import Annotated

import typer

from overrun_hitch.parameters import HitchError


def live(
    open_: Annotated[bool, typer.Option("--open/--no-open", help="Open it in a browser.")] = True,
) -> int:
    """Serve the live page to this machine until Ctrl-C: knobs, the unit run at each of their values, linear theory."""
    from overrun_hitch.fmu import files
    from overrun_hitch.show.page_server import serve

    page = files.LIVE_PAGE
    if not page.is_file():
        raise HitchError(f"{page} is not there; `make web` makes it in a clone of the repository, where Node is")
    if not files.is_current(page):
        print(f"hint: {page} is older than what it is made of; `make web` makes it anew", file=sys.stderr)
    try:
        serve(page.read_bytes(), lambda address: _show(address, open_))
    except KeyboardInterrupt:  # how it is meant to end
        return 0
    return 0


def _show(address: str, in_browser: bool) -> None:
    print(f"the live page is at {address} (Ctrl-C ends it)", flush=True)
    if in_browser:  # beside the server: a browser in the terminal returns only when it is left
        threading.Thread(target=_open, args=(address,), daemon=True).start()


def _open(address: str) -> None:
    if not webbrowser.open(address):
        print("hint: no browser could be opened; open the address in one", file=sys.stderr)
