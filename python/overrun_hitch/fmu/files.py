"""Where the FMU is, and making it where it is missing or older than what it is made of.

In a clone of the repository it is built from the Modelica library; a wheel brings it ready-made.
"""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

from overrun_hitch.parameters import HitchError

ROOT = Path(__file__).resolve().parents[3]
LIBRARY = ROOT / "modelica" / "OverrunHitch"
READY_MADE = Path(__file__).resolve().parents[1] / "fmus"  # put there by `make dist`
OURS = (ROOT / "build" if LIBRARY.is_dir() else READY_MADE) / "fmi2"  # a file there has the name of its class
NAMES = ("CarTrailer", "Car", "Trailer", "Hitch", "Bench")
CAR_TRAILER, CAR, TRAILER, HITCH, BENCH = (OURS / f"{name}.fmu" for name in NAMES)
GENERATOR = ROOT / "fmu_build"
SOURCES = {".mo", ".order", ".py", ".c", ".h"}


def is_current(fmu: Path = CAR_TRAILER) -> bool:
    """True if the FMU exists and nothing that it is made of is newer."""
    if not fmu.is_file():
        return False
    made = fmu.stat().st_mtime
    return all(source.stat().st_mtime <= made for source in _sources())


def build(fmu: Path = CAR_TRAILER) -> None:
    """Make the FMU from the class of its name in the Modelica library.

    HitchError with the generator's own line where it cannot be made.
    """
    if not LIBRARY.is_dir():
        raise HitchError(f"{LIBRARY} is not there, so {fmu.name} cannot be built; give a built one with --fmu")
    class_name = f"{LIBRARY.name}.Systems.{fmu.stem}"
    command = [sys.executable, "-m", "fmu_build", str(LIBRARY), class_name, "-o", str(fmu), "--fmi", "2"]
    search = os.pathsep.join(filter(None, [str(ROOT), os.environ.get("PYTHONPATH")]))
    done = subprocess.run(
        command, cwd=ROOT, env={**os.environ, "PYTHONPATH": search}, capture_output=True, text=True, check=False
    )
    if done.returncode != 0:
        # The generator says what the user can mend in its last line; what comes before a crash's last line is noise.
        lines = [line.strip() for line in done.stderr.splitlines() if line.strip()]
        raise HitchError(lines[-1] if lines else f"building {fmu.name} failed with exit status {done.returncode}")
    if not fmu.is_file():
        raise HitchError(f"building {fmu.name} left no file at {fmu}")


def _sources() -> Iterator[Path]:
    for folder in (LIBRARY, GENERATOR):
        yield from (path for path in folder.rglob("*") if path.suffix in SOURCES)
