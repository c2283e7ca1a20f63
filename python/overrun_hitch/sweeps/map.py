"""A metric over the two axes of a grid: shades, and contours with their values.

Over damper and another axis the boundary of self-excitation by linear theory is drawn as well: what a metric tells of
growth is a fit to a whole run, in which the speed falls. Hatched is where linear theory does not speak.
"""

from __future__ import annotations

import json
from typing import Any

import matplotlib as mpl
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from overrun_hitch.measure.metrics import METRICS
from overrun_hitch.parameters import HitchError, Parameters, named
from overrun_hitch.show.traces import STYLE
from overrun_hitch.sweeps.plan import Plan
from overrun_hitch.theory.boundary import critical_damping
from overrun_hitch.theory.working_point import working_point

Floats = NDArray[np.float64]

LEVELS = 9  # contours, about
CROWDED = 10.0  # greatest over least value
BOUNDARY = 60  # points of the theoretical boundary
OF_GROWTH = ("growth_rate", "damping_ratio")  # metrics that change sign where the motion neither grows nor decays
OUTSIDE = "time_out_of_compression"
ZERO: dict[str, Any] = {"color": "#d55e00", "linewidth": 2.2}
CRITICAL: dict[str, Any] = {"color": "#000000", "linestyle": (0, (5, 2)), "linewidth": 1.6}


def check_map(plan: Plan, metric: str) -> None:
    """HitchError where `metric` can't be drawn over a sweep of this plan."""
    named("metric", metric, {name: METRICS[name] for name in plan.job.metrics})
    axes = [len(np.unique(column)) for column in plan.columns.values()]
    if len(axes) != 2 or axes[0] * axes[1] != plan.runs or min(axes) < 2:
        raise HitchError("--map needs a sweep over a grid of two quantities, with one FMU and one profile")


def draw_map(sweep: xr.Dataset, metric: str) -> Figure:
    """`metric` of a sweep over a full grid of two quantities; white where a run has none.

    Hatched where the drawbar leaves compression, if the sweep has that metric.
    """
    names = [str(name) for name in sweep.coords if sweep[name].dtype.kind == "f" and sweep[name].dims == ("run",)]
    # The one with more values lies along the page.
    across, up = sorted(names, key=lambda name: -len(np.unique(sweep[name].values)))
    wanted = [name for name in sweep.data_vars if name in (metric, OUTSIDE)]
    table = sweep[wanted].drop_vars(["fmu", "profile"]).load().set_index(run=[up, across]).unstack("run")
    values = np.ma.masked_invalid(table[metric].transpose(up, across).values)
    levels = _levels(values)
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(5.8, 5.2), layout="constrained")
        axes = figure.subplots()
        x, y = table[across].values, table[up].values
        shades = axes.contourf(x, y, values, levels, cmap="Greys", norm=BoundaryNorm(levels, 256), alpha=0.5)
        inner = levels[1:-1]
        lines = axes.contour(x, y, values, inner, colors="#0b3c6f", linestyles="solid", linewidths=1.0)
        explained = [
            *(_draw_zero(axes, sweep, metric, x, y, values) if 0.0 in inner else []),
            *(_hatch(axes, x, y, table[OUTSIDE].transpose(up, across).values) if OUTSIDE in table else []),
            *(_draw_boundary(axes, sweep, across, up) if metric in OF_GROWTH else []),
        ]
        if explained:
            figure.legend(handles=explained, loc="outside lower center", ncols=1)
        labelled = inner[inner != 0.0]  # which the legend explains
        axes.clabel(
            lines, labelled, fmt=lambda level: f"{level:g}".replace("-", "\N{MINUS SIGN}"), fontsize=9, inline_spacing=8
        )
        meaning = sweep[metric].attrs["long_name"].split(",")[0]
        figure.colorbar(shades, ax=axes, label=_labelled(meaning, sweep[metric]))
        axes.set_xlabel(_labelled(f"{sweep[across].attrs['long_name']}, {across}", sweep[across]))
        axes.set_ylabel(_labelled(f"{sweep[up].attrs['long_name']}, {up}", sweep[up]))
        if not values.count():
            axes.text(0.5, 0.5, "no run has a value", transform=axes.transAxes, ha="center")
        axes.grid(visible=False)
        axes.set_title(str(sweep.attrs["title"]), fontsize=10)
    return figure


def _draw_zero(axes: Axes, sweep: xr.Dataset, metric: str, x: Floats, y: Floats, values: Any) -> list[Any]:
    """A thick line where the metric is 0; what the legend says of it."""
    axes.contour(x, y, values, [0.0], colors=ZERO["color"], linewidths=ZERO["linewidth"])
    duration = float(json.loads(sweep.attrs["sweep"])["duration"])
    fitted = f": fit over {duration:g} s, in which the speed falls" if metric in OF_GROWTH else ""
    return [Line2D([], [], **ZERO, label=f"{metric} = 0{fitted}")]


def _hatch(axes: Axes, x: Floats, y: Floats, outside: Floats) -> list[Any]:
    """Where the drawbar is out of compression for a time (s) greater than 0; what the legend says of it."""
    reached = (outside > 0.0).astype(np.float64)  # NaN: the run failed
    if not reached.any():
        return []
    axes.contourf(x, y, reached, [0.5, 1.5], colors="none", hatches=["////"])
    return [Patch(facecolor="none", edgecolor="#000000", hatch="////", label="the drawbar leaves compression")]


def _draw_boundary(axes: Axes, sweep: xr.Dataset, across: str, up: str) -> list[Any]:
    """C_crit over the other axis, where one axis is C and theory knows the parameters; the legend's entry."""
    if "C" not in (across, up):
        return []
    other = up if across == "C" else across
    base = {name: value for name, value in sweep.attrs.items() if name in Parameters.model_fields}
    values = sweep[other].values
    line = np.linspace(values.min(), values.max(), BOUNDARY)
    try:
        critical = np.array([_critical_damping(Parameters(**{**base, other: value})) for value in line.tolist()])
    except HitchError:
        return []
    limits = axes.get_xlim(), axes.get_ylim()
    points = (critical, line) if across == "C" else (line, critical)
    drawn = axes.plot(*points, **CRITICAL, label="$C_\\mathrm{crit}$ at the start's speed, linear theory")
    axes.set(xlim=limits[0], ylim=limits[1])
    return list(drawn)


def _critical_damping(parameters: Parameters) -> float:
    return critical_damping(working_point(parameters).linear, parameters.V_0)


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
