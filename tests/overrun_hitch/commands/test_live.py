"""`hitch live`: one page, from loopback, until Ctrl-C; nothing is left."""

from __future__ import annotations

import os
import re
import signal
import socket
import subprocess
import sys
import urllib.error
import urllib.request
import webbrowser
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from urllib.parse import urlsplit

import pytest

from overrun_hitch.cli import main
from overrun_hitch.fmu import files

PAGE = "<!doctype html><title>A page</title>\u00e9".encode()


@pytest.fixture
def page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    path = tmp_path / "index.html"
    path.write_bytes(PAGE)
    monkeypatch.setattr(files, "LIVE_PAGE", path)
    return path


SERVE = """
import sys
from overrun_hitch.show.page_server import serve
serve(sys.stdin.buffer.read(), lambda address: print(address, flush=True))
"""


@contextmanager
def served(page: Path) -> Iterator[str]:
    """The address of a page that another process serves meanwhile, and then is interrupted."""
    command = [sys.executable, "-c", SERVE]
    with page.open("rb") as content, subprocess.Popen(
        command, stdin=content, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=page.parent
    ) as process:  # fmt: skip
        assert process.stdout
        try:
            yield process.stdout.readline().strip()
        finally:
            process.send_signal(signal.SIGINT)
            assert "KeyboardInterrupt" in process.communicate(timeout=10)[1]


def test_it_serves_the_page_and_nothing_else_to_this_machine_alone(page: Path) -> None:
    with served(page) as address:
        parts = urlsplit(address)
        assert (parts.scheme, parts.hostname, parts.path) == ("http", "127.0.0.1", "/")
        with urllib.request.urlopen(address, timeout=10) as answer:
            assert answer.read() == PAGE and answer.headers["Content-Type"] == "text/html; charset=utf-8"
        for other in (page.name, "..%2f..%2fetc/passwd", f"../{page.name}"):
            with pytest.raises(urllib.error.HTTPError, match="404"):
                urllib.request.urlopen(f"{address}{other}", timeout=10)
    with pytest.raises(OSError), socket.create_connection(("127.0.0.1", parts.port or 0), timeout=10):
        pass
    assert list(page.parent.iterdir()) == [page]


def test_the_command_says_the_address_opens_it_and_ends_well(
    page: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def opened(address: str) -> bool:
        with urllib.request.urlopen(address, timeout=10) as answer:
            assert answer.read() == PAGE
        os.kill(os.getpid(), signal.SIGINT)
        return True

    monkeypatch.setattr(webbrowser, "open", opened)
    assert main(["live"]) == 0
    told = capsys.readouterr()
    assert told.out.startswith("the live page is at http://127.0.0.1:") and "Ctrl-C" in told.out


def test_no_page_and_no_browser_cost_a_line_each(
    page: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def no_browser(address: str) -> bool:
        os.kill(os.getpid(), signal.SIGINT)
        return False

    monkeypatch.setattr(webbrowser, "open", no_browser)
    assert main(["live"]) == 0
    page.unlink()
    assert main(["live"]) == 2
    *_, line = capsys.readouterr().err.splitlines()
    assert re.fullmatch(r"hitch: \S+ is not there; `make web` makes it .*", line)


def test_an_old_page_is_told(page: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    os.utime(page, (0, 0))
    monkeypatch.setattr("overrun_hitch.show.page_server.serve", lambda *_: None)
    assert main(["live", "--no-open"]) == 0
    assert "older" in capsys.readouterr().err
