"""The work-precision diagram: error against CPU time over a range of tolerances."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from benchmarks.comparison import ALLOWED, in_turns
from benchmarks.contender import Contender, Floats
from overrun_hitch.show.traces import STYLE

TOLERANCES = [10.0 ** (-n / 2) for n in range(4, 21)]  # 1e-2 to 1e-10, relative
ROUNDS = 5
# A colour and a mark for each family; the second of a family is dashed, with open marks.
FAMILIES: Sequence[dict[str, Any]] = (
    {"color": "#0b3c6f", "marker": "o"},
    {"color": "#1b7f4d", "marker": "^"},
    {"color": "#d55e00", "marker": "s"},
    {"color": "#8e3b9e", "marker": "D"},
    {"color": "#444444", "marker": "v"},
)
STYLES: dict[str, tuple[int, bool]] = {
    "FMU from C": (0, False),
    "FMU from fmpy": (0, True),
    "FMU, fmpy's CVode": (1, False),
    "rumoca, rk-like": (2, False),
    "rumoca, bdf": (2, True),
    "SciPy's Radau, numpy": (3, False),
    "SciPy's Radau, numba": (3, True),
    "SciPy's LSODA, numpy": (4, False),
    "SciPy's LSODA, numba": (4, True),
}

Curve = tuple[Floats, Floats]  # CPU times in s and errors in m, one for each tolerance


def measured(contenders: Sequence[Contender]) -> dict[str, Curve]:
    """The curve of each contender, by its name."""
    cases = [(contender, tolerance) for contender in contenders for tolerance in TOLERANCES]
    errors = np.array([contender.solve(tolerance, False).error for contender, tolerance in cases])
    times = in_turns([lambda c=c, t=t: c.solve(t, False).cpu_time for c, t in cases], ROUNDS, "work and precision")
    shape = len(contenders), len(TOLERANCES)
    work, precision = np.median(times, axis=0).reshape(shape), errors.reshape(shape)
    return {contender.name: (work[i], precision[i]) for i, contender in enumerate(contenders)}


def drawn(curves: dict[str, Curve]) -> Figure:
    """The diagram; the dotted line is the error at which the table compares."""
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(7.6, 4.8), layout="constrained")
        axes = figure.subplots()
        draw_curves(axes, curves)
        compared = {"color": "#777777", "linestyle": (0, (1, 1.5)), "linewidth": 1.1, "zorder": 1.5}
        axes.axhline(ALLOWED, label="compared in the table", **compared)
        axes.set_ylabel("Error of the compression (m)")
        figure.legend(loc="outside right center")
    return figure


def draw_curves(axes: Axes, curves: dict[str, Curve]) -> None:
    """A line for each contender, which STYLES names."""
    for name, (times, errors) in curves.items():
        family, second = STYLES[name]
        style = {**FAMILIES[family], "linestyle": (0, (4, 2)) if second else "-"}
        face = "white" if second else style["color"]
        axes.loglog(1e3 * times, errors, label=name, linewidth=1.1, markersize=4.5, markerfacecolor=face, **style)
    axes.set_xlabel("CPU time (ms)")
