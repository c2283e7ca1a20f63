"""What `python -m fmu_build` is given from outside: places, compilers, names. One line that names what is wrong."""

from __future__ import annotations

import os
import shlex
import shutil
from pathlib import Path

import pytest

from fmu_build.cli import main
from fmu_build.errors import BuildError
from fmu_build.fmu import archive, compile
from fmu_build.fmu.compile import compiler
from tests.kept import LIBRARY

MODEL = "model Decay\n  Real x(start=1, fixed=true);\nequation\n  der(x) = -x;\nend Decay;\n"


@pytest.fixture
def decay(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A model in a folder whose name is nobody's favourite, which is the working directory."""
    folder = tmp_path / "\u00fcm \"l\" 'a' 100%20 $HOME;b"
    folder.mkdir()
    monkeypatch.chdir(folder)
    monkeypatch.setenv("CFLAGS", "-O0")
    (folder / "Decay.mo").write_text(MODEL, encoding="utf-8")
    return folder


def said(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    assert main(arguments) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.count("\n") == 1
    return err.removeprefix("fmu_build: ").rstrip("\n")


@pytest.mark.parametrize(
    ("output", "message"),
    [
        (".", ". is a folder; name the FMU to write, such as Model.fmu"),
        ("", ". is a folder; name the FMU to write, such as Model.fmu"),
        ("Decay.mo/a.fmu", "cannot write Decay.mo/a.fmu: {here}/Decay.mo is no folder"),
        (os.devnull, f"{os.devnull} is no file that could be replaced; name the FMU to write"),
    ],
)
def test_a_place_where_no_fmu_can_be(
    output: str, message: str, decay: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("CC", "nothing is compiled before that is known")
    assert said(["Decay.mo", "Decay", "-o", output], capsys) == message.format(here=decay)
    assert [path.name for path in decay.iterdir()] == ["Decay.mo"]


def test_a_disk_that_is_full_in_the_middle(
    decay: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(archive.os, "chmod", full)
    assert said(["Decay.mo", "Decay", "-o", "new/a.fmu"], capsys) == "cannot write new/a.fmu: No space left on device"
    assert list((decay / "new").iterdir()) == []


@pytest.mark.skipif(os.name == "nt", reason="a compiler by another name, by a link")
def test_compilers_as_people_name_them(decay: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A path with spaces; the same in quotes, with options; nothing, as for make."""
    there = decay / "my cc"
    there.symlink_to(str(shutil.which(compiler()[0])))
    for text, command in [
        (str(there), [str(there)]),
        (f"{shlex.quote(str(there))} -O0", [str(there), "-O0"]),
        ("", ["cc"] if shutil.which("cc") else compiler()),
    ]:
        monkeypatch.setenv("CC", text)
        assert compiler() == command
    monkeypatch.setenv("CC", str(there))
    assert main(["Decay.mo", "Decay", "-o", "a.fmu"]) == 0


@pytest.mark.skipif(shutil.which("true") is None, reason="there is no program that does nothing")
def test_no_compilers(decay: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    for text, message in [
        ("true", "true made no library: set CC to a C11 compiler"),
        ("false", "false failed: status 1"),
        (
            "no-such-cc -O1",
            "no C compiler: 'no-such-cc' was not found; install gcc or clang, or set CC to a C11 compiler",
        ),
        ("'cc", 'CC is "\'cc", which is no command: No closing quotation'),
    ]:
        monkeypatch.setenv("CC", text)
        assert said(["Decay.mo", "Decay", "-o", "a.fmu"], capsys) == message
    monkeypatch.delenv("CC")
    monkeypatch.setenv("CFLAGS", '"-O0')
    with pytest.raises(BuildError, match=r"^CFLAGS is "):
        compile._command(compile.host_platform(), "a.so")


@pytest.mark.full
def test_classes_that_were_meant(capsys: pytest.CaptureFixture[str]) -> None:
    for wrong, meant in [
        ("overrunhitch.systems.car", "OverrunHitch.Systems.Car"),
        ("CarTrailer", "OverrunHitch.Systems.CarTrailer"),
        ("OverrunHitch.Validation.SteadyBrakin", "OverrunHitch.Validation.SteadyBraking"),
        ("OverrunHitch.Examples.Figure6", "OverrunHitch.Examples.Figure6"),
    ]:
        message = said([str(LIBRARY), wrong, "--show", "flat"], capsys)
        assert f"no class {wrong} in it; did you mean {meant}" in message
    assert "did you mean" not in said([str(LIBRARY), "Xyz", "--show", "flat"], capsys)
