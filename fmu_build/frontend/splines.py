"""Slopes of piecewise cubics at the points of a table, by the methods of the Modelica Standard Library.

What they are to compute is defined by its ModelicaStandardTables.c (4.1.0), whose names and sources are these.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

Points = Sequence[float]
Slopes = list[float]


def cubics(x: Points, y: Points, slopes: Slopes) -> list[tuple[float, float, float]]:
    """For each interval (a, b, c) of y0 + c*v + b*v^2 + a*v^3, with v from its left end."""
    found = []
    for i, d in enumerate(_differences(x, y)):
        dx, left, right = x[i + 1] - x[i], slopes[i], slopes[i + 1]
        found.append(((left + right - 2 * d) / (dx * dx), (3 * d - 2 * left - right) / dx, left))
    return found


def akima(x: Points, y: Points) -> Slopes:
    """Hiroshi Akima: A new method of interpolation and smooth curve fitting based on local procedures. Journal of the
    ACM 17(4), 1970, 589-602, doi:10.1145/321607.321609"""
    d = _extended(_differences(x, y))
    return [
        _weighted(d[i + 1], d[i + 2], abs(d[i + 3] - d[i + 2]), abs(d[i + 1] - d[i]), (d[i + 1] + d[i + 2]) / 2)
        for i in range(len(x))
    ]


def modified_akima(x: Points, y: Points) -> Slopes:
    """Cosmin Ionita: Makima piecewise cubic interpolation. April 2019, blogs.mathworks.com/cleve/?p=4707"""
    d = _extended(_differences(x, y))
    return [
        _weighted(
            d[i + 1],
            d[i + 2],
            abs(d[i + 3] - d[i + 2]) + abs(d[i + 3] + d[i + 2]) / 2,
            abs(d[i + 1] - d[i]) + abs(d[i + 1] + d[i]) / 2,
            0.0,
        )
        for i in range(len(x))
    ]


def fritsch_butland(x: Points, y: Points) -> Slopes:
    """Frederick N. Fritsch and Judy Butland: A method for constructing local monotone piecewise cubic interpolants.
    SIAM Journal on Scientific and Statistical Computing 5(2), 1984, 300-304, doi:10.1137/0905021"""
    return _monotone(x, y, lambda d, e, h, k: 3 * (h + k) / ((h + 2 * k) / d + (k + 2 * h) / e))


def steffen(x: Points, y: Points) -> Slopes:
    """Matthias Steffen: A simple method for monotonic interpolation in one dimension. Astronomy and Astrophysics 239,
    1990, 443-450"""

    def slope(d: float, e: float, h: float, k: float) -> float:
        mean = (d * k + e * h) / (h + k)
        smaller = min(abs(d), abs(e))
        return mean if abs(mean) / 2 <= smaller else (2 if d > 0 else -2) * smaller

    return _monotone(x, y, slope)


def _monotone(x: Points, y: Points, inner: Callable[[float, float, float, float], float]) -> Slopes:
    """Those at the ends are of the chords; 0 where chords turn, else a function of two chords and their lengths."""
    d = _differences(x, y)
    found = [d[0]]
    for i in range(len(d) - 1):
        turns = d[i] * d[i + 1] <= 0
        found.append(0.0 if turns else inner(d[i], d[i + 1], x[i + 1] - x[i], x[i + 2] - x[i + 1]))
    return [*found, d[-1]]


def _differences(x: Points, y: Points) -> Slopes:
    return [(y[i + 1] - y[i]) / (x[i + 1] - x[i]) for i in range(len(x) - 1)]


def _extended(d: Slopes) -> Slopes:
    """With two more at each end, in a straight line."""
    return [3 * d[0] - 2 * d[1], 2 * d[0] - d[1], *d, 2 * d[-1] - d[-2], 3 * d[-1] - 2 * d[-2]]


def _weighted(left: float, right: float, of_left: float, of_right: float, otherwise: float) -> float:
    whole = of_left + of_right
    return left + of_right / whole * (right - left) if whole > 0 else otherwise
