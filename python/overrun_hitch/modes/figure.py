"""The picture of `hitch stability`: a root locus for each speed, and the growth rate near the stability boundary."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from typing import TypeVar

import numpy as np
from matplotlib.figure import Figure

from overrun_hitch.modes.locus import CURVES, computed, draw_loci
from overrun_hitch.modes.study import Boundary, Stability

MARKS = 16  # on a curve, at most

Item = TypeVar("Item")


def draw(result: Stability) -> Figure:
    """Root loci over the C of the rows; of many speeds as many as can be told apart, evenly chosen."""
    C = [row.C for row in result.rows if row.V == result.rows[0].V]
    shown = _some(result.boundaries, len(CURVES))
    marks = _some(C, MARKS)
    curves = [computed(_label(boundary), result.point.linear, boundary.V, marks) for boundary in shown]
    title = result.name[:1].upper() + result.name[1:]
    if len(shown) < len(result.boundaries):
        title += f" ({len(shown)} of {len(result.boundaries)} speeds)"
    return draw_loci(curves, title=textwrap.fill(title, 70), damper=_near(C, max(b.C_crit for b in shown)))


def _some(items: Sequence[Item], most: int) -> list[Item]:
    """At most `most` of the items, evenly chosen, the first and the last among them."""
    return [items[round(place)] for place in np.linspace(0, len(items) - 1, min(len(items), most))]


def _label(boundary: Boundary) -> str:
    limit = f"$C_\\mathrm{{crit}}$ = {boundary.C_crit:.4g} N·s/m" if boundary.C_crit > 0.0 else "stable without damper"
    return f"{boundary.V:.4g} m/s, {limit}"


def _near(C: Sequence[float], critical: float) -> tuple[float, float] | None:
    """The range of C with the boundary in its middle, as far as it was asked for; all if the boundary is elsewhere."""
    low, high = C[0], C[-1]
    if low == high:
        return None
    return low, min(high, 2.0 * critical) if 2.0 * critical > low else high
