"""C_crit over the lag of the trailer's brake: lines by theory, marks by the FMU."""

from __future__ import annotations

from typing import Any

import matplotlib as mpl
from matplotlib.figure import Figure

from overrun_hitch.paper.study.device import BESIDE, LAGS, SPEEDS, Device
from overrun_hitch.parameters import FIGURES
from overrun_hitch.show.traces import STYLE

MILLI = 1e3
LINES: tuple[dict[str, Any], ...] = (
    {"color": "#9ecae1", "linestyle": "-"},
    {"color": "#4292c6", "linestyle": (0, (6, 1.5))},
    {"color": "#08519c", "linestyle": (0, (3, 1.2))},
    {"color": "#08306b", "linestyle": (0, (1, 1))},
)
MARK: dict[str, Any] = {"linestyle": "none", "marker": "o", "markersize": 6.0, "color": "#d55e00", "zorder": 4}
MISS: dict[str, Any] = {"linestyle": "none", "marker": "X", "markersize": 9.0, "color": "#000000", "zorder": 4}


def draw(found: Device) -> Figure:
    """A line for each speed; a mark where the FMU grows with less damping and decays with more."""
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(5.8, 4.2), layout="constrained")
        axes = figure.subplots()
        for V, row, line in zip(SPEEDS, found.C_crit, LINES, strict=True):
            axes.plot(MILLI * LAGS, row, label=f"$V$ = {V:g} m/s, theory", linewidth=1.8, **line)
        good = [check for check in found.checks if check.holds]
        aside = f"FMU grows with {100.0 * BESIDE:g} % less,\ndecays with {100.0 * BESIDE:g} % more"
        axes.plot([MILLI * c.tau_b for c in good], [c.C_crit for c in good], label=aside, **MARK)
        missed = [check for check in found.checks if not check.holds]
        if missed:
            axes.plot([MILLI * c.tau_b for c in missed], [c.C_crit for c in missed], label="FMU does not", **MISS)
        C = FIGURES["8"].parameters.C
        axes.axhline(C, color="#777777", linestyle=(0, (1, 1.5)), linewidth=1.0)
        axes.annotate("figure 8", (MILLI * LAGS[-1], C), (0.0, 3.0), textcoords="offset points", ha="right", fontsize=9)
        axes.set_xlabel("Lag of the trailer's brake torque $\\tau_b$ (ms)")
        axes.set_ylabel("$C_\\mathrm{crit}$ (N·s/m)")
        axes.set_xlim(0.0, 1.04 * MILLI * LAGS[-1])
        axes.set_ylim(bottom=0.0)
        axes.legend(loc="upper left", fontsize=9)
    return figure
