"""Multiples come out as the decimals that people write; what is no decimal stays, to the last bit."""

from __future__ import annotations

import math
from decimal import Decimal

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from overrun_hitch.decimals import decimals


@given(
    digits=st.integers(1, 9999),
    exponent=st.integers(-6, 0),
    multiple=st.integers(0, 10_000_000),
    sign=st.sampled_from([1, -1]),
)
def test_a_multiple_is_the_nearest_number_to_its_decimal(digits: int, exponent: int, multiple: int, sign: int) -> None:
    step = Decimal(sign * digits).scaleb(exponent)
    assert decimals([multiple * float(step)]) == [float(multiple * step)]


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_nothing_moves_by_more_than_rounding(value: float) -> None:
    (found,) = decimals([value])
    assert abs(found - value) <= 2.0 * math.ulp(value)
    assert decimals([found]) == [found]


def test_measured_values_keep_their_digits() -> None:
    values = np.random.default_rng(0).uniform(0.0, 100.0, 10_000)
    assert sum(a != b for a, b in zip(decimals(values), values, strict=True)) < 30  # some are decimals by chance
    assert all(math.isnan(found) or found == math.inf for found in decimals([math.nan, math.inf]))
