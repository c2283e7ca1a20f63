"""Measure FMUs of CarTrailer and Trailer; write results.md and its picture. `make bench`.

Exit status 1 where a requirement is missed: of times, their ratios are judged, measured side by side.
"""

from __future__ import annotations

import platform
import subprocess
import sys
import tempfile
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from threadpoolctl import threadpool_limits

from benchmarks import (
    comparison,
    fmu_contenders,
    many,
    rumoca_contenders,
    scipy_contenders,
    six_seconds,
    steps,
    sweep,
    work_precision,
)
from fmu_build.fmu.compile import compiler
from overrun_hitch.show.traces import rendered

HERE = Path(__file__).parent
PICTURE = "work-precision.svg"
PACKAGES = ("fmpy", "rumoca", "scipy", "numpy", "numba")
HEAD = """# Six seconds of figure 8

Written by `make bench`. {processor}, {system}; {compiler}; Python {python},
{packages}.
"""
DIAGRAM = f"""
Error against CPU time at relative tolerances from 1e-2 to 1e-10, two a decade; medians of {work_precision.ROUNDS}
rounds. The dotted line is where the table compares.

![Error of the compression against CPU time for each way, both axes logarithmic]({PICTURE})
"""


def processor() -> str:
    """The model of this machine's processor."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.processor() or platform.machine()
    return next((line.partition(":")[2].strip() for line in lines if line.startswith("model name")), platform.machine())


def head() -> str:
    """The machine, and versions."""
    made_by = subprocess.run([*compiler(), "--version"], capture_output=True, text=True, check=True).stdout
    return HEAD.format(
        processor=processor(),
        system=platform.system(),
        compiler=made_by.splitlines()[0],
        python=platform.python_version(),
        packages=", ".join(f"{package} {_version(package)}" for package in PACKAGES),
    )


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "not installed"


def main() -> int:
    """Measure, print and write; 1 where a requirement is missed."""
    fmu, trailer = map(Path, sys.argv[1:3])
    with tempfile.TemporaryDirectory(prefix="benchmark-") as name, threadpool_limits(1):
        folder = Path(name)
        with fmu_contenders.contenders(fmu, folder) as ours:
            rumoca = rumoca_contenders.Rumoca()
            contenders = [*ours, *rumoca.contenders(), *scipy_contenders.contenders()]
            against, faster = comparison.section(contenders, lambda: rumoca.preparation(comparison.DEFAULT))
            picture = rendered(work_precision.drawn(work_precision.measured(contenders)), "svg")
        in_c, within = six_seconds.section(fmu, folder)
        by_step = steps.section([fmu, trailer], folder)
    sweeps, cheap = sweep.section(fmu)
    text = "\n".join([head(), against, DIAGRAM.lstrip(), in_c.rstrip() + "\n", by_step, sweeps, many.section()])
    (HERE / PICTURE).write_bytes(picture)
    (HERE / "results.md").write_text(text, encoding="utf-8")
    print(text)
    return 0 if faster and within and cheap else 1


if __name__ == "__main__":
    sys.exit(main())
