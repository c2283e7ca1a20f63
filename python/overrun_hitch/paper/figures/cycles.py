"""Sustained oscillations with clearance: amplitude and frequency over the damper, predicted and on the FMU."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from scipy.interpolate import PchipInterpolator

from overrun_hitch.experiments.limit_cycle import weight_push
from overrun_hitch.paper.study.beyond import CYCLE_GRADE, CYCLE_SPEED, Motion
from overrun_hitch.parameters import CASES
from overrun_hitch.show.traces import STYLE, WIDTH
from overrun_hitch.theory.boundary import critical_damping
from overrun_hitch.theory.describing_function import predicted_cycles

DAMPERS = np.append(np.linspace(0.3, 0.95, 14), [0.97, 0.999])  # of C_crit, for the lines
MILLI = 1000.0
HIGHEST = 100.0  # mm
# By clearance, none first. Lines and marks of several clearances lie on one another: wide lines and large marks are
# drawn first, and so show beneath the others.
CLEARANCES: Sequence[dict[str, Any]] = (
    {"line": ("#555555", (0, (1, 1)), 1.4), "mark": ("#555555", "P", 8.0)},
    {"line": ("#d55e00", (0, (5, 4)), 1.4), "mark": ("#d55e00", "s", 4.0)},
    {"line": ("#4aa377", "-", 3.0), "mark": ("#1b7f4d", "^", 8.5)},
    {"line": ("#7593bb", "-", 6.0), "mark": ("#0b3c6f", "o", 12.0)},
)
BOUNDARY: dict[str, Any] = {"color": "#000000", "linewidth": 1.2, "zorder": 1.5}
STEADY: dict[str, Any] = {"color": "#000000", "linewidth": 0.9, "linestyle": (0, (2, 3)), "zorder": 1.5}
AWAY: dict[str, Any] = {"linestyle": "none", "marker": r"$\uparrow$", "markersize": 9.0, "color": "#000000"}
UNSETTLED = "#bbbbbb"


def draw(found: Sequence[Motion]) -> Figure:
    """Amplitude and frequency over C for each clearance: lines by the describing function, marks on the FMU."""
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(WIDTH, 7.2), layout="constrained")
        amplitudes, frequencies = figure.subplots(2, 1, sharex=True, height_ratios=[3, 2])
        C_crit = critical_damping(CASES["ii"], CYCLE_SPEED)
        for axes in (amplitudes, frequencies):
            axes.axvline(C_crit, **BOUNDARY)
        amplitudes.axhline(MILLI * found[0].steady, **STEADY)
        clearances = sorted({motion.eps for motion in found})
        styles = dict(zip(clearances, CLEARANCES, strict=True))
        for eps in reversed(clearances):
            _draw_prediction(amplitudes, frequencies, eps, C_crit, styles[eps])
        for motion in sorted(found, key=lambda motion: -styles[motion.eps]["mark"][2]):
            _draw_motion(amplitudes, frequencies, motion, styles[motion.eps])
        amplitudes.set_xlim(30.0, 140.0)
        amplitudes.set_ylim(0.0, HIGHEST)
        amplitudes.set_ylabel("Amplitude (mm)")
        frequencies.set_ylabel("Frequency (Hz)")
        frequencies.set_xlabel("Damper coefficient $C$ (N·s/m)")
        figure.align_ylabels()
        figure.legend(handles=_legend(styles, C_crit, found), loc="outside upper center", ncols=2, fontsize=9)
    return figure


def _draw_prediction(amplitudes: Axes, frequencies: Axes, eps: float, C_crit: float, style: dict[str, Any]) -> None:
    """The smallest stable cycle; the line ends where none is predicted."""
    found = []
    for C in (C_crit * DAMPERS).tolist():
        p = CASES["ii"].changed({"C": C, "eps": eps})
        stable = (cycle for cycle in predicted_cycles(p, CYCLE_SPEED, weight_push(p, CYCLE_GRADE)) if cycle.is_stable)
        found += [(cycle.amplitude, C, cycle.frequency) for cycle in list(stable)[:1]]
    if len(found) < 2:
        return
    # Amplitude goes to infinity at some C, but C over the amplitude is a curve without corners.
    points = np.log(np.array(sorted(found)))
    between = np.linspace(points[0, 0], points[-1, 0], 100)
    C, frequency = np.exp(PchipInterpolator(points[:, 0], points[:, 1:])(between)).T
    name = f"{_clearance(eps)}, predicted"
    amplitudes.plot(C, MILLI * np.exp(between), label=name, **_line(style))
    frequencies.plot(C, frequency, label=name, **_line(style))


def _draw_motion(amplitudes: Axes, frequencies: Axes, motion: Motion, style: dict[str, Any]) -> None:
    mark = {**_mark(style), "label": f"{_clearance(motion.eps)}, FMU: {motion.fmu.verdict}"}
    if motion.fmu.verdict == "runs away":
        amplitudes.plot(motion.C, 0.91 * HIGHEST, **mark)
        amplitudes.plot(motion.C, 0.965 * HIGHEST, **AWAY)
    elif motion.fmu.verdict == "fades":
        amplitudes.plot(motion.C, 0.0, **mark, clip_on=False)
    else:
        if motion.fmu.verdict == "unsettled":
            mark["markerfacecolor"] = UNSETTLED
        elif motion.fmu.lowest < 0.0:
            mark["markerfacecolor"] = mark["markeredgecolor"]
        amplitudes.plot(motion.C, MILLI * motion.fmu.amplitude, **mark)
        frequencies.plot(motion.C, motion.fmu.frequency, **mark)


def _clearance(eps: float) -> str:
    return f"$\\epsilon$ = {eps:g} m"


def _line(style: dict[str, Any]) -> dict[str, Any]:
    return {"solid_capstyle": "butt", **dict(zip(("color", "linestyle", "linewidth"), style["line"], strict=True))}


def _mark(style: dict[str, Any]) -> dict[str, Any]:
    """An open mark of this clearance."""
    of_style = dict(zip(("markeredgecolor", "marker", "markersize"), style["mark"], strict=True))
    return {"linestyle": "none", "markerfacecolor": "white", "markeredgewidth": 1.3, "zorder": 4, **of_style}


def _legend(styles: dict[float, dict[str, Any]], C_crit: float, found: Sequence[Motion]) -> list[Line2D]:
    def entry(label: str, **style: Any) -> Line2D:
        return Line2D([], [], label=label, **style)

    black = {"linestyle": "none", "marker": "o", "markersize": 7.0, "color": "#000000"}
    verdicts = {motion.fmu.verdict for motion in found}
    meanings = [
        entry("line: describing function", color="#000000"),
        entry("open: FMU, strikes no stop", **black, markerfacecolor="white"),
        entry("filled: FMU, strikes the tension stop", **black),
        entry("FMU runs away", **AWAY) if "runs away" in verdicts else None,
        entry("FMU has not settled", **black, markerfacecolor=UNSETTLED) if "unsettled" in verdicts else None,
    ]
    limits = [
        entry(f"$C_\\mathrm{{crit}}$ = {C_crit:.1f} N·s/m", **BOUNDARY),
        entry("steady compression beyond $\\epsilon$", **STEADY),
    ]
    clearances = [entry(_clearance(eps), **{**_mark(style), **_line(style)}) for eps, style in styles.items()]
    return [*clearances, *(handle for handle in meanings if handle is not None), *limits]
