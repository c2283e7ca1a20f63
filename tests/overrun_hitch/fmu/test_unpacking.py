"""Archives that would harm: refused by name, in one line, with nothing written."""

from __future__ import annotations

import stat
import struct
import zipfile
from collections.abc import Callable
from pathlib import Path

import fmpy
import pytest

from overrun_hitch import cli
from overrun_hitch.fmu import unpacking
from overrun_hitch.fmu.unpacking import to_read, to_run, unpacked
from overrun_hitch.parameters import HitchError

Fill = Callable[[zipfile.ZipFile], object]


def packed(path: Path, fill: Fill) -> Path:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        fill(archive)
    return path


def link(archive: zipfile.ZipFile) -> None:
    entry = zipfile.ZipInfo("binaries/link")
    entry.external_attr = (stat.S_IFLNK | 0o777) << 16
    archive.writestr(entry, "/etc/passwd")


HARMFUL: dict[str, tuple[Fill, str]] = {
    "up": (lambda archive: archive.writestr("../up.txt", ""), "'../up.txt' would lie outside its folder"),
    "within": (lambda archive: archive.writestr("a/../../b", ""), "'a/../../b' would lie outside its folder"),
    "absolute": (lambda archive: archive.writestr("/tmp/a", ""), "'/tmp/a' would lie outside its folder"),
    "drive": (lambda archive: archive.writestr("C:/a", ""), "'C:/a' would lie outside its folder"),
    "backward": (lambda archive: archive.writestr("..\\a", ""), "would lie outside its folder"),
    "link": (link, "'binaries/link' is a link; allowed: files and folders"),
    "deep": (lambda archive: archive.writestr("d/" * 32 + "a", ""), "lies in 32 folders; allowed: less than 32"),
    "many": (
        lambda archive: [archive.writestr(f"{n}", "") for n in range(10_001)],
        "it has 10001 entries; allowed: at most 10000",
    ),
    "bomb": (lambda archive: archive.writestr("zeros", bytes(2**25)), "times; allowed: at most 200 times"),
}


@pytest.mark.parametrize("kind", HARMFUL)
def test_what_would_harm_is_refused(
    kind: str, tmp_path: Path, temporary: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    fill, words = HARMFUL[kind]
    fmu = packed(tmp_path / "bad.fmu", fill)
    with pytest.raises(HitchError, match=r"bad\.fmu is not unpacked: ") as caught, unpacked(fmu):
        pass
    assert str(caught.value).endswith(words)
    assert {path.name for path in tmp_path.rglob("*")} == {"bad.fmu", "temporary"}
    if kind in ("up", "bomb"):  # by command, too; it has a process of its own
        assert cli.main(["run", "--fmu", str(fmu), "--output", str(tmp_path / "out")]) == 2
        assert capsys.readouterr().err == f"hitch: {caught.value}\n"
        assert {path.name for path in tmp_path.rglob("*")} == {"bad.fmu", "temporary"}


def test_an_archive_that_says_less_than_it_holds(
    tmp_path: Path, temporary: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By its directory each entry is small; what comes out is counted."""
    monkeypatch.setattr(unpacking, "LARGEST", 1000)
    fmu = packed(tmp_path / "large.fmu", lambda archive: archive.writestr("a", bytes(1001)))
    with pytest.raises(HitchError, match=r"it holds more than .* MiB, which is the most allowed"), unpacked(fmu):
        pass
    content = fmu.read_bytes()
    assert content.count(struct.pack("<I", 1001)) == 2  # in the entry's own header and in the directory
    fmu.write_bytes(content.replace(struct.pack("<I", 1001), struct.pack("<I", 10)))
    with pytest.raises(HitchError, match=r"large\.fmu is "), unpacked(fmu):
        pass
    assert list(temporary.iterdir()) == []


def test_a_full_disk_is_not_the_fmus_fault(
    car_trailer_fmu: Path, temporary: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> int:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(unpacking, "_extract_one", full)
    with (
        pytest.raises(HitchError, match=r"cannot be unpacked: No space left"),
        unpacked(car_trailer_fmu),
    ):
        pass
    assert list(temporary.iterdir()) == []


@pytest.mark.parametrize("wanted", [to_run, to_read])
def test_only_what_is_needed_is_unpacked(wanted: Callable[[str], bool], tmp_path: Path, car_trailer_fmu: Path) -> None:
    """All else may lie anywhere, beside the library say, and is."""
    fmu = tmp_path / "unit.fmu"
    fmu.write_bytes(car_trailer_fmu.read_bytes())
    left = {"sources/a.c", "documentation/a.html", "binaries/riscv64-linux/a.so"}
    left |= {"extra/org.fmi-standard.fmi-ls-ref/a.csv"}
    kept = {"resources/a.bin", "extra/a.csv", "a.txt", f"binaries/{fmpy.platform}/a.so"}
    with zipfile.ZipFile(fmu, "a") as archive:
        for name in (*left, *kept):
            archive.writestr(name, "")
    with unpacked(fmu, wanted=wanted) as (_, folder):
        there = {path.relative_to(folder).as_posix() for path in Path(folder).rglob("*") if path.is_file()}
    assert there == {"modelDescription.xml"} if wanted is to_read else kept < there and not left & there
