"""What `hitch couple` shows and writes: each scheme at each step beside the model in one piece."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from overrun_hitch.coupling.pair import SCHEMES, Scheme
from overrun_hitch.coupling.study import CouplingStudy, Point, longest_stable_step
from overrun_hitch.experiments.free_vibration import left_out
from overrun_hitch.show.table import Column, Numbers, Row, console, show_rows, show_written

MILLI = 1000.0


def show(name: str, study: CouplingStudy, paths: Sequence[Path]) -> None:
    """Print the errors of the growth rate, the steps that each scheme bears, and the files written."""
    out = console()
    whole = study.whole
    out.print(f"{name}, C = {study.parameters.C:g} N.s/m, at {study.V:g} m/s")
    for sentence in left_out(study.parameters):
        out.print(sentence, soft_wrap=True)
    out.print(f"in one piece: growth rate {whole.growth_rate:.5f} 1/s, frequency {whole.frequency:.5f} Hz")
    out.print("error of the growth rate in 1/s, by communication step:")
    steps = sorted({point.H for point in study.points})
    columns = (Column(), *(Numbers(f"{MILLI * H:g} ms") for H in steps))
    rows = (_cells(study, scheme, steps) for scheme in SCHEMES)
    show_rows(out, columns, rows, (_sentence(study, point) for point in study.points))
    for scheme in SCHEMES:
        out.print(
            f"{scheme.name}: {scheme.what}; {_bears(longest_stable_step(scheme, study.parameters, whole.growth_rate))}"
        )
    show_written(out, paths)


def csv_columns(study: CouplingStudy) -> dict[str, list[Any]]:
    """Every number, by names with units."""
    points = study.points
    return {
        "scheme": [point.scheme.name for point in points],
        "H [s]": [point.H for point in points],
        "growth rate [1/s]": [point.growth_rate for point in points],
        "frequency [Hz]": [point.frequency for point in points],
        "error of the growth rate [1/s]": [point.growth_rate - study.whole.growth_rate for point in points],
        "closed form [1/s]": [point.expected for point in points],
        "created energy [J]": [point.created for point in points],
        "coupling_energy [J]": [point.told for point in points],
    }


def _cells(study: CouplingStudy, scheme: Scheme, steps: Sequence[float]) -> Row:
    errors = {point.H: _error(study, point) for point in study.of(scheme)}
    return (scheme.name, *(errors.get(H, "-") for H in steps))


def _sentence(study: CouplingStudy, point: Point) -> str:
    return f"{point.scheme.name}, {MILLI * point.H:g} ms: {_error(study, point)} 1/s"


def _error(study: CouplingStudy, point: Point) -> str:
    error = point.growth_rate - study.whole.growth_rate
    return "-" if math.isnan(error) else f"{error:+.5f}"


def _bears(step: float) -> str:
    if step == 0.0:
        return "the combination shunts by itself already in one piece"
    if math.isinf(step):
        return "delays nothing to first order"
    return f"shunts by itself from {MILLI * step:.0f} ms on (closed form)"
