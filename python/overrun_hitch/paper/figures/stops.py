"""Shunting on the way to standstill: a trace in its predicted envelope, envelopes of several stops, their errors."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter
from numpy.typing import NDArray

from overrun_hitch.paper.study.beyond import STOP_ALLOWED, Envelope, Shunting
from overrun_hitch.show.traces import STYLE, WIDTH
from overrun_hitch.theory.envelope import predicted_amplitude, speed

Floats = NDArray[np.float64]

MILLI = 1000.0
PERCENT = 100.0
POINTS = 400  # of the lines
# By stop: told apart by mark and dash where colour does not help.
STOPS: Sequence[dict[str, Any]] = (
    {"color": "#0b3c6f", "linestyle": "-", "marker": "o"},
    {"color": "#d55e00", "linestyle": (0, (5, 1.6)), "marker": "s"},
    {"color": "#1b7f4d", "linestyle": (0, (7, 1.6, 1.5, 1.6)), "marker": "^"},
    {"color": "#555555", "linestyle": (0, (1, 1)), "marker": "P"},
)
TRACE: dict[str, Any] = {"color": "#6f93bd", "linewidth": 0.9}
ENVELOPE: dict[str, Any] = {"color": "#000000", "linestyle": (0, (4, 1.6)), "linewidth": 1.2}
STEADY: dict[str, Any] = {"color": "#000000", "linewidth": 0.9, "linestyle": (0, (2, 3)), "zorder": 1.5}
TURNING: dict[str, Any] = {"linestyle": "none", "marker": "|", "markersize": 13.0, "markeredgewidth": 1.6}


def draw(found: Sequence[Shunting]) -> Figure:
    """Above: the compression of the first stop. Middle: amplitudes of all. Below: how far they are from theory's."""
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(WIDTH, 8.4), layout="constrained")
        trace, amplitudes, errors = figure.subplots(3, 1, sharex=True, height_ratios=[3, 4, 2.4])
        _draw_trace(trace, found[0])
        for axes in (trace, amplitudes):
            axes.axhline(MILLI * found[0].steady, label="steady compression", **STEADY)
        for stop, style in zip(found, STOPS, strict=True):
            _draw_amplitudes(amplitudes, stop, style)
            _draw_errors(errors, stop, style)
        amplitudes.set_yscale("log")
        amplitudes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        amplitudes.set_yticks([3.0, 5.0, 10.0, 20.0, 30.0, 50.0], minor=False)
        amplitudes.set_yticks([], minor=True)
        amplitudes.set_ylabel("Amplitude (mm)")
        errors.set_ylim(-PERCENT * STOP_ALLOWED, PERCENT * STOP_ALLOWED)
        errors.set_ylabel("More than\npredicted (%)")
        errors.set_xlabel("Time (s)")
        errors.set_xlim(0.0, float(found[0].stop.time[-1]))
        figure.align_ylabels()
        figure.legend(
            handles=_legend(found),
            loc="outside upper center",
            ncols=2,
            fontsize=9,
            title="Marks: FMU. Lines: growth rate summed up;\nat the bottom, linear equations solved.",
            title_fontsize=9,
        )
    return figure


def _draw_trace(axes: Axes, found: Shunting) -> None:
    stop = found.stop
    time, amplitude = _prediction(found)
    axes.plot(stop.time, MILLI * stop.compression, label="FMU", **TRACE)
    for side in (-1.0, 1.0):
        axes.plot(time, MILLI * (found.steady + side * amplitude), label="predicted envelope", **ENVELOPE)
    axes.set_ylabel("Compression (mm)")
    V_0 = stop.scenario.parameters.V_0
    A = float(speed(stop.scenario, np.ones(1))[0]) - V_0

    def speed_at(time: Any) -> Any:
        return V_0 + A * time

    def time_of(V: Any) -> Any:
        return (V - V_0) / A

    speeds = axes.secondary_xaxis("top", functions=(speed_at, time_of))
    speeds.set_xticks(np.arange(0.0, V_0 + 1.0, 10.0))
    speeds.set_xlabel("Speed (m/s)")


def _draw_amplitudes(axes: Axes, found: Shunting, style: dict[str, Any]) -> None:
    time, amplitude = _prediction(found)
    predicted, on_fmu = (f"{_name(found)}, {side}" for side in ("predicted", "FMU"))
    line = {"color": style["color"], "linestyle": style["linestyle"], "linewidth": 1.3, "label": predicted}
    axes.plot(time, MILLI * amplitude, **line)
    axes.plot(found.fmu.time, MILLI * found.fmu.amplitude, label=on_fmu, **_open_marks(style), markevery=2)
    V = speed(found.stop.scenario, time)
    if V[-1] < found.turning < V[0]:
        at = np.interp(-found.turning, -V, time), MILLI * amplitude.max()
        axes.plot(*at, color=style["color"], **TURNING)


def _draw_errors(axes: Axes, found: Shunting, style: dict[str, Any]) -> None:
    solved, on_fmu = (f"{_name(found)}, {side}" for side in ("linear equations", "FMU"))
    line = {"color": style["color"], "linestyle": style["linestyle"], "linewidth": 1.1, "label": solved}
    axes.plot(*_error(found.integrated), **line)
    axes.plot(*_error(found.in_theory), label=on_fmu, **_open_marks(style), markevery=2)


def _error(found: Envelope) -> tuple[Floats, Floats]:
    return found.time, PERCENT * found.error


def _prediction(found: Shunting) -> tuple[Floats, Floats]:
    """Times in s and amplitudes in m (POINTS,), from the start to the last sample that is fast enough."""
    last = float(found.stop.time[found.stop.faster][-1])
    time = np.linspace(0.0, last, POINTS)
    return time, predicted_amplitude(found.stop.scenario, time)


def _open_marks(style: dict[str, Any]) -> dict[str, Any]:
    return {
        "linestyle": "none",
        "marker": style["marker"],
        "markersize": 5.0,
        "markerfacecolor": "white",
        "markeredgecolor": style["color"],
        "markeredgewidth": 1.1,
        "zorder": 3,
    }


def _legend(found: Sequence[Shunting]) -> list[Line2D]:
    def entry(label: str, **style: Any) -> Line2D:
        return Line2D([], [], label=label, **style)

    stops = [
        entry(
            _name(stop),
            **{**_open_marks(style), "linestyle": style["linestyle"], "color": style["color"]},
        )
        for stop, style in zip(found, STOPS, strict=True)
    ]
    meanings = [
        entry("top: FMU", **TRACE),
        entry("top: predicted envelope", **ENVELOPE),
        entry("growth turns to decay", color="#000000", **TURNING),
        entry("steady compression", **STEADY),
    ]
    return [*stops, *meanings]


def _name(found: Shunting) -> str:
    p = found.stop.scenario.parameters
    return f"$C$ = {p.C:g} N·s/m, from {MILLI * abs(p.compression_start - found.steady):.0f} mm"
