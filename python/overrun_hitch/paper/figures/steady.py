"""The paper's figure 3: what the trailer brake's strength does to the deceleration, and which spring that takes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from overrun_hitch.paper.study.beyond import DEFLECTION, designed
from overrun_hitch.paper.study.study import BRAKE_TORQUE, SteadyState
from overrun_hitch.parameters import CASES, DATUM
from overrun_hitch.show.traces import STYLE, WIDTH
from overrun_hitch.theory.steady import steady

RATIOS = np.linspace(0.0, 10.0, 201)  # r/k in m
DECELERATION = 5.0  # m/s2, for which the paper quotes the deflections
DEFLECTIONS = (0.025, 0.05, 0.1)  # m

THEORY: dict[str, Any] = {"color": "#0b3c6f", "linestyle": "-", "linewidth": 1.8}
FMU: dict[str, Any] = {"linestyle": "none", "markerfacecolor": "white", "markeredgewidth": 1.2, "zorder": 4}
DATUM_MARK: dict[str, Any] = {"marker": "o", "markersize": 9.0, "color": "#0b3c6f"}
VARIED_MARK: dict[str, Any] = {"marker": "s", "markersize": 5.0, "color": "#000000"}
STIFFNESS: dict[str, Any] = {"color": "#d55e00", "linewidth": 1.2}
DASHES = ((0, (1.2, 1.4)), (0, (5, 1.6)), (0, (6, 1.5, 1, 1.5)))
NAMED_AT = 6.5  # m, where on the curves of k their deflection is written
ABOVE: dict[str, Any] = {"xytext": (0.0, 4.0), "textcoords": "offset points", "fontsize": 9}


def stiffness(ratio: float, deflection: float, deceleration: float = DECELERATION) -> float:
    """The k (N/m) with which r/k = `ratio` (m) deflects the drawbar by `deflection` (m) at `deceleration` (m/s2).

    By equation 15 k goes with the deceleration over the deflection, and `designed` knows it for one such quotient.
    """
    return designed(ratio).k * DEFLECTION * deceleration / deflection


def draw(found: Mapping[str, SteadyState]) -> Figure:
    """A/A_c over r/k by theory, the FMU's at the nine cases (`found`), and on the right k for given deflections."""
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(WIDTH, 4.6), layout="constrained")
        ratio_axes = figure.subplots()
        stiffness_axes = ratio_axes.twinx()
        _draw_ratios(ratio_axes, found)
        _draw_stiffness(stiffness_axes)
        ratio_axes.plot([], [], label=f"right axis: $k$ for $D$ at {DECELERATION:g} m/s²", **STIFFNESS)
        # Above the panel, where there are no curves.
        ratio_axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2, columnspacing=1.4)
    return figure


def _draw_ratios(axes: Axes, found: Mapping[str, SteadyState]) -> None:
    theory = [steady(DATUM.changed({"k": 1.0, "r": ratio}), BRAKE_TORQUE).ratio for ratio in RATIOS.tolist()]
    axes.plot(RATIOS, theory, label="theory, datum", **THEORY)
    points = {case: (CASES[case].r / CASES[case].k, found[case].ratio) for case in CASES}
    datum = [case for case in CASES if _is_datum(case)]
    varied = [case for case in CASES if case not in datum]
    for cases, what, style in ((datum, "datum", DATUM_MARK), (varied, "varied", VARIED_MARK)):
        label = f"FMU, {what}: cases {cases[0]} to {cases[-1]}"
        axes.plot(*zip(*(points[case] for case in cases), strict=True), label=label, **FMU, **style)
    for case in datum:
        axes.annotate(case, points[case], (0.0, -9.0), textcoords="offset points", ha="center", va="top")
    axes.set_xlim(RATIOS[0], RATIOS[-1])
    axes.set_ylim(0.6, 1.0)
    axes.set_xlabel("Trailer brake torque over hitch force, $r/k$ (m)")
    axes.set_ylabel("Deceleration ratio $A/A_c$ (1)")


def _is_datum(case: str) -> bool:
    """Whether a case changes k and r alone."""
    p = CASES[case]
    return p == DATUM.changed({"k": p.k, "r": p.r})


def _draw_stiffness(axes: Axes) -> None:
    for deflection, dashes in zip(DEFLECTIONS, DASHES, strict=True):
        k = [stiffness(ratio, deflection) for ratio in RATIOS.tolist()]
        name = f"$D$ = {deflection:g} m"
        axes.plot(RATIOS, k, label=name, linestyle=dashes, **STIFFNESS)
        axes.annotate(name, (NAMED_AT, stiffness(NAMED_AT, deflection)), color=STIFFNESS["color"], **ABOVE)
    axes.set_yscale("log")
    axes.set_ylim(1e2, 1e6)  # four decades beside the four tenths of A/A_c: one grid serves both
    axes.set_ylabel("Drawbar stiffness $k$ (N/m)", color=STIFFNESS["color"])
    axes.tick_params(axis="y", which="both", colors=STIFFNESS["color"])
    axes.spines["right"].set_visible(True)
    axes.grid(visible=False)
