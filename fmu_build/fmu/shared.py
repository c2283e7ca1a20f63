"""One C file to shared libraries, compiled as units are: python -m fmu_build.fmu.shared FILE.c FOLDER [PLATFORMS]

PLATFORMS are names with commas between them, host or all. FOLDER gets a folder for each, named by its tuple after FMI 3
(x86_64-linux), and in it the library with the file's name.
"""

from __future__ import annotations

import os
import shutil
import sys
import tempfile
from pathlib import Path

from ..errors import BuildError
from .compile import compile_library, named_platforms


def build(source: Path, folder: Path, platforms: str = "host") -> None:
    """Compile it. A library appears whole, whoever else makes the same. BuildError as for units."""
    for platform in named_platforms(platforms.split(",")):
        library = folder / platform.name / f"{source.stem}{platform.suffix}"
        library.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix="shared-", dir=library.parent) as name:
            shutil.copy(source, name)
            made = Path(name, library.name)
            compile_library(Path(name), made, platform)
            os.replace(made, library)


if __name__ == "__main__":
    try:
        build(Path(sys.argv[1]), Path(sys.argv[2]), *sys.argv[3:4])
    except (BuildError, OSError) as error:
        sys.exit(f"fmu_build.fmu.shared: {error}")
