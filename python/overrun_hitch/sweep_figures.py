"""A metric over the two axes of a grid: shades, and contours with their values."""

from __future__ import annotations

import matplotlib as mpl
import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from overrun_hitch.figures import STYLE
from overrun_hitch.metrics import METRICS
from overrun_hitch.parameters import HitchError, named
from overrun_hitch.sweep_plan import Plan

LEVELS = 9  # contours, about


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
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(5.8, 4.6), layout="constrained")
        axes = figure.subplots()
        x, y = table[across].values, table[up].values
        levels = (
            mpl.ticker.MaxNLocator(LEVELS).tick_values(values.min(), values.max()) if values.count() else [0.0, 1.0]
        )
        shades = axes.contourf(x, y, values, levels, cmap="Greys", alpha=0.55)
        lines = axes.contour(x, y, values, levels, colors="#0b3c6f", linewidths=1.0)
        if levels[0] < 0.0 < levels[-1]:
            axes.contour(x, y, values, [0.0], colors="#d55e00", linewidths=2.2)
        axes.clabel(lines, fmt="%g", fontsize=9)
        figure.colorbar(shades, ax=axes, label=_labelled(sweep[metric], metric))
        axes.set_xlabel(_labelled(sweep[across], across))
        axes.set_ylabel(_labelled(sweep[up], up))
        axes.grid(visible=False)
        axes.set_title(str(sweep.attrs["title"]), fontsize=10)
    return figure


def _labelled(array: xr.DataArray, name: str) -> str:
    text = f"{array.attrs['long_name'].split(',')[0]}, {name} ({array.attrs['units']})"
    return text[:1].upper() + text[1:]
