"""Every figure of the paper's results, recomputed, and the four beyond it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

import numpy as np
from matplotlib.figure import Figure

from overrun_hitch.modes.locus import LocusCurve, computed, draw_loci
from overrun_hitch.paper.figures import boundary as boundary_figure
from overrun_hitch.paper.figures import cycles as cycles_figure
from overrun_hitch.paper.figures import device as device_figure
from overrun_hitch.paper.figures import steady as steady_figure
from overrun_hitch.paper.figures import stops as stops_figure
from overrun_hitch.paper.study.curves import DAMPERS, Locus
from overrun_hitch.paper.study.study import Study
from overrun_hitch.results import Run
from overrun_hitch.show import traces

REAL_AXIS = (-5.4, 0.3)  # 1/s; the paper's ticks end at -5, its case viii a little beyond
NEAR_BOUNDARY = (40.0, 210.0)  # N.s/m, the least three of DAMPERS

# Acceleration (m/s2), compression (m), slip (%): alike where figures are to be held beside each other.
WITHOUT_CLEARANCE = ((-8.0, 1.0), (-0.03, 0.08), (-0.1, 1.8))
WITH_CLEARANCE = ((-11.0, 1.0), (-0.02, 0.22), (-0.1, 2.4))
LIMITS: Mapping[str, tuple[tuple[float, float], ...]] = {
    "6a": ((-8.0, 10.0), *WITHOUT_CLEARANCE[1:]),  # the tension stop throws the trailer forward
    **dict.fromkeys(("6b", "7", "8"), WITHOUT_CLEARANCE),
    **dict.fromkeys(("9", "10", "11"), WITH_CLEARANCE),
}


def figures(study: Study, progress: Callable[[str], object] = lambda _: None) -> dict[str, Figure]:
    """The figures by the paper's number, then those of captions.BEYOND; `progress` is told what is being drawn."""
    pictures: dict[str, Callable[[], Figure]] = {
        "3": partial(steady_figure.draw, study.steady_fmu),
        **{name: partial(_loci, loci) for name, loci in study.loci.items()},
        **{name: partial(_traces, run, LIMITS[name]) for name, run in study.runs.items()},
        "boundary": partial(boundary_figure.draw, study.boundary),
        "cycles": partial(cycles_figure.draw, study.motions),
        "device": partial(device_figure.draw, study.device),
        "stops": partial(stops_figure.draw, study.stops),
    }
    drawn = {}
    for name, draw in pictures.items():
        progress(f"drawing {stem(name).replace('-', ' ')}")
        drawn[name] = draw()
    return drawn


def stem(name: str) -> str:
    """What the file of a figure is called, without suffix."""
    return f"figure-{name}" if name[0].isdigit() else name


def _loci(loci: tuple[Locus, ...]) -> Figure:
    return draw_loci([_curve(locus) for locus in loci], real=REAL_AXIS, damper=NEAR_BOUNDARY)


def _curve(locus: Locus) -> LocusCurve:
    measured = np.array(DAMPERS), np.array([mode.eigenvalue for mode in locus.fmu])
    return computed(locus.curve.label, locus.curve.parameters, locus.curve.V, DAMPERS, measured)


def _traces(run: Run, limits: tuple[tuple[float, float], ...]) -> Figure:
    figure = traces.draw(run)
    for axes, (low, high) in zip(figure.axes, limits, strict=True):
        axes.set_ylim(low, high)
    return figure
