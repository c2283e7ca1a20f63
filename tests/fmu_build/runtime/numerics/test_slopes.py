"""Inputs that move during a step (FMI 2.0: fmi2SetRealInputDerivatives)."""

from __future__ import annotations

from collections.abc import Callable
from math import exp, nan

import numpy as np
import pytest

from tests.fmu_build.runtime.runtime_models import LAG, THRESHOLD
from tests.fmu_build.runtime.runtime_unit import ERROR, OK, Unit


def lag(unit: Callable[..., Unit], tolerance: float) -> Unit:
    u = unit(LAG)
    assert u.setup(tolerance) == OK
    assert u.initialize() == OK
    return u


@pytest.mark.parametrize("tolerance", [1e-5, 1e-8, 1e-11])
def test_against_the_closed_form(unit: Callable[..., Unit], tolerance: float) -> None:
    """x' = u - x with u = 2 t."""
    u = lag(unit, tolerance)
    for step in range(5):
        assert u.set(u=2.0 * step) == OK
        assert u.slopes(u=2.0) == OK
        assert u.step(1.0) == OK
    x, end = u.get("x", "u")
    assert end == 10.0
    print(x - (2 * 5 - 2 + 2 * exp(-5)), u.counters())
    assert x == pytest.approx(2 * 5 - 2 + 2 * exp(-5), rel=5 * tolerance, abs=1e-13)
    assert u.counters().steps < 600
    assert u.counters().rejected < 0.1 * u.counters().steps + 2


def test_slopes_are_forgotten_and_the_input_stays_where_it_is(unit: Callable[..., Unit]) -> None:
    u = lag(unit, 1e-10)
    assert u.slopes(u=3.0) == OK
    assert u.step(1.0) == OK
    x = u.get("x")[0]
    assert u.step(2.0) == OK
    assert u.get("u")[0] == 3.0
    assert u.get("x")[0] == pytest.approx(3 + (x - 3) * exp(-2), rel=1e-9)


def test_one_long_step_is_two_short_ones(unit: Callable[..., Unit]) -> None:
    ends = []
    for sizes in ([0.8], [0.3, 0.5]):
        u = lag(unit, 1e-12)
        for size in sizes:
            assert u.slopes(u=-1.0) == OK
            assert u.step(size) == OK
        ends.append(u.get("x", "u"))
    np.testing.assert_allclose(ends[0], ends[1], rtol=1e-11)


def test_no_slope_leaves_no_trace(unit: Callable[..., Unit]) -> None:
    units = [lag(unit, 1e-6) for _ in range(2)]
    for u in units:
        assert u.set(u=1.0) == OK
    assert units[0].slopes(u=0.0) == OK
    assert [u.step(0.5) for u in units] == [OK, OK]
    assert units[0].get("x", "u").tolist() == units[1].get("x", "u").tolist()
    assert units[0].counters() == units[1].counters()


def test_a_relation_of_the_input_is_located(unit: Callable[..., Unit]) -> None:
    """x' = 1 while u < limit; u = 4 t."""
    u = unit(THRESHOLD, logging=True)
    assert u.set(limit=1.0) == OK
    assert u.initialize() == OK
    assert u.slopes(u=4.0) == OK
    assert u.step(1.0) == OK
    [(text, time)] = u.event_times()
    assert (text, time) == ("u < limit becomes false", pytest.approx(0.25, abs=1e-12))
    assert u.get("x")[0] == pytest.approx(0.25, abs=1e-12)


def test_order_of_convergence_is_kept(unit: Callable[..., Unit]) -> None:
    """A wrong derivative with respect to time costs orders: steps at 1e-11 would be far more."""
    u = lag(unit, 1e-11)
    assert u.slopes(u=1.0) == OK
    assert u.step(4.0) == OK
    assert u.get("x")[0] == pytest.approx(4 - 1 + exp(-4), rel=1e-10)
    assert u.counters().steps < 150


def test_refused(unit: Callable[..., Unit]) -> None:
    u = lag(unit, 1e-6)
    before = u.state()
    assert u.slopes(order=2, u=1.0) == ERROR
    assert u.slopes(order=0, u=1.0) == ERROR
    assert u.slopes(x=1.0) == ERROR
    assert u.messages()[-1] == "the time derivative of x cannot be set to 1: it is no input"
    assert u.slopes(u=nan) == ERROR
    assert u.state() == before
