"""A metric over the two axes of a grid: shades, and contours with their values."""

from __future__ import annotations

from typing import Any

import matplotlib as mpl
import numpy as np
import xarray as xr
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from overrun_hitch.measure.metrics import METRICS
from overrun_hitch.parameters import HitchError, named
from overrun_hitch.show.traces import STYLE
from overrun_hitch.sweeps.plan import Plan

Floats = NDArray[np.float64]

LEVELS = 9  # contours, about
CROWDED = 10.0  # greatest over least value


def check_map(plan: Plan, metric: str) -> None:
    """HitchError where `metric` can't be drawn over a sweep of this plan."""
    named("metric", metric, {name: METRICS[name] for name in plan.job.metrics})
    axes = [len(np.unique(column)) for column in plan.columns.values()]
    if len(axes) != 2 or axes[0] * axes[1] != plan.runs or min(axes) < 2:
        raise HitchError("--map needs a sweep over a grid of two quantities, with one FMU and one profile")


def draw_map(sweep: xr.Dataset, metric: str) -> Figure:
    """`metric` of a sweep over a full grid of two quantities; white where a run has none."""
    names = [str(name) for name in sweep.coords if sweep[name].dtype.kind == "f" and sweep[name].dims == ("run",)]
    # The one with more values lies along the page.
    across, up = sorted(names, key=lambda name: -len(np.unique(sweep[name].values)))
    table = sweep[[metric]].drop_vars(["fmu", "profile"]).load().set_index(run=[up, across]).unstack("run")
    values = np.ma.masked_invalid(table[metric].transpose(up, across).values)
    levels = _levels(values)
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(5.8, 4.6), layout="constrained")
        axes = figure.subplots()
        x, y = table[across].values, table[up].values
        shades = axes.contourf(x, y, values, levels, cmap="Greys", norm=BoundaryNorm(levels, 256), alpha=0.5)
        inner = levels[1:-1]
        lines = axes.contour(x, y, values, inner, colors="#0b3c6f", linestyles="solid", linewidths=1.0)
        if 0.0 in inner:
            axes.contour(x, y, values, [0.0], colors="#d55e00", linewidths=2.2)
        axes.clabel(lines, fmt=lambda level: f"{level:g}".replace("-", "\N{MINUS SIGN}"), fontsize=9, inline_spacing=8)
        meaning = sweep[metric].attrs["long_name"].split(",")[0]
        figure.colorbar(shades, ax=axes, label=_labelled(meaning, sweep[metric]))
        axes.set_xlabel(_labelled(f"{sweep[across].attrs['long_name']}, {across}", sweep[across]))
        axes.set_ylabel(_labelled(f"{sweep[up].attrs['long_name']}, {up}", sweep[up]))
        if not values.count():
            axes.text(0.5, 0.5, "no run has a value", transform=axes.transAxes, ha="center")
        axes.grid(visible=False)
        axes.set_title(str(sweep.attrs["title"]), fontsize=10)
    return figure


def _levels(values: Any) -> Floats:
    """Round numbers that enclose the values; by decades where even distances would crowd them."""
    low, high = (float(values.min()), float(values.max())) if values.count() else (0.0, 1.0)
    if low > 0.0 and high > CROWDED * low:
        decades = 10.0 ** np.arange(np.floor(np.log10(low)), np.ceil(np.log10(high)) + 1.0)
        levels = np.outer(decades, (1.0, 2.0, 5.0)).ravel()
    else:
        levels = np.asarray(MaxNLocator(LEVELS).tick_values(low, high))
    first = max(0, int(np.searchsorted(levels, low, side="right")) - 1)
    return levels[first : int(np.searchsorted(levels, high)) + 1]


def _labelled(meaning: str, array: xr.DataArray) -> str:
    unit = array.attrs["units"].replace(".", "\N{MIDDLE DOT}").replace("s2", "s²").replace("s3", "s³")
    return f"{meaning[:1].upper()}{meaning[1:]} ({unit})"
