"""The traces of the paper's figures 6 to 11: accelerations, drawbar compression and wheel slips over time."""

from __future__ import annotations

import io
import textwrap
from pathlib import Path
from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from numpy.typing import NDArray

from overrun_hitch.parameters import HitchError, Scenario
from overrun_hitch.results import Run, scenario_of, values
from overrun_hitch.show import files
from overrun_hitch.theory.steady import Steady, steady

if TYPE_CHECKING:
    import xarray as xr

Floats = NDArray[np.float64]

# Dark and solid against mid-tone and dashed: told apart in greyscale and by the colour-blind.
CAR: dict[str, Any] = {"color": "#0b3c6f", "linestyle": "-", "linewidth": 1.3}
TRAILER: dict[str, Any] = {"color": "#d55e00", "linestyle": (0, (5, 1.6)), "linewidth": 1.3}
THEORY: dict[str, Any] = {"color": "#777777", "linestyle": (0, (1, 1.5)), "linewidth": 1.1, "zorder": 1.5}

TOLD: dict[str, Any] = {"xycoords": "axes fraction", "ha": "center", "va": "top", "fontsize": 9}
TOLD |= {"bbox": {"facecolor": "#ffffff", "edgecolor": "none", "pad": 1.0}}

MARGIN = 0.05  # of what a panel shows, beyond either end
START = 0.25  # s: what comes to rest sooner is the start's, not the motion's; at most a tenth of the run
SQUEEZED = 2.0  # times the height of rest and what follows, with the start: then the start is cut
WIDTH = 5.0  # in, of a figure: on a telephone's screen its text is as large as a point, about
STYLE: dict[Any, Any] = {
    "font.size": 10.0,
    "axes.grid": True,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "legend.frameon": False,
    "legend.handlelength": 2.6,
    "svg.hashsalt": "overrun_hitch",  # the same run gives the same file
}
KINDS = ("png", "svg")
DPI = 200  # of a PNG


class Traces(Figure):
    """A figure that a notebook shows, without asking whether pyplot has been set up."""

    def _repr_svg_(self) -> str:
        return rendered(self, "svg").decode()


def draw(run: Run | xr.Dataset) -> Figure:
    """The three panels of a step brake (see results.dataset), with theory's steady values as thin dotted lines."""
    scenario = scenario_of(run)
    is_step = not run.attrs.get("profile")
    theory = _theory(scenario) if is_step and not run.attrs.get("grade") else None
    with mpl.rc_context(STYLE):
        figure = Traces(figsize=(WIDTH, 6.2), layout="constrained")
        figure.suptitle(_title(scenario, is_step), fontsize=10)
        accelerations, compression, slips = figure.subplots(3, 1, sharex=True)
        time = values(run, "time")
        for axes, car, trailer, scale in (
            (accelerations, "a_car", "a_trailer", 1.0),
            (slips, "slip_car", "slip_trailer", 100.0),
        ):
            axes.plot(time, scale * values(run, car), label="car", **CAR)
            axes.plot(time, scale * values(run, trailer), label="trailer", **TRAILER)
        compression.plot(time, values(run, "compression"), label="drawbar", **CAR)
        if theory is not None:
            accelerations.axhline(theory.A, label="steady (theory)", **THEORY)
            compression.axhline(theory.D, label="steady (theory)", **THEORY)
        for axes in (accelerations, compression, slips):
            _cut_start(axes, time)
        _label(accelerations, "Acceleration (m/s²)")
        _label(compression, "Compression (m)")
        _label(slips, "Slip (%)")
        slips.set_xlabel("Time (s)")
        slips.set_xlim(0.0, float(time[-1]))
        figure.align_ylabels()
    return figure


def write(run: Run | xr.Dataset, stem: Path) -> list[Path]:
    """Draw a run to stem.png and stem.svg; returns the two paths. HitchError if they cannot be written."""
    return save(draw(run), stem)


def save(figure: Figure, stem: Path) -> list[Path]:
    """Write a figure to stem.png and stem.svg; returns the two paths. HitchError if they cannot be written."""
    return files.write({stem.with_name(f"{stem.name}.{kind}"): rendered(figure, kind) for kind in KINDS})


def rendered(figure: Figure, kind: str) -> bytes:
    """The content of the file of this kind, one of KINDS; the same figure gives the same bytes.

    They are those that savefig would give. It draws everything twice.
    """
    buffer = io.BytesIO()
    with mpl.rc_context(STYLE):
        if kind == "png":
            figure.set_dpi(DPI)
            FigureCanvasAgg(figure).print_png(buffer)  # type: ignore[no-untyped-call]
        else:
            FigureCanvasSVG(figure).print_svg(buffer, metadata={"Date": None})  # type: ignore[no-untyped-call]
    return buffer.getvalue()


def _cut_start(axes: Axes, time: Floats) -> None:
    """Let the panel show rest and what follows the start where that would squeeze it, and say how far it goes."""
    lines = [np.asarray(line.get_ydata(), dtype=float) for line in axes.lines]
    traces = np.stack([line for line in lines if len(line) == len(time)])
    begun = time - time[0] > min(START, 0.1 * float(time[-1] - time[0]))
    shown = np.concatenate([traces[:, begun].ravel(), *(line for line in lines if len(line) != len(time)), [0.0]])
    if not 0.0 < SQUEEZED * np.ptp(shown) < np.ptp(traces):
        return
    margin = MARGIN * float(np.ptp(shown))
    low, high = float(shown.min()) - margin, float(shown.max()) + margin
    axes.set_ylim(low, high)
    beyond = [f"{end:.3g}" for end in (float(traces.min()), float(traces.max())) if not low <= end <= high]
    told = f"at the start to {' and '.join(beyond)}"
    axes.annotate(told, (0.5, 0.97), **TOLD)


def _label(axes: Axes, name: str) -> None:
    axes.set_ylabel(name)
    # Above the panel, where there are no curves.
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 0.98), ncols=3, borderaxespad=0.0)


def _title(scenario: Scenario, is_step: bool) -> str:
    p = scenario.parameters
    name = scenario.name[:1].upper() + scenario.name[1:]
    torque = f"{scenario.brake_torque:g} N·m at" if is_step else "braked from"
    return (
        f"{textwrap.fill(name, 80)}\n{torque} {p.V_0:g} m/s, $C$ = {p.C:g} N·s/m,\n"
        f"$k$ = {p.k:g} N/m, $k_t$ = {p.k_t:g} N/m, $r/k$ = {_ratio(p.r, p.k)}, $\\epsilon$ = {p.eps:g} m"
    )


def _ratio(r: float, k: float) -> str:
    return f"{r / k:.4g} m" if k > 0.0 else "infinite"


def _theory(scenario: Scenario) -> Steady | None:
    try:
        return steady(scenario.parameters, scenario.brake_torque)
    except HitchError:
        return None
