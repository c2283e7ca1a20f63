"""Root loci of the shunting mode over the drawbar damper, as the paper's figures 4 and 5 draw them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike, NDArray

from overrun_hitch.parameters import Parameters
from overrun_hitch.show.traces import STYLE
from overrun_hitch.theory.linear import shunting_mode

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]

# Colour, dashes and marks all differ, so that greyscale and the colour-blind lose nothing.
CURVES: Sequence[dict[str, Any]] = (
    {"color": "#0b3c6f", "linestyle": "-", "marker": "o"},
    {"color": "#d55e00", "linestyle": (0, (5, 1.6)), "marker": "s"},
    {"color": "#1b7f4d", "linestyle": (0, (6, 1.5, 1, 1.5)), "marker": "^"},
    {"color": "#8e3b9e", "linestyle": (0, (2, 1.2)), "marker": "D"},
    {"color": "#2a9fd6", "linestyle": (0, (9, 2)), "marker": "v"},
    {"color": "#555555", "linestyle": (0, (1, 1)), "marker": "P"},
)
BOUNDARY: dict[str, Any] = {"color": "#000000", "linewidth": 1.4, "zorder": 1.8}
SELF_EXCITED: dict[str, Any] = {"color": "#ececec", "linewidth": 0.0, "zorder": 0.5}
SMOOTH = 0.02  # of a curve's range, the longest straight piece of it
HALVINGS = 16  # of the step from one mark to the next, at most: a locus turns sharply where it meets the real axis
EQUAL_C: dict[str, Any] = {"color": "#9a9a9a", "linewidth": 0.6, "zorder": 1.6}


@dataclass(frozen=True)
class LocusCurve:
    """One locus: eigenvalues with imaginary part >= 0 (1/s, arrays of the shape of C) over dampers C (n,), ascending.

    `marks` are the C (N.s/m) that bear a mark, each one of C. `measured`, drawn as open marks, are points found in
    another way: C (m,) in N.s/m and eigenvalues (m,) in 1/s.
    """

    label: str
    C: Floats
    eigenvalue: Complexes
    marks: Floats
    measured: tuple[Floats, Complexes] | None = None

    def at(self, C: float) -> complex:
        """The eigenvalue (1/s) at a C of this curve."""
        return complex(self.eigenvalue[np.searchsorted(self.C, C)])


def computed(
    label: str, parameters: Parameters, V: float, marks: ArrayLike, measured: tuple[Floats, Complexes] | None = None
) -> LocusCurve:
    """The locus of linear.shunting_mode at V (m/s), smooth from the least to the greatest of the `marks` (N.s/m)."""
    marked = np.unique(np.asarray(marks, dtype=np.float64))

    def eigenvalues(C: Floats) -> Complexes:
        return np.array([complex(shunting_mode(parameters.changed({"C": c}), V).eigenvalue) for c in C])

    C, value = marked, eigenvalues(marked)
    for _ in range(HALVINGS):
        magnitude = float(np.abs(value).max())
        far = np.flatnonzero(_steps(value.real, magnitude) + _steps(value.imag, magnitude) > SMOOTH)
        between = 0.5 * (C[far] + C[far + 1])
        C, value = np.insert(C, far + 1, between), np.insert(value, far + 1, eigenvalues(between))
    return LocusCurve(label, C, value, marked, measured)


def _steps(values: Floats, magnitude: float) -> Floats:
    """From each value to the next, relative to the range of all, as far as that is more than rounding."""
    return np.asarray(np.abs(np.diff(values)) / max(float(np.ptp(values)), 1e-6 * magnitude))


def draw_loci(
    curves: Sequence[LocusCurve],
    *,
    title: str = "",
    real: tuple[float, float] | None = None,
    imaginary: tuple[float, float] | None = None,
    damper: tuple[float, float] | None = None,
) -> Figure:
    """The loci in the upper half plane: real part in 1/s, imaginary part in rad/s, the stability boundary at 0.

    Fine lines join equal C of several curves; their numbers stand above the topmost. `real` and `imaginary` limit
    the axes (by default to what there is). With `damper`, a range of C in N.s/m, a second panel shows the growth rate
    over C there: curves that differ by the speed alone lie on one another in the plane, but not in this panel.
    """
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(5.8, 6.8 if damper else 4.6), layout="constrained")
        panels = figure.subplots(2 if damper else 1, 1, squeeze=False, height_ratios=[5, 3] if damper else None)[:, 0]
        _draw_plane(panels[0], curves, real, imaginary)
        if damper:
            _draw_growth(panels[1], curves, damper)
        if title:
            figure.suptitle(title, fontsize=10)
        # Above the panels, where there are no curves.
        explanation = ["Numbers: $C$ in N·s/m.", "Grey: self-excited."]
        if any(curve.measured for curve in curves):
            explanation.append("Open marks: measured.")
        panels[0].legend(loc="lower center", bbox_to_anchor=(0.5, 1.01), ncols=2, title=" ".join(explanation))
    return figure


def _draw_plane(
    axes: Axes, curves: Sequence[LocusCurve], real: tuple[float, float] | None, imaginary: tuple[float, float] | None
) -> None:
    points = np.concatenate([curve.eigenvalue for curve in curves] + [c.measured[1] for c in curves if c.measured])
    left, right = real or _limits(points.real, boundary=0.0)
    axes.set_xlim(left, right)
    axes.set_ylim(imaginary or _limits(points.imag))
    axes.axvspan(0.0, max(right, 0.0), **SELF_EXCITED)
    axes.axvline(0.0, **BOUNDARY)
    # The imaginary axis is where it is in the paper: on the right, beside the boundary.
    axes.yaxis.tick_right()
    axes.yaxis.set_label_position("right")
    axes.spines[["left", "right"]].set_visible(False)
    axes.set_xlabel("Real part (1/s)")
    axes.set_ylabel("Imaginary part (rad/s)")
    for curve, style in _styled(curves):
        axes.plot(curve.eigenvalue.real, curve.eigenvalue.imag, label=curve.label, **style, **_every_mark(curve))
        if curve.measured is not None:
            value = curve.measured[1]
            axes.plot(value.real, value.imag, **_open_marks(style))
    _draw_equal_dampers(axes, curves)


def _draw_equal_dampers(axes: Axes, curves: Sequence[LocusCurve]) -> None:
    """Join equal C; number as many of them as find room."""
    dampers = np.unique(np.concatenate([curve.marks for curve in curves]))
    # From curve to curve as they lie above one another where they begin.
    stacked = sorted(curves, key=lambda curve: float(curve.eigenvalue[0].imag))
    tops: dict[float, complex] = {}
    for C in dampers:
        values = [curve.at(C) for curve in stacked if C in curve.marks]
        axes.plot([value.real for value in values], [value.imag for value in values], **EQUAL_C)
        tops[float(C)] = max(values, key=lambda value: value.imag)
    for damper in _with_room(axes, tops):
        # To the left, because loci rise to the right; but the first stands clear of the boundary.
        at, side = (tops[damper].real, tops[damper].imag), "left" if damper == dampers[0] else "right"
        axes.annotate(_number(damper), at, (2.0, 4.5), textcoords="offset points", ha=side, fontsize=9)


def _with_room(axes: Axes, tops: dict[float, complex]) -> Iterable[float]:
    """Those C whose numbers do not touch, from both ends inwards; inside the axes alone."""
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    kept: dict[float, tuple[float, float]] = {}
    for damper in sorted(tops, key=lambda damper: (damper != min(tops), -damper)):
        x, y = (tops[damper].real - left) / (right - left), (tops[damper].imag - low) / (high - low)
        width = 0.015 + 0.016 * len(_number(damper))
        free = all(abs(x - other[0]) > width or abs(y - other[1]) > 0.1 for other in kept.values())
        if free and 0.0 <= x <= 1.0 and 0.0 <= y <= 1.0:
            kept[damper] = x, y
    return kept


def _number(C: float) -> str:
    return f"{C:.0f}" if C.is_integer() and C < 1e6 else f"{C:.4g}"


def _draw_growth(axes: Axes, curves: Sequence[LocusCurve], damper: tuple[float, float]) -> None:
    axes.set_xlim(*damper)
    axes.axhline(0.0, **BOUNDARY)
    inside = []
    for curve, style in _styled(curves):
        axes.plot(curve.C, curve.eigenvalue.real, **style, **_every_mark(curve))
        within = slice(*np.searchsorted(curve.C, damper))
        inside += [curve.eigenvalue.real[within], np.interp(damper, curve.C, curve.eigenvalue.real)]
        if curve.measured is not None:
            axes.plot(curve.measured[0], curve.measured[1].real, **_open_marks(style))
    low, high = _limits(np.concatenate(inside), boundary=0.0)
    axes.set_ylim(low, high)
    axes.axhspan(0.0, max(high, 0.0), **SELF_EXCITED)
    axes.set_xlabel("Damper coefficient $C$ (N·s/m)")
    axes.set_ylabel("Growth rate (1/s)")


def _styled(curves: Sequence[LocusCurve]) -> Iterable[tuple[LocusCurve, dict[str, Any]]]:
    for i, curve in enumerate(curves):
        yield curve, {**CURVES[i % len(CURVES)], "linewidth": 1.2, "markersize": 2.5 if curve.measured else 4.0}


def _every_mark(curve: LocusCurve) -> dict[str, Any]:
    return {"markevery": list(np.searchsorted(curve.C, curve.marks))}


def _open_marks(style: dict[str, Any]) -> dict[str, Any]:
    return {
        **style,
        "linestyle": "none",
        "markerfacecolor": "none",
        "markersize": 6.5,
        "markeredgewidth": 1.0,
        "zorder": 3,
    }


def _limits(values: Floats, boundary: float | None = None) -> tuple[float, float]:
    """Limits with a margin about the values; with a boundary, it and what lies on either side of it can be seen."""
    low, high = float(values.min()), float(values.max())
    if boundary is not None:
        low, high = min(low, boundary), max(high, boundary)
    margin = 0.06 * (high - low) or 0.06 * abs(high) or 1.0
    return low - margin, high + margin
