"""The picture of a fit: force over travel and over time, measured and fitted, and what is left."""

from __future__ import annotations

from typing import Any

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from overrun_hitch.fitting.fit import Fit
from overrun_hitch.fitting.trace import UNITS, Floats
from overrun_hitch.show.traces import STYLE

NAMES = {"F_hitch": "Hitch force", "trailer_brake_torque": "Brake torque"}
DOTS: dict[str, Any] = {"linestyle": "none", "marker": ".", "rasterized": True}
MEASURED: dict[str, Any] = {**DOTS, "color": "#9a9a9a", "markersize": 3.0}
FITTED: dict[str, Any] = {"color": "#d55e00", "linewidth": 1.2}
LEFT: dict[str, Any] = {**DOTS, "color": "#0b3c6f", "markersize": 2.0}


def draw(name: str, found: Fit) -> Figure:
    """For each channel its curve over the compression, its trace over time, and below the residual."""
    measured = found.trace.channels()
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(7.2, 4.2 * len(found.model)), layout="constrained")
        figure.suptitle(name, fontsize=10)
        grid = figure.add_gridspec(2 * len(found.model), 2, height_ratios=[2.2, 1.0] * len(found.model))
        for row, (channel, model) in enumerate(found.model.items()):
            unit = UNITS[channel].replace(".", "·")
            over_travel = figure.add_subplot(grid[2 * row : 2 * row + 2, 0])
            over_time = figure.add_subplot(grid[2 * row, 1])
            left = figure.add_subplot(grid[2 * row + 1, 1], sharex=over_time)
            _pair(over_travel, 1e3 * found.motion.compression, measured[channel], model)
            over_travel.set_xlabel("Compression (mm)")
            over_travel.set_ylabel(f"{NAMES[channel]} ({unit})")
            _pair(over_time, found.trace.time, measured[channel], model)
            over_time.tick_params(labelbottom=False)
            left.plot(found.trace.time, measured[channel] - model, **LEFT)
            left.axhline(0.0, color="#555555", linewidth=0.8)
            left.set_ylabel(f"Residual ({unit})")
            left.set_xlabel("Time (s)")
        # Below, for a curve over the travel may run anywhere.
        handles, labels = over_travel.get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=2)
    return figure


def _pair(axes: Axes, across: Floats, measured: Floats, model: Floats) -> None:
    axes.plot(across, measured, label="measured", **MEASURED)
    axes.plot(across, model, label="fitted", **FITTED)
