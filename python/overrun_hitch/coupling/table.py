"""What `hitch couple` shows and writes: each scheme at each step beside the model in one piece."""

from __future__ import annotations

import csv
import math
from collections.abc import Sequence
from pathlib import Path

from rich.console import Console
from rich.table import Table

from overrun_hitch.coupling.pair import SCHEMES
from overrun_hitch.coupling.study import CouplingStudy, Point, longest_stable_step
from overrun_hitch.results import write_atomically

NARROW = 78  # columns that the table needs
MILLI = 1000.0
COLUMNS = ("scheme", "H [s]", "growth rate [1/s]", "frequency [Hz]", "error of the growth rate [1/s]",
           "closed form [1/s]", "created energy [J]", "coupling_energy [J]")  # fmt: skip


def show(name: str, study: CouplingStudy, paths: Sequence[Path]) -> None:
    """Print the errors of the growth rate, the steps that each scheme bears, and the files written."""
    console = Console(highlight=False)
    whole = study.whole
    console.print(f"{name}, C = {study.parameters.C:g} N.s/m, at {study.V:g} m/s")
    console.print(f"in one piece: growth rate {whole.growth_rate:.5f} 1/s, frequency {whole.frequency:.5f} Hz")
    console.print("error of the growth rate in 1/s, by communication step:")
    if console.width >= NARROW:
        console.print(_table(study))
    else:
        for point in study.points:
            console.print(f"{point.scheme.name}, {MILLI * point.H:g} ms: {_error(study, point)} 1/s")
    for scheme in SCHEMES:
        console.print(f"{scheme.name}: {scheme.what}; {_bears(longest_stable_step(scheme, study.parameters, study.V))}")
    for path in paths:
        console.print(f"wrote {path}", markup=False, soft_wrap=True)


def write_csv(study: CouplingStudy, path: Path) -> None:
    """Every number, with units in the header."""

    def write(temporary: Path) -> None:
        with temporary.open("w", encoding="utf-8", newline="") as file:
            table = csv.writer(file, lineterminator="\n")
            table.writerow(COLUMNS)
            for point in study.points:
                error = point.growth_rate - study.whole.growth_rate
                row = (point.H, point.growth_rate, point.frequency, error, point.expected, point.created, point.told)
                table.writerow([point.scheme.name, *map(repr, row)])

    write_atomically(path, write)


def _table(study: CouplingStudy) -> Table:
    steps = sorted({point.H for point in study.points})
    table = Table(box=None, pad_edge=False)
    table.add_column("")
    for H in steps:
        table.add_column(f"{MILLI * H:g} ms", justify="right", no_wrap=True)
    for scheme in SCHEMES:
        errors = {point.H: _error(study, point) for point in study.of(scheme)}
        table.add_row(scheme.name, *(errors.get(H, "-") for H in steps))
    return table


def _error(study: CouplingStudy, point: Point) -> str:
    error = point.growth_rate - study.whole.growth_rate
    return "-" if math.isnan(error) else f"{error:+.5f}"


def _bears(step: float) -> str:
    if step == 0.0:
        return "the combination shunts by itself already in one piece"
    if math.isinf(step):
        return "delays nothing to first order"
    return f"shunts by itself from {MILLI * step:.0f} ms on (closed form)"
