"""Tables of parameter values: full grids and space-filling samples, as columns of equal length."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.stats import qmc

from overrun_hitch.decimals import decimals

Floats = NDArray[np.float64]
Columns = Mapping[str, Floats]  # each (rows,)


def spaced(low: float, high: float, count: int, scale: str) -> Floats:
    """`count` values from `low` to `high`, both included, at even distances ("linear") or ratios ("log")."""
    return np.array(decimals((np.geomspace if scale == "log" else np.linspace)(low, high, count)))


def sampled(method: str, count: int, seed: int, ranges: Mapping[str, tuple[float, float]]) -> Columns:
    """`count` points within `ranges`, by a scrambled Sobol sequence or a Latin hypercube (scipy.stats.qmc).

    A Sobol sequence is balanced only if `count` is a power of two.
    """
    sampler = {"sobol": qmc.Sobol, "latin-hypercube": qmc.LatinHypercube}[method](len(ranges), rng=seed)
    low, high = np.array(list(ranges.values())).T
    points = qmc.scale(sampler.random(count), low, high)
    return dict(zip(ranges, points.T, strict=True))


def product(tables: Sequence[Columns]) -> dict[str, Floats]:
    """Every combination of the rows of all tables, those of the first changing slowest. No tables: one empty row."""
    lengths = [len(next(iter(table.values()))) for table in tables]
    places = np.indices(lengths).reshape(len(lengths), -1)
    return {
        name: np.asarray(column)[place]
        for table, place in zip(tables, places, strict=True)
        for name, column in table.items()
    }
