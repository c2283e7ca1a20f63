"""Pictures of a crosscheck: compression of all files on one another, and its difference from A's in the funnel."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from overrun_hitch.comparison.crosscheck import Crosscheck
from overrun_hitch.comparison.distances import Allowed, funnel_around
from overrun_hitch.results import values
from overrun_hitch.show.traces import STYLE
from overrun_hitch.show.words import printable

Floats = NDArray[np.float64]

# Told apart by dashes and by lightness; what is drawn later lets show what lies beneath.
LINES: list[dict[str, Any]] = [
    {"color": "#0b3c6f", "linestyle": "-", "linewidth": 2.2},
    {"color": "#d55e00", "linestyle": (0, (5, 2.5)), "linewidth": 1.5},
    {"color": "#009e73", "linestyle": (0, (6, 2, 1, 2)), "linewidth": 1.4},
    {"color": "#7a7a7a", "linestyle": (0, (1.2, 1.8)), "linewidth": 1.6},
    {"color": "#56b4e9", "linestyle": (0, (10, 3)), "linewidth": 1.3},
]
BAND: dict[str, Any] = {"color": "#dddddd", "linewidth": 0.0, "zorder": 0.5}
MILLI = 1000.0


def names(fmus: Sequence[Path]) -> list[str]:
    """What the files are called in a picture: as much of the end of their paths as tells apart those of one name."""
    parts = [fmu.absolute().parts for fmu in fmus]
    return [str(Path(*one[-_needed(one, parts) :])) for one in parts]


def _needed(one: tuple[str, ...], others: Sequence[tuple[str, ...]]) -> int:
    """How many parts; 1 for a file that was given twice, which no path tells apart."""
    different = [other for other in others if other != one]
    return next(n for n in range(1, len(one) + 1) if all(other[-n:] != one[-n:] for other in different))


def draw(check: Crosscheck, names: list[str], allowed: Allowed) -> Figure:
    """Two panels for one scenario; `names` of the files in their order, A's first."""
    reference = check.reference
    assert reference is not None  # theory has no traces to draw
    time, a = values(reference, "time"), values(reference, "compression")
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(6.4, 5.2), layout="constrained")
        figure.suptitle(_plain(f"{check.scenario.name[:1].upper()}{check.scenario.name[1:]}"), fontsize=10)
        above, below = figure.subplots(2, 1, sharex=True)
        if np.isfinite(a).all():
            funnel = funnel_around(reference, a, "compression", allowed)
            below.fill_between(time, MILLI * (funnel.lower - a), MILLI * (funnel.upper - a), label="funnel", **BAND)
        above.plot(time, a, label=f"A  {_short(names[0])}", **LINES[0])
        for i, (name, comparison) in enumerate(zip(names[1:], check.comparisons, strict=True), start=1):
            if comparison.runs:
                expected, found = (values(run, "compression") for run in comparison.runs)
                when, line = values(comparison.runs[1], "time"), LINES[i % len(LINES)]
                above.plot(when, found, label=f"{comparison.label}  {_short(name)}", **line)
                below.plot(when, MILLI * (found - expected), label=f"{comparison.label} less A", **line)
        _label(above, "Compression (m)", columns=2)
        _label(below, "Difference (mm)", columns=5)
        below.set_xlabel("Time (s)")
        below.set_xlim(0.0, float(time[-1]))
        # One that runs away must not flatten the others.
        _limit(above, a, 3.0 * float(np.ptp(a)))
        _limit(below, np.zeros(1), MILLI * float(np.ptp(a)))
        figure.align_ylabels()
    return figure


def _label(axes: Axes, name: str, columns: int) -> None:
    axes.set_ylabel(name)
    # Above the panel, where there are no curves.
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.01), ncols=columns, borderaxespad=0.0, fontsize=9)


def _limit(axes: Axes, around: Floats, farthest: float) -> None:
    """Keep what is shown within `farthest` of the values `around`."""
    if not (math.isfinite(farthest) and farthest > 0.0):
        return
    low, high = axes.get_ylim()
    axes.set_ylim(max(low, float(around.min()) - farthest), min(high, float(around.max()) + farthest))


def _short(name: str) -> str:
    return _plain(name if len(name) <= 32 else f"{name[:14]}...{name[-15:]}")


def _plain(words: str) -> str:
    return printable(words).replace("$", r"\$")  # matplotlib would set it as a formula
