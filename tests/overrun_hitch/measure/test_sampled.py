"""What lies between samples, beside SciPy's."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import cumulative_trapezoid
from scipy.interpolate import CubicHermiteSpline

from overrun_hitch.measure.sampled import integrals, refined

SEEDS = st.integers(0, 2**32 - 1)


@given(seed=SEEDS, length=st.integers(1, 40))
def test_integrals_have_scipy_s_bits(seed: int, length: int) -> None:
    random = np.random.default_rng(seed)
    time, samples = np.cumsum(random.exponential(size=length)), random.normal(size=length)
    assert (integrals(samples, time) == cumulative_trapezoid(samples, time, initial=0.0)).all()


@given(seed=SEEDS, length=st.integers(2, 20), parts=st.integers(1, 16))
def test_cubics_are_those_of_scipy(seed: int, length: int, parts: int) -> None:
    random = np.random.default_rng(seed)
    time, samples, rates = (
        np.cumsum(0.01 + random.random(length)),
        random.normal(size=length),
        random.normal(size=length),
    )
    fine, values = refined(time, samples, rates, parts)
    assert (
        len(fine) == parts * (length - 1) + 1 and (fine[::parts] == time).all() and (values[::parts] == samples).all()
    )
    assert values == pytest.approx(CubicHermiteSpline(time, samples, rates)(fine), rel=0, abs=1e-12)


def test_what_rests_rests() -> None:
    """To the last bit, on the level where a clearance begins: nothing may seem to pass it."""
    _, values = refined(np.linspace(0.0, 1.0, 11), np.full(11, 0.1), np.zeros(11), 16)
    assert (values == 0.1).all()
