"""Where the FMU is, and making it where it is missing or older than what it is made of; where the live page is.

In a clone of the repository it is built from the Modelica library; a wheel brings it ready-made.
"""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

from overrun_hitch.parameters import HitchError, unknown

ROOT = Path(__file__).resolve().parents[3]
LIBRARY = ROOT / "modelica" / "OverrunHitch"
READY_MADE = Path(__file__).resolve().parents[1] / "fmus"  # put there by `make dist`
BUILT = ROOT / "build" if LIBRARY.is_dir() else READY_MADE
LIVE_PAGE = BUILT / "live" / "index.html"  # `make web`, where Node is
NAMES = ("CarTrailer", "Car", "Trailer", "Hitch", "Bench")  # of classes, and of their files
VERSIONS = (2, 3)  # of FMI
GENERATOR = ROOT / "fmu_build"
SAMPLER = Path(__file__).with_name("sampler.c")
SOURCES = {".mo", ".order", ".py", ".c", ".h"}


def place(name: str, fmi: int = 2) -> Path:
    """Where our FMU of this name is, or will be once it is built. HitchError for a name or a version that is not."""
    if name not in NAMES:
        raise HitchError(unknown("FMU of ours", name, NAMES))
    if fmi not in VERSIONS:
        raise HitchError(f"fmi = {fmi!r:.40} is not allowed; allowed: {' or '.join(map(str, VERSIONS))}")
    return BUILT / f"fmi{fmi}" / f"{name}.fmu"


CAR_TRAILER, CAR, TRAILER, HITCH, BENCH = (place(name) for name in NAMES)


def is_current(fmu: Path = CAR_TRAILER) -> bool:
    """True if the FMU exists and nothing that it is made of is newer."""
    if not fmu.is_file():
        return False
    made = fmu.stat().st_mtime
    return all(source.stat().st_mtime <= made for source in _sources())


def build(fmu: Path = CAR_TRAILER) -> None:
    """Make the FMU from the class of its name in the Modelica library, of the FMI version that its folder tells.

    HitchError with the generator's own line where it cannot be made.
    """
    if not LIBRARY.is_dir():
        raise HitchError(f"{LIBRARY} is not there, so {fmu.name} cannot be built; give a built one with --fmu")
    class_name = f"{LIBRARY.name}.Systems.{fmu.stem}"
    done = _generator("fmu_build", str(LIBRARY), class_name, "-o", str(fmu), "--fmi", fmu.parent.name[-1])
    if done.returncode != 0:
        # The generator says what the user can mend in its last line; what comes before a crash's last line is noise.
        lines = [line.strip() for line in done.stderr.splitlines() if line.strip()]
        raise HitchError(lines[-1] if lines else f"building {fmu.name} failed with exit status {done.returncode}")
    if not fmu.is_file():
        raise HitchError(f"building {fmu.name} left no file at {fmu}")


def sampler_library(machine: str, suffix: str) -> Path | None:
    """The compiled loop of sampler.py for a machine, by its tuple after FMI 3; None where it is not.

    In a clone it is made for this one, where there is a compiler.
    """
    library = BUILT / "sampler" / machine / f"{SAMPLER.stem}{suffix}"
    if LIBRARY.is_dir() and not (library.is_file() and SAMPLER.stat().st_mtime <= library.stat().st_mtime):
        _generator("fmu_build.fmu.shared", str(SAMPLER), str(BUILT / "sampler"))
    return library if library.is_file() else None


def siblings(fmu: Path) -> list[Path]:
    """The FMU, and that of the other version of FMI beside it, in fmi2 and fmi3, where it is there."""
    others = [fmu.parent.with_name(folder) / fmu.name for folder in ("fmi2", "fmi3")]
    return [fmu, *(other for other in others if other != fmu and other.is_file())]


def _generator(module: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    """A module of the generator's, run with this Python on what the clone holds."""
    search = os.pathsep.join(filter(None, [str(ROOT), os.environ.get("PYTHONPATH")]))
    environment = {**os.environ, "PYTHONPATH": search}
    command = [sys.executable, "-m", module, *arguments]
    return subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)


def _sources() -> Iterator[Path]:
    for folder in (LIBRARY, GENERATOR):
        yield from (path for path in folder.rglob("*") if path.suffix in SOURCES)
