"""How commands end where their output goes nowhere, or somebody presses Ctrl-C: one line at most, and never status 1,
which says that something differs."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TextIO

import pytest

import fmu_build.cli
from overrun_hitch import cli
from tests.kept import LIBRARY, ROOT

FULL = Path("/dev/full")  # where there is no room
NAMES = [command.callback.__name__ for command in cli.app.registered_commands if command.callback]
HELPS = [[], ["--help"], ["--version"], *([name, "--help"] for name in NAMES)]
COMMANDS: list[tuple[Callable[[list[str]], int], list[str]]] = [
    *((cli.main, help_) for help_ in HELPS),
    (cli.main, ["stability", "--C", "100", "--output", "out"]),
    (cli.main, ["stability", "--C", "0:3200:99", "--json", "--output", "out"]),  # more than a buffer
    (fmu_build.cli.main, ["--help"]),
    (fmu_build.cli.main, [str(LIBRARY), "OverrunHitch.Validation.TowBall", "--show", "c"]),
]
# The helps of commands are `full`.
ENDING = [
    pytest.param(*command, marks=[pytest.mark.full] if 3 <= n < len(HELPS) else [])
    for n, command in enumerate(COMMANDS)
]


@contextmanager
def nobody_reads() -> Iterator[TextIO]:
    reader, writer = os.pipe()
    os.close(reader)
    output = os.fdopen(writer, "w")
    try:
        yield output
    finally:
        with suppress(BrokenPipeError):  # what was left in the buffer
            output.close()


@pytest.mark.parametrize(("main", "arguments"), ENDING, ids=[" ".join(arguments[-3:]) for _, arguments in COMMANDS])
def test_output_that_arrives_nowhere(
    main: Callable[[list[str]], int],
    arguments: list[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    with monkeypatch.context() as patched, nobody_reads() as output:
        patched.setattr(sys, "stdout", output)
        assert main(arguments) == 141
    assert capsys.readouterr().err == ""
    if FULL.is_char_device():
        with monkeypatch.context() as patched, FULL.open("w") as output:
            patched.setattr(sys, "stdout", output)
            assert main(arguments) == 2
        assert re.fullmatch(r"\w+: standard output: No space left on device\n", capsys.readouterr().err)


@pytest.mark.parametrize("buffering", ["", pytest.param("1", marks=pytest.mark.full)])
@pytest.mark.parametrize("module", ["overrun_hitch", "fmu_build"])
def test_as_processes_of_their_own(module: str, buffering: str) -> None:
    """What Python itself does at the end adds neither a word nor another status."""
    command, environment = [sys.executable, "-m", module, "--help"], {**os.environ, "PYTHONUNBUFFERED": buffering}
    with nobody_reads() as output:
        done = subprocess.run(command, stdout=output, stderr=subprocess.PIPE, env=environment, cwd=ROOT, check=False)
    assert (done.returncode, done.stderr) == (141, b"")
    if FULL.is_char_device():
        with FULL.open("w") as output:  # for the message as well
            done = subprocess.run(command, stdout=output, stderr=output, env=environment, cwd=ROOT, check=False)
        assert done.returncode == 2


@pytest.mark.parametrize(
    ("arguments", "imported"),
    [
        (["overrun_hitch", "--help"], "typer"),
        pytest.param(["overrun_hitch", "stability"], "scipy", marks=pytest.mark.full),
        (["fmu_build", "--help"], "typer"),
    ],
)
def test_ctrl_c_while_it_imports(arguments: list[str], imported: str, tmp_path: Path) -> None:
    (tmp_path / f"{imported}.py").write_text("import os, signal\nos.kill(os.getpid(), signal.SIGINT)\n")
    search = [str(tmp_path), str(ROOT), str(ROOT / "python")]
    done = subprocess.run(
        [sys.executable, "-m", *arguments],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(search)},
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "")
