"""Long grids: some of their points for `make test`, the others marked for `make test-all`."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from itertools import product

import pytest
from _pytest.mark import ParameterSet


def spread(*axes: Iterable[object], every: int = 1) -> list[ParameterSet]:
    """The grid of the axes, sampled by as many points as the longest has: every value of every axis is in one.

    With `every` 2, of the longest every other value is.
    """
    values = [list(axis) for axis in axes]
    longest = max(map(len, values))
    points = range(-(-longest // every))
    chosen = {tuple((n * every if len(axis) == longest else n) % len(axis) for axis in values) for n in points}
    return [
        pytest.param(*(axis[n] for axis, n in zip(values, place, strict=True)), marks=_full(place not in chosen))
        for place in product(*(range(len(axis)) for axis in values))
    ]


def sampled(values: Iterable[object], chosen: Collection[object]) -> list[ParameterSet]:
    """The values, sampled by some of them."""
    return [pytest.param(value, marks=_full(value not in chosen)) for value in values]


def _full(left_out: bool) -> list[pytest.MarkDecorator]:
    return [pytest.mark.full] if left_out else []
