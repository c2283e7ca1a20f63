"""FMU files unpacked while they are needed, after a look at whether this machine can run them."""

from __future__ import annotations

import tempfile
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import fmpy

from overrun_hitch.fmu.messages import one_line
from overrun_hitch.parameters import HitchError

UNWRITABLE = "the working directory's name has letters that this locale cannot write; allowed: UTF-8, as LC_ALL=C.UTF-8"


@contextmanager
def unpacked(fmu: Path, within: Path | None = None) -> Iterator[tuple[Any, str]]:
    """The model description of an FMU that this machine can run, and the folder it is unpacked in while needed."""
    if not fmu.is_file():
        raise HitchError(f"{fmu} is not there: an FMU file is needed")
    with tempfile.TemporaryDirectory(prefix="hitch-", dir=within) as folder:
        try:
            description = fmpy.read_model_description(str(fmu))
            with zipfile.ZipFile(fmu) as archive:
                names = archive.namelist()
            fmpy.extract(str(fmu), unzipdir=folder)
        except zipfile.BadZipFile:
            raise HitchError(f"{fmu} is broken: an FMU is a zip archive") from None
        except KeyError:
            raise HitchError(f"{fmu} is broken: it has no modelDescription.xml") from None
        except UnicodeEncodeError:  # lxml's, which puts a file's name after that of the working directory
            raise HitchError(UNWRITABLE) from None
        except Exception as error:  # fmpy raises bare Exception, and lxml its own
            raise HitchError(f"{fmu} is broken: {one_line(error)}") from None
        _check_kind(fmu, description, names)
        yield description, folder


def _check_kind(fmu: Path, description: Any, names: list[str]) -> None:
    if description.fmiVersion != "2.0" or description.coSimulation is None:
        raise HitchError(f"{fmu} has FMI {description.fmiVersion}: an FMI 2.0 unit for co-simulation is needed")
    library = f"{description.coSimulation.modelIdentifier}{fmpy.sharedLibraryExtension}"
    place = f"binaries/{fmpy.platform}/"
    if f"{place}{library}" not in names:
        others = [
            name.removeprefix(place)
            for name in names
            if name.startswith(place) and name.endswith(fmpy.sharedLibraryExtension)
        ]
        if others:
            raise HitchError(f"{fmu} has no {library}, the library of its modelIdentifier; it has {', '.join(others)}")
        there = sorted({name.split("/")[1] for name in names if name.startswith("binaries/") and name.count("/") == 2})
        raise HitchError(f"{fmu} has no {library} for {fmpy.platform}; it has {', '.join(there) or 'no binaries'}")
