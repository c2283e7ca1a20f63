"""FMU files unpacked while they are needed, after a look at whether that is harmless and whether they can run here."""

from __future__ import annotations

import stat
import tempfile
import zipfile
import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path, PureWindowsPath
from typing import Any

import fmpy

from overrun_hitch.fmu.messages import one_line
from overrun_hitch.fmu.settings import Use
from overrun_hitch.parameters import HitchError

# What an archive may hold: far more than an FMU needs, far less than harms. Ours for five systems unpacks to 3 MB.
MOST_ENTRIES = 10_000
DEEPEST = 32  # folders
LARGEST = 2**30  # bytes, unpacked
HIGHEST_RATIO = 200  # of unpacked to packed; binaries have 2 to 10, and a deflated bomb 1000
SMALL = 2**24  # bytes: below, the ratio harms nobody
PIECE = 2**20  # bytes read at once
DESCRIPTION = "modelDescription.xml"
REFERENCE_RESULTS = "org.fmi-standard.fmi-ls-ref"  # the folder of that layered standard, under extra
UNWRITABLE = "the working directory's name has letters that this locale cannot write; allowed: UTF-8, as LC_ALL=C.UTF-8"

_last_read: dict[bytes, Any] = {}  # content, and what fmpy made of it


def co_simulation_2(fmu: Path, description: Any, names: list[str]) -> None:
    """HitchError for anything but an FMI 2.0 unit for co-simulation with a library for this machine."""
    if description.fmiVersion != "2.0" or description.coSimulation is None:
        raise HitchError(f"{fmu} has FMI {description.fmiVersion}: an FMI 2.0 unit for co-simulation is needed")
    check_library(fmu, description, names, "cs")


def check_library(fmu: Path, description: Any, names: list[str], use: Use) -> None:
    """HitchError for a unit that has no library for this use on this machine."""
    part = description.coSimulation if use == "cs" else description.modelExchange
    library = f"{part.modelIdentifier}{fmpy.sharedLibraryExtension}"
    machine = fmpy.platform if description.fmiVersion == "2.0" else fmpy.platform_tuple
    place = f"binaries/{machine}/"
    if f"{place}{library}" not in names:
        others = [
            name.removeprefix(place)
            for name in names
            if name.startswith(place) and name.endswith(fmpy.sharedLibraryExtension)
        ]
        if others:
            raise HitchError(f"{fmu} has no {library}, the library of its modelIdentifier; it has {', '.join(others)}")
        there = sorted({name.split("/")[1] for name in names if name.startswith("binaries/") and name.count("/") == 2})
        raise HitchError(f"{fmu} has no {library} for {machine}; it has {', '.join(there) or 'no binaries'}")


def to_run(name: str) -> bool:
    """Whether an entry of an archive matters to who runs the FMU here: not sources, not other machines' binaries."""
    top, _, rest = name.partition("/")
    within = rest.partition("/")[0]
    if top in ("binaries", "extra"):
        return within in (fmpy.platform, fmpy.platform_tuple) if top == "binaries" else within != REFERENCE_RESULTS
    return top not in ("sources", "documentation")


def to_read(name: str) -> bool:
    """Whether an entry of an archive says what the FMU is."""
    return name == DESCRIPTION


@contextmanager
def unpacked(
    fmu: Path,
    check: Callable[[Path, Any, list[str]], object] = co_simulation_2,
    wanted: Callable[[str], bool] = to_run,
) -> Iterator[tuple[Any, str]]:
    """The model description of an FMU that this machine can run, and the folder it is unpacked in while needed.

    `check` looks at the file, its description and the names in it first, and raises HitchError. Of the entries those
    that are `wanted` are unpacked.
    """
    if not fmu.is_file():
        raise HitchError(f"{fmu} is not there: an FMU file is needed")
    with tempfile.TemporaryDirectory(prefix="hitch-") as folder:
        names = _extract(fmu, Path(folder), wanted)
        if DESCRIPTION not in names:
            raise HitchError(f"{fmu} is broken: it has no {DESCRIPTION}")
        try:
            description = _read(folder)
        except UnicodeEncodeError:  # lxml's, which puts a file's name after that of the working directory
            raise HitchError(UNWRITABLE) from None
        except Exception as error:  # fmpy raises bare Exception, and lxml its own
            raise HitchError(f"{fmu} is broken: {one_line(error)}") from None
        check(fmu, description, names)
        yield description, folder


def _read(folder: str) -> Any:
    """A model description; the one of last time, which takes as long as twenty runs, is not read again."""
    content = Path(folder, DESCRIPTION).read_bytes()
    if content not in _last_read:
        description = fmpy.read_model_description(folder)
        _last_read.clear()
        _last_read[content] = description
    return _last_read[content]


def _extract(fmu: Path, folder: Path, wanted: Callable[[str], bool]) -> list[str]:
    """Unpack what is wanted and return all names. HitchError for what is no archive, or not a harmless one."""
    try:
        with zipfile.ZipFile(fmu) as archive:
            entries = archive.infolist()
            _check_entries(fmu, entries)
            left = LARGEST
            for entry in entries:
                if wanted(entry.filename):
                    left -= _extract_one(archive, entry, folder, left)
                if left < 0:
                    raise _too_large(fmu)
    except zipfile.BadZipFile:
        raise HitchError(f"{fmu} is broken: an FMU is a zip archive") from None
    except OSError as error:
        raise HitchError(f"{fmu} cannot be unpacked: {error.strerror or one_line(error)}") from None
    except (EOFError, RuntimeError, zlib.error) as error:  # cut off, encrypted, packed in an unknown way, garbled
        raise HitchError(f"{fmu} is broken: {one_line(error)}") from None
    return [entry.filename for entry in entries]


def _check_entries(fmu: Path, entries: list[zipfile.ZipInfo]) -> None:
    """By what the archive says of itself."""
    if len(entries) > MOST_ENTRIES:
        raise HitchError(f"{fmu} is not unpacked: it has {len(entries)} entries; allowed: at most {MOST_ENTRIES}")
    for entry in entries:
        path = PureWindowsPath(entry.filename)  # which knows both slashes, and drives
        if path.anchor or ".." in path.parts or not path.parts:
            raise HitchError(f"{fmu} is not unpacked: {entry.filename!r:.80} would lie outside its folder")
        if stat.S_ISLNK(entry.external_attr >> 16):
            raise HitchError(f"{fmu} is not unpacked: {entry.filename!r:.80} is a link; allowed: files and folders")
        if len(path.parts) > DEEPEST:
            raise HitchError(
                f"{fmu} is not unpacked: {entry.filename!r:.80} lies in {len(path.parts) - 1} folders; "
                f"allowed: less than {DEEPEST}"
            )
    size, packed = (sum(getattr(entry, kind) for entry in entries) for kind in ("file_size", "compress_size"))
    if size > LARGEST:
        raise _too_large(fmu)
    if size > max(SMALL, HIGHEST_RATIO * packed):
        raise HitchError(
            f"{fmu} is not unpacked: it grows {size / max(packed, 1):.0f} times; allowed: at most {HIGHEST_RATIO} times"
        )


def _too_large(fmu: Path) -> HitchError:
    return HitchError(f"{fmu} is not unpacked: it holds more than {LARGEST / 2**20:g} MiB, which is the most allowed")


def _extract_one(archive: zipfile.ZipFile, entry: zipfile.ZipInfo, folder: Path, most: int) -> int:
    """The bytes written, little more than `most`: an archive may say less of itself than it holds."""
    target = folder / entry.filename
    if entry.is_dir():
        target.mkdir(parents=True, exist_ok=True)
        return 0
    target.parent.mkdir(parents=True, exist_ok=True)
    written = 0
    with archive.open(entry) as source, target.open("wb") as file:
        while written <= most and (piece := source.read(PIECE)):
            written += file.write(piece)
    return written
