"""What single communication steps cost where the input changes, and where it does not: CarTrailer and Trailer in C."""

from __future__ import annotations

import subprocess
from dataclasses import dataclass
from pathlib import Path

from benchmarks.six_seconds import linked

STEPS = (0.001, 0.01)  # s
INPUTS = {"constant": 6.0, "slow": 6.0, "brisk": 6.0, "braking": 60.0}  # s
RUNS = {"constant": 100, "slow": 100, "brisk": 100, "braking": 11}
HEAD = """## Step by step, with an input that changes

A C program sets the input, makes the step and reads nine outputs. Of `CarTrailer` the input is the brake torque of
figure 8, constant, or with a ripple of 3 rad/s, slow (10 N.m) or brisk (200 N.m); of `Trailer` the speed of a car that
such a torque slows. Braking: sixty seconds with ten brake applications of 1500 N.m and a stop. Runs repeat the same
numbers; of each step the shortest time counts, with the clock's own, some 25 ns. Right-hand sides are counted and
depend on no machine, that at the start of a step too, of which most is known from the end of the last one; those of the
prediction behind `F_hitch_hold`, about as many again, are not among them.

"""
COLUMNS = (
    "| unit | step | input | steps | mean | 99.9 % | worst | right-hand sides | worst |",
    "|---|---|---|---|---|---|---|---|---|",
)


@dataclass(frozen=True)
class Row:
    """Times in ns; right-hand sides of a step, mean and most."""

    kind: str
    count: int
    mean: float
    rare: float
    worst: float
    evaluations: float
    most: int


def measured(program: Path, name: str, step: float) -> list[Row]:
    """All steps with the input of this name, then kinds of them."""
    command = [str(program), name, f"{step}", f"{INPUTS[name]}", f"{RUNS[name]}"]
    lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
    rows = []
    for kind, _, values in (line.partition(": ") for line in lines):
        count, mean, rare, worst, evaluations, most = values.split()
        rows.append(Row(kind, int(count), *map(float, (mean, rare, worst, evaluations)), int(most)))
    return rows


def section(fmus: list[Path], folder: Path) -> str:
    """The report's section; each FMU is unpacked in a folder of its own."""
    lines, ratios = list(COLUMNS), []
    for fmu in fmus:
        (folder / fmu.stem).mkdir()
        program = linked(fmu, folder / fmu.stem, "steps.c")
        for step in STEPS:
            found = {name: measured(program, name, step) for name in INPUTS}
            for name, rows in found.items():
                for row in rows if name == "braking" else rows[:1]:
                    what = name if row.kind == "all" else f"{name}, {row.kind}"
                    times = f"{row.mean:.0f} ns | {row.rare:.0f} ns | {1e-3 * row.worst:.1f} us"
                    counts = f"{row.evaluations:.2f} | {row.most}"
                    lines.append(f"| {fmu.stem} | {1e3 * step:g} ms | {what} | {row.count} | {times} | {counts} |")
            if fmu.stem == "CarTrailer":  # the input of Trailer always changes
                slow, brisk = (found[name][0].mean / found["constant"][0].mean for name in ("slow", "brisk"))
                ratios.append(f"at {1e3 * step:g} ms {slow:.1f} (slow) and {brisk:.1f} (brisk)")
    return HEAD + "\n".join([*lines, "", f"CarTrailer, changing over constant: {'; '.join(ratios)}.", ""])
