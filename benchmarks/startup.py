"""CPU time of short commands from the shell, guests included, and what that of `hitch run` goes into.

`python -m benchmarks.startup` prints both tables: the least of ROUNDS in which each had its turn.
"""

from __future__ import annotations

import os
import resource
import subprocess
import sys
import tempfile
from itertools import pairwise
from pathlib import Path

from overrun_hitch.fmu.files import CAR_TRAILER, build, is_current
from overrun_hitch.threads import ONE_THREAD

ROUNDS = 7
COMMANDS = (["--help"], ["cases"], ["stability"], ["run"])
# What `hitch run` loads, each behind those before.
LOADED = {
    "Python": "pass",
    "the command line: Typer, pydantic": "import overrun_hitch.cli",
    "numpy": "import numpy",
    "Rich": "import rich.console, rich.progress, rich.table",
    "SciPy's optimize, for the fit": "import scipy.optimize",
    "matplotlib": "import matplotlib.figure, matplotlib.backends.backend_agg, matplotlib.backends.backend_svg",
}
GUEST = "import overrun_hitch.experiments.drive, overrun_hitch.fmu.opening"


def cpu_time(*arguments: str) -> float:
    """Seconds of a Python process, and of those that it has waited for."""
    before = _used()
    environment = {**ONE_THREAD, **os.environ}
    subprocess.run([sys.executable, *arguments], stdout=subprocess.DEVNULL, env=environment, check=True)
    return _used() - before


def _used() -> float:
    return sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])


def main() -> None:
    """Print the tables."""
    if not is_current(CAR_TRAILER):
        build(CAR_TRAILER)
    steps = ["\n".join(list(LOADED.values())[: n + 1]) for n in range(len(LOADED))]
    asked = [["-c", code] for code in (*steps, GUEST)]
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        asked += [["-m", "overrun_hitch", *command] for command in COMMANDS]
        least = [min(times) for times in zip(*([cpu_time(*one) for one in asked] for _ in range(ROUNDS)), strict=True)]
        os.chdir(Path(__file__).parent)
    *loaded, guest = least[: -len(COMMANDS)]
    commands = least[-len(COMMANDS) :]
    print("| command | CPU time |\n|---|---|")
    for command, seconds in zip(COMMANDS, commands, strict=True):
        print(f"| `hitch {' '.join(command)}` | {seconds:.2f} s |")
    print("\n| of `hitch run` | CPU time |\n|---|---|")
    for name, (before, after) in zip(LOADED, pairwise([0.0, *loaded]), strict=True):
        print(f"| {name} | {after - before:.2f} s |")
    print(f"| the guest's own Python, numpy, pydantic, FMPy | {guest:.2f} s |")
    print(f"| two runs, the fit, two pictures | {commands[-1] - loaded[-1] - guest:.2f} s |")


if __name__ == "__main__":
    main()
