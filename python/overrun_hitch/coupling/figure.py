"""The chart of what coupling does: error of the shunting growth rate and created energy over the step, by scheme."""

from __future__ import annotations

from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from overrun_hitch.coupling.pair import SCHEMES
from overrun_hitch.coupling.study import CouplingStudy
from overrun_hitch.show.traces import STYLE

MILLI = 1000.0
LEAST_GROWTH = 1e-6  # 1/s: below, the fit itself errs
LEAST_ENERGY = 1e-6  # J
# Warm: what is late; cold: what is not. Dashes and marks tell them apart in greyscale.
LINES: dict[str, dict[str, Any]] = {
    "jacobi": {"color": "#a23b00", "linestyle": "-", "marker": "o"},
    "jacobi-speed": {"color": "#d55e00", "linestyle": (0, (5, 1.6)), "marker": "s"},
    "car-first": {"color": "#e69f00", "linestyle": (0, (1, 1)), "marker": "^"},
    "jacobi-hold": {"color": "#0b3c6f", "linestyle": "-", "marker": "D", "linewidth": 2.0},
    "trailer-first": {"color": "#777777", "linestyle": (0, (6, 1.5, 1, 1.5)), "marker": "v"},
    "trailer-mean": {"color": "#1b7f4d", "linestyle": (0, (5, 1.6)), "marker": "P"},
    "alone": {"color": "#8c2d8c", "linestyle": "-", "marker": "<"},
    "alone-hold": {"color": "#4b3f9e", "linestyle": (0, (4, 1.2)), "marker": "*", "linewidth": 2.0},
    "iterated": {"color": "#2a9fd6", "linestyle": (0, (2, 1.2)), "marker": "X"},
}
CLOSED_FORM: dict[str, Any] = {"color": "#000000", "linestyle": (0, (1, 2.5)), "linewidth": 1.0, "zorder": 1.5}


def draw_coupling(study: CouplingStudy) -> Figure:
    """Both panels over H in ms, logarithmic; dotted: the closed form k T / (2 m_c) for light damping."""
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(6.0, 7.6), layout="constrained")
        growth, energy = figure.subplots(2, 1, sharex=True)
        for scheme in SCHEMES:
            points = study.of(scheme)
            if not points:
                continue
            H = MILLI * np.array([point.H for point in points])
            errors = np.array([abs(point.growth_rate - study.whole.growth_rate) for point in points])
            style = {"linewidth": 1.3, "markersize": 4.5, **LINES[scheme.name]}
            growth.plot(H, np.maximum(errors, LEAST_GROWTH), label=scheme.what, **style)
            created = np.array([abs(point.created) for point in points])
            energy.plot(H, np.maximum(created, LEAST_ENERGY), **style)
            if points[0].expected > 0.0:
                growth.plot(H, [point.expected for point in points], **CLOSED_FORM)
        _label(growth, f"Error of the growth rate (1/s)\nof {study.whole.growth_rate:.3g} 1/s", LEAST_GROWTH)
        _label(energy, "Created energy (J)\n$10^{-6}$: that or less", LEAST_ENERGY)
        energy.set_xlabel("Communication step $H$ (ms)")
        steps = sorted({MILLI * point.H for point in study.points})
        energy.set_xticks(steps, [f"{H:g}" for H in steps])
        energy.set_xticks([], minor=True)
        figure.legend(loc="outside upper center", ncols=1, title=_title(study))
        figure.align_ylabels()
    return figure


def _label(axes: Axes, name: str, least: float) -> None:
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_ylim(bottom=0.7 * least)
    axes.set_ylabel(name)


def _title(study: CouplingStudy) -> str:
    p = study.parameters
    return f"$C$ = {p.C:g} N·s/m, $k$ = {p.k:g} N/m, {study.V:g} m/s; dotted: closed form"
