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
from scipy.optimize import isotonic_regression

from overrun_hitch.parameters import Parameters
from overrun_hitch.show.traces import STYLE, WIDTH
from overrun_hitch.theory.linear import shunting_mode

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]

# Colour, dashes and marks all differ, so that greyscale and the colour-blind lose nothing.
CURVES: Sequence[dict[str, Any]] = (
    {"color": "#0b3c6f", "linestyle": "-", "marker": "o"},
    {"color": "#d55e00", "linestyle": (0, (5, 1.6)), "marker": "s"},
    {"color": "#1b7f4d", "linestyle": (0, (6, 1.5, 1, 1.5)), "marker": "^"},
    {"color": "#8e3b9e", "linestyle": (0, (2, 1.2)), "marker": "D"},
    {"color": "#1f8fc6", "linestyle": (0, (9, 2)), "marker": "v"},
    {"color": "#555555", "linestyle": (0, (1, 1)), "marker": "P"},
)
BOUNDARY: dict[str, Any] = {"color": "#000000", "linewidth": 1.4, "zorder": 1.8}
SELF_EXCITED: dict[str, Any] = {"color": "#ececec", "linewidth": 0.0, "zorder": 0.5}
SMOOTH = 0.02  # of a curve's range, the longest straight piece of it
HALVINGS = 16  # of the step from one mark to the next, at most: a locus turns sharply where it meets the real axis
EQUAL_C: dict[str, Any] = {"color": "#8a8a8a", "linewidth": 0.6, "zorder": 1.6}
LEADER: dict[str, Any] = {**EQUAL_C, "arrowstyle": "-", "shrinkA": 0.0, "shrinkB": 3.0, "relpos": (0.5, 0.0)}
NUMBER: dict[str, Any] = {"fontsize": 9, "ha": "center", "va": "bottom", "arrowprops": LEADER}
DIGIT, LINE = 0.021, 0.042  # of the panel's width, what a digit and a line of NUMBER take


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
        figure = Figure(figsize=(WIDTH, 6.8 if damper else 4.6), layout="constrained")
        panels = figure.subplots(2 if damper else 1, 1, squeeze=False, height_ratios=[5, 3] if damper else None)[:, 0]
        _draw_plane(panels[0], curves, real, imaginary)
        if damper:
            _draw_growth(panels[1], curves, damper)
        explanation = ["Numbers: $C$ in N·s/m.", "Grey: self-excited."]
        if any(curve.measured for curve in curves):
            explanation.append("Open marks: measured.")
        named = [line for line in panels[0].lines if line.get_label() in {curve.label for curve in curves}]
        heading = "\n".join(filter(None, [title, " ".join(explanation)]))
        # Above the panels, where there are no curves.
        figure.legend(handles=named, loc="outside upper center", ncols=2, title=heading, fontsize=9)
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
            axes.plot(value.real, value.imag, label=f"{curve.label}, measured", **_open_marks(style))
    _draw_equal_dampers(axes, curves)


def _draw_equal_dampers(axes: Axes, curves: Sequence[LocusCurve]) -> None:
    """Join equal C, with their numbers in a row above the topmost curve."""
    dampers = np.unique(np.concatenate([curve.marks for curve in curves]))
    # From curve to curve as they lie above one another where they begin.
    stacked = sorted(curves, key=lambda curve: float(curve.eigenvalue[0].imag))
    tops: dict[float, complex] = {}
    for C in dampers:
        values = [curve.at(C) for curve in stacked if C in curve.marks]
        name = f"$C$ = {_number(C)} N·s/m"
        axes.plot([value.real for value in values], [value.imag for value in values], label=name, **EQUAL_C)
        tops[float(C)] = max(values, key=lambda value: value.imag)
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    shown = {C: top for C, top in tops.items() if left <= top.real <= right and low <= top.imag <= high}
    _number_row(axes, shown)


def _number_row(axes: Axes, tops: dict[float, complex]) -> None:
    """The numbers above the panel, none on another, each with a line to its mark (1/s); upright if they are wide."""
    numbered = sorted(tops, key=lambda C: tops[C].real)
    numbers = [_number(C) for C in numbered]
    left, right = axes.get_xlim()
    places = np.array([(tops[C].real - left) / (right - left) for C in numbered])
    wide = (max(map(len, numbers), default=0) + 1) * DIGIT
    is_level = wide * len(numbers) <= 1.0
    for C, number, place in zip(numbered, numbers, spread(places, wide if is_level else LINE), strict=True):
        at = (tops[C].real, tops[C].imag)
        turned = 0.0 if is_level else 90.0
        axes.annotate(number, at, (place, 1.01), textcoords="axes fraction", rotation=turned, **NUMBER)


def spread(places: Floats, apart: float) -> Floats:
    """The nearest to ascending `places` (n,) that are `apart` at least and in 0 to 1, as far as there is room."""
    if not len(places):
        return places
    apart = min(apart, 1.0 / len(places))
    steps = apart * np.arange(len(places))
    nearest = np.asarray(isotonic_regression(places - steps).x)
    return np.asarray(np.clip(nearest, 0.5 * apart, 1.0 - 0.5 * apart - steps[-1]) + steps)


def _number(C: float) -> str:
    return f"{C:.0f}" if 1e3 <= C < 1e6 else f"{C:.4g}"


def _draw_growth(axes: Axes, curves: Sequence[LocusCurve], damper: tuple[float, float]) -> None:
    axes.set_xlim(*damper)
    axes.axhline(0.0, **BOUNDARY)
    inside = []
    for curve, style in _styled(curves):
        axes.plot(curve.C, curve.eigenvalue.real, label=curve.label, **style, **_every_mark(curve))
        within = slice(*np.searchsorted(curve.C, damper))
        inside += [curve.eigenvalue.real[within], np.interp(damper, curve.C, curve.eigenvalue.real)]
        if curve.measured is not None:
            name = f"{curve.label}, measured"
            axes.plot(curve.measured[0], curve.measured[1].real, label=name, **_open_marks(style))
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
