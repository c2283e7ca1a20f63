"""The boundary of self-excitation as a chart over speed and brake: contours by theory, marks by the FMU."""

from __future__ import annotations

from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from overrun_hitch.paper.study.beyond import BESIDE, CHECKED_RATIOS, Boundary
from overrun_hitch.show.traces import STYLE, WIDTH

STEP = 10.0  # N.s/m from contour to contour
CASE_NAMES = ("i", "ii", "iii")  # of CHECKED_RATIOS
NUMBERED_AT = 5.7  # m, where on the contours their C_crit is written
CONTOUR: dict[str, Any] = {"colors": "#0b3c6f", "linewidths": 1.2}
CASE: dict[str, Any] = {"color": "#777777", "linestyle": (0, (1, 1.5)), "linewidth": 1.0}
MARK: dict[str, Any] = {"linestyle": "none", "marker": "o", "markersize": 7.0, "color": "#d55e00", "zorder": 4}
MISS: dict[str, Any] = {"linestyle": "none", "marker": "X", "markersize": 9.0, "color": "#000000", "zorder": 4}


def draw(found: Boundary) -> Figure:
    """Contours of C_crit over r/k and V; a mark where the FMU grows with less damping and decays with more."""
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(WIDTH, 4.8), layout="constrained")
        axes = figure.subplots()
        _draw_contours(axes, found)
        for name, ratio in zip(CASE_NAMES, CHECKED_RATIOS, strict=True):
            axes.axvline(ratio, **CASE)
            at = (ratio, float(found.speeds[-1]))
            axes.annotate(f"case {name}", at, (0.0, 3.0), textcoords="offset points", ha="center", fontsize=9)
        _draw_checks(axes, found)
        axes.set_xlabel("Trailer brake torque over hitch force, $r/k$ (m)")
        axes.set_ylabel("Speed $V$ (m/s)")
        axes.grid(visible=False)
        named = [line for line in axes.lines if not str(line.get_label()).startswith("_")]
        figure.legend(handles=named, loc="outside upper center")
    return figure


def _draw_contours(axes: Axes, found: Boundary) -> None:
    levels = np.arange(STEP, found.C_crit.max(), STEP)
    contours = axes.contour(found.ratios, found.speeds, found.C_crit, levels, **CONTOUR)
    contours.set_label("$C_\\mathrm{crit}$ (N·s/m)")
    column = [float(np.interp(NUMBERED_AT, found.ratios, row)) for row in found.C_crit]
    places = [(NUMBERED_AT, float(np.interp(level, column, found.speeds))) for level in levels if level > column[0]]
    axes.clabel(contours, fmt="%g", fontsize=9, manual=places)
    axes.plot([], [], color=CONTOUR["colors"], label="$C_\\mathrm{crit}$ (N·s/m), theory")


def _draw_checks(axes: Axes, found: Boundary) -> None:
    aside = f"FMU grows with {100.0 * BESIDE:g} % less damping, decays with {100.0 * BESIDE:g} % more"
    for holds, label, style in ((True, aside, MARK), (False, "FMU does not", MISS)):
        points = [(check.ratio, check.V) for check in found.checks if check.holds == holds]
        if points:
            axes.plot(*zip(*points, strict=True), label=label, **style)
