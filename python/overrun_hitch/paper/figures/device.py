"""C_crit over the lag of the trailer's brake and r/k: contours by theory, marks by the FMU."""

from __future__ import annotations

from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from overrun_hitch.paper.study.beyond import CHECKED_RATIOS
from overrun_hitch.paper.study.device import BESIDE, LAGS, RATIOS, SPEEDS, Device, Floats, LagCheck
from overrun_hitch.parameters import FIGURES
from overrun_hitch.show.traces import STYLE, WIDTH

MILLI = 1e3
STEP = 200.0  # N.s/m from contour to contour
NUMBERED_AT = 5.0  # m, where on the contours their C_crit is written
CASE_NAMES = ("i", "ii", "iii")  # of CHECKED_RATIOS
CONTOUR: dict[str, Any] = {"colors": "#0b3c6f", "linewidths": 1.4}
DAMPER: dict[str, Any] = {"colors": "#000000", "linewidths": 2.4}
CLOSED_FORM: dict[str, Any] = {"colors": "#8a8a8a", "linewidths": 2.6, "linestyles": [(0, (1.2, 1.2))], "zorder": 1.5}
CASE: dict[str, Any] = {"color": "#777777", "linestyle": (0, (1, 1.5)), "linewidth": 1.0}
MARK: dict[str, Any] = {"linestyle": "none", "marker": "o", "markersize": 6.5, "color": "#d55e00", "zorder": 4}
MISS: dict[str, Any] = {"linestyle": "none", "marker": "X", "markersize": 9.0, "color": "#000000", "zorder": 4}


def draw(found: Device) -> Figure:
    """A panel for each speed; a mark where the FMU grows with less damping and decays with more."""
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(WIDTH, 5.2), layout="constrained")
        panels = figure.subplots(1, len(SPEEDS), sharey=True)
        for axes, V, C_crit, closed_form in zip(panels, SPEEDS, found.C_crit, found.closed_form, strict=True):
            _draw_contours(axes, C_crit, closed_form)
            for name, ratio in zip(CASE_NAMES, CHECKED_RATIOS, strict=True):
                axes.axvline(ratio, **CASE)
                at = (ratio, MILLI * LAGS[-1])
                axes.annotate(name, at, (0.0, 6.0), textcoords="offset points", ha="center", fontsize=9)
            _draw_checks(axes, [check for check in found.checks if check.V == V])
            axes.set_title(f"$V$ = {V:g} m/s", fontsize=10, pad=20.0)
            axes.set_xlabel("$r/k$ (m)")
            axes.set_ylabel("Lag $\\tau_b$ (ms)")
            axes.set_ylim(0.0, MILLI * LAGS[-1])
            axes.grid(visible=False)
        panels[0].set_ylabel("Lag of the trailer's brake torque $\\tau_b$ (ms)")
        named = [line for line in panels[0].lines if not str(line.get_label()).startswith("_")]
        figure.legend(handles=named, loc="outside lower center", ncols=2, fontsize=9)
    return figure


def _draw_contours(axes: Axes, C_crit: Floats, closed_form: Floats) -> None:
    levels = np.arange(STEP, C_crit.max(), STEP)
    axes.contour(RATIOS, MILLI * LAGS, closed_form, levels, **CLOSED_FORM)
    contours = axes.contour(RATIOS, MILLI * LAGS, C_crit, levels, **CONTOUR)
    contours.set_label("$C_\\mathrm{crit}$ (N·s/m)")
    C = FIGURES["8"].parameters.C
    axes.contour(RATIOS, MILLI * LAGS, C_crit, [C], **DAMPER)
    column = np.array([float(np.interp(NUMBERED_AT, RATIOS, row)) for row in C_crit])
    places = [(NUMBERED_AT, float(np.interp(level, column, MILLI * LAGS))) for level in levels if level < column[-1]]
    axes.clabel(contours, fmt="%g", fontsize=9, manual=places)
    axes.plot([], [], color=CONTOUR["colors"], label="$C_\\mathrm{crit}$ (N·s/m), theory")
    axes.plot([], [], color=DAMPER["colors"], linewidth=2.4, label=f"{C:g} N·s/m, figure 8")
    axes.plot([], [], color=CLOSED_FORM["colors"], linewidth=2.6, linestyle=(0, (1.2, 1.2)), label="closed form")


def _draw_checks(axes: Axes, checks: list[LagCheck]) -> None:
    aside = f"FMU grows with {100.0 * BESIDE:g} % less,\ndecays with {100.0 * BESIDE:g} % more"
    for holds, label, style in ((True, aside, MARK), (False, "FMU does not", MISS)):
        points = [(check.ratio, MILLI * check.tau_b) for check in checks if check.holds == holds]
        if points:
            axes.plot(*zip(*points, strict=True), label=label, clip_on=False, **style)
