"""What can be read off a figure: of each panel where it lies, its axes, and the values of its curves by name."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.contour import ContourSet
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import ArrayLike, NDArray

from overrun_hitch.paper.report.label import plain

Floats = NDArray[np.float64]

POINTS_PER_INCH = 72.0  # an SVG's unit is the point
WITH_UNIT = re.compile(r"(.*) \((.*)\)", re.DOTALL)
RATIO = "1"  # a unit that is not written behind a number


def readings(figure: Figure) -> list[dict[str, Any]]:
    """A panel for each axes whose curves have names; numbers have four digits. The figure has been drawn."""
    return [panel for axes in figure.axes if (panel := _panel(figure, axes))["curves"]]


def _panel(figure: Figure, axes: Axes) -> dict[str, Any]:
    width, height = POINTS_PER_INCH * figure.get_size_inches()
    place = axes.get_position()
    box = (place.x0 * width, (1.0 - place.y1) * height, place.width * width, place.height * height)
    below = [other.get_xlabel() for other in axes.get_shared_x_axes().get_siblings(axes) if other.get_xlabel()]
    return {
        "box": _rounded(box),
        "x": _axis(axes.get_xlabel() or below[0], axes.get_xlim(), axes.get_xscale()),
        "y": _axis(axes.get_ylabel(), axes.get_ylim(), axes.get_yscale()),
        "curves": [*_lines(axes), *_contours(axes)],
    }


def _axis(label: str, limits: tuple[float, float], scale: str) -> dict[str, Any]:
    name, unit = _split(label)
    return {"name": plain(name), "unit": "" if unit == RATIO else unit, "ends": limits, "log": scale == "log"}


def _split(label: str) -> tuple[str, str]:
    found = WITH_UNIT.fullmatch(label.replace("\n", " "))
    return (found[1], found[2]) if found else (label, RATIO)


def _lines(axes: Axes) -> Iterator[dict[str, Any]]:
    for line in axes.lines:
        x, y = np.asarray(line.get_xdata(), dtype=float), np.asarray(line.get_ydata(), dtype=float)
        if line.get_transform() != axes.transData:  # across the panel, as axhline draws it
            x = np.asarray(axes.get_xlim())
        if not _name(line).startswith("_") and len(x):
            is_function = line.get_linestyle() != "None" and bool((np.diff(x) > 0.0).all())
            yield _curve(_name(line), x, y, is_function)


def _contours(axes: Axes) -> Iterator[dict[str, Any]]:
    for contours in axes.collections:
        if isinstance(contours, ContourSet) and not _name(contours).startswith("_"):
            name, unit = _split(_name(contours))
            for level, path in zip(contours.levels, contours.get_paths(), strict=True):
                x, y = np.asarray(path.vertices).T
                yield _curve(f"{name} = {level:g} {unit}", x, y, is_function=False)


def _curve(name: str, x: Floats, y: Floats, is_function: bool) -> dict[str, Any]:
    known = np.isfinite(x) & np.isfinite(y)
    return {"name": plain(name), "x": _rounded(x[known]), "y": _rounded(y[known]), "function": is_function}


def _name(artist: Line2D | ContourSet) -> str:
    return str(artist.get_label())


def _rounded(values: ArrayLike) -> list[float]:
    return [float(f"{value:.4g}") for value in np.asarray(values, dtype=float).tolist()]
