"""The libraries of an FMU: its sources, compiled for each platform."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from .compile import Platform, compile_library
from .contents import SOURCES
from .fat_mach_o import universal


def binaries(
    files: Mapping[str, bytes],
    identifier: str,
    platforms: Sequence[Platform],
    fmi: int,
    progress: Callable[[str], object],
) -> dict[str, bytes]:
    """The libraries of the sources in ``files``, by their path in the FMU; those for macOS are one for all processors.

    ``progress`` is told of each platform that begins. Raises BuildError where the compiler fails or is missing.
    """
    libraries: dict[str, list[bytes]] = {}
    with tempfile.TemporaryDirectory(prefix="fmu_build-") as folder:
        work = Path(folder)
        for name, content in files.items():
            if name.startswith(SOURCES):
                place = work / name.removeprefix(SOURCES)
                place.parent.mkdir(exist_ok=True)
                place.write_bytes(content)
        for platform in platforms:
            progress(f"compiling for {platform.name}")
            library = work / f"{identifier}{platform.suffix}"
            compile_library(work, library, platform)
            binary = platform.fmi2_folder if fmi == 2 else platform.fmi3_folder
            libraries.setdefault(f"binaries/{binary}/{library.name}", []).append(library.read_bytes())
    return {place: universal(same) for place, same in libraries.items()}
