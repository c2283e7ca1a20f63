"""Figure 8 by the package `modelica`, a Modelica tool in Python that shares nothing with rumoca or fmu_build.

    python record.py            writes figure-8.csv beside this file (seconds)

It needs Python 3.12 and `pip install "modelica[sim]==0.0.205"`. The run starts at a compression of 0.01 m: at 0, where
spring and clearance meet, the tool finds chattering, as it does where figures 6a and 10 pass that place.
"""

from __future__ import annotations

import csv
import re
from pathlib import Path

from modelica import lang, sim

HERE = Path(__file__).parent
LIBRARY = HERE.parents[2] / "modelica" / "OverrunHitch"
START = 0.01  # m
TOLERANCE = 1e-10
OUTPUTS = ("v_car", "v_trailer", "a_car", "a_trailer", "compression", "F_hitch", "slip_car", "slip_trailer")


def library(folder: Path) -> str:
    """The package in `folder` as one text, with its classes inside."""
    text = re.sub(r"^within[^;]*;\s*", "", (folder / "package.mo").read_text(encoding="utf-8"))
    found = re.match(r'(package \w+ "[^"]*")(.*)', text, re.DOTALL)
    assert found is not None
    parts = []
    for name in (folder / "package.order").read_text(encoding="utf-8").split():
        file = folder / f"{name}.mo"
        alone = file.read_text(encoding="utf-8") if file.exists() else library(folder / name)
        parts.append(re.sub(r"^within[^;]*;\s*", "", alone))
    return "\n".join([found[1], *parts, found[2]])


def figure_8() -> list[list[float]]:
    """Rows of time and OUTPUTS, 20 a second."""
    started = f"model M extends OverrunHitch.Examples.Figure8(combination(compression_start={START})); end M;"
    system = sim.causalize(sim.flatten(lang.parse(library(LIBRARY) + started), "M"))
    times = [n / 20 for n in range(121)]
    result = sim.simulate(system, stop=6.0, tolerance=TOLERANCE, absolute=TOLERANCE / 10, times=times)
    rows = {float(t): i for i, t in enumerate(result.time)}
    return [[t, *(float(result[f"combination.{name}"][rows[t]]) for name in OUTPUTS)] for t in times]


def main() -> None:
    """Write figure-8.csv."""
    with (HERE / "figure-8.csv").open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["time", *OUTPUTS])
        table.writerows([f"{value:.12g}" for value in row] for row in figure_8())


if __name__ == "__main__":
    main()
