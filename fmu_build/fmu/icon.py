"""The Icon annotation of a class (Modelica specification, section 18.6) to a PNG picture."""

from __future__ import annotations

import io
import re
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Ellipse, Polygon, Rectangle

PIXELS = 256
_NUMBER = r"-?\d+(?:\.\d*)?"


def draw_icon(annotation: str, name: str) -> bytes:
    """A square picture of the graphics in ``annotation``; a frame with the name if there are none."""
    figure = Figure(figsize=(1.0, 1.0), dpi=PIXELS)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set(xlim=(-105, 105), ylim=(-105, 105), aspect="equal")
    axes.axis("off")
    shapes = re.findall(r'\b(Rectangle|Ellipse|Line|Polygon|Text)\(((?:"(?:\\.|[^"\\])*"|[^()"])*)\)', annotation)
    for kind, body in shapes or [("Rectangle", "extent={{-100,100},{100,-100}}"), ("Text", 'textString="%name"')]:
        _draw(axes, kind, body, name)
    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=PIXELS, transparent=True, metadata={"Software": None})
    return stream.getvalue()


def _draw(axes: Axes, kind: str, body: str, name: str) -> None:
    points = _points(body) or [(-100.0, 40.0), (100.0, -40.0)]
    line = _colour(body, "color" if kind == "Line" else "lineColor", "black")
    style: dict[str, Any] = {"edgecolor": line, "linewidth": 0.5}
    style["facecolor"] = _colour(body, "fillColor", "none") if "FillPattern.Solid" in body else "none"
    (x1, y1), (x2, y2) = points[0], points[-1]
    if kind == "Line":
        axes.plot(*zip(*points, strict=True), color=line, linewidth=0.5 + 2 * _number(body, "thickness"))
    elif kind == "Polygon":
        axes.add_patch(Polygon(points, **style))
    elif kind == "Rectangle":
        axes.add_patch(Rectangle((min(x1, x2), min(y1, y2)), abs(x2 - x1), abs(y2 - y1), **style))
    elif kind == "Ellipse":
        axes.add_patch(Ellipse(((x1 + x2) / 2, (y1 + y2) / 2), abs(x2 - x1), abs(y2 - y1), **style))
    elif label := _label(body, name):
        # 0.3 points are one of Modelica's units here; a letter is about 0.6 of its height wide.
        size = 0.3 * min(abs(y2 - y1), abs(x2 - x1) / (0.6 * len(label)))
        place: dict[str, Any] = {"ha": "center", "va": "center", "fontsize": size}
        axes.text((x1 + x2) / 2, (y1 + y2) / 2, label, color=_colour(body, "textColor", "black"), **place)


def _label(body: str, name: str) -> str:
    """The text of a Text; "" if it shows the value of a parameter, which a picture cannot follow."""
    found = re.search(r'textString\s*=\s*"((?:\\.|[^"\\])*)"', body)
    label = found.group(1).replace("%name", name) if found else ""
    return "" if "%" in label else label


def _points(body: str) -> list[tuple[float, float]]:
    found = re.search(r"(?:extent|points)\s*=\s*\{(.*?\})\s*\}", body, re.DOTALL)
    pairs = re.findall(rf"\{{\s*({_NUMBER})\s*,\s*({_NUMBER})\s*\}}", found.group(1)) if found else []
    return [(float(x), float(y)) for x, y in pairs]


def _colour(body: str, key: str, default: str) -> Any:
    found = re.search(rf"\b{key}\s*=\s*\{{\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*\}}", body)
    return tuple(int(part) / 255 for part in found.groups()) if found else default


def _number(body: str, key: str) -> float:
    found = re.search(rf"\b{key}\s*=\s*({_NUMBER})", body)
    return float(found.group(1)) if found else 0.0
