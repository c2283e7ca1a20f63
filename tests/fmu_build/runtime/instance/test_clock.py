"""The caller's clock: rounded, summed up, far from zero, and over the stop time."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from tests.fmu_build.runtime.runtime_models import LAG, SMOOTH
from tests.fmu_build.runtime.runtime_unit import ERROR, OK, Unit

Create = Callable[..., Unit]
STARTS = [0.0, 0.05, 1e6, 1.7e9]


def started(unit: Create, start: float, stop: float | None = None) -> Unit:
    u = unit(LAG)
    assert u.setup(1e-9, start, stop) == OK
    assert u.set(u=1.0) == OK
    assert u.initialize() == OK
    return u


@pytest.mark.parametrize("start", STARTS)
def test_a_clock_in_microseconds(unit: Create, start: float) -> None:
    """Steps of a sixtieth of a second begin and end at rounded times; the way is made whole, a warning given once."""
    u = started(unit, start)
    points = [round(start + n / 60.0, 6) for n in range(121)]
    for point in points[:-1]:
        assert u.step(1.0 / 60.0, point) == OK, u.log
    time, x = u.get("time", "x")
    assert time == points[-2] + 1.0 / 60.0
    assert x == pytest.approx(1.0 - np.exp(-(time - start)), rel=1e-7)
    warnings = u.messages("logStatusWarning")
    assert len(warnings) == (1 if start < 1e9 else 0)  # there times are no finer than that
    assert all("is not quite where the instance is" in warning for warning in warnings)


@pytest.mark.parametrize("start", STARTS)
@pytest.mark.parametrize("size", [1e-3, 0.01, 1.0])
def test_a_step_that_skips_one_is_refused(unit: Create, start: float, size: float) -> None:
    u = started(unit, start)
    assert u.step(size, start) == OK
    before = u.state()
    for wrong in (start + 2 * size, start + 1.05 * size, start + 0.95 * size, start):
        assert u.step(size, wrong) == ERROR
        assert "the instance is at t = " in u.messages()[-1]
        assert u.state() == before
    assert u.step(size, start + size) == OK
    assert u.messages("logStatusWarning") == []


@pytest.mark.parametrize("start", STARTS)
def test_times_that_are_summed_up_or_multiplied(unit: Create, start: float) -> None:
    summed, multiplied = started(unit, start), started(unit, start)
    time = start
    for n in range(10_000):
        assert summed.step(1e-3, time) == OK
        time += 1e-3
        assert multiplied.step(1e-3, start + n * 1e-3) == OK
    assert summed.get("time")[0] == time
    assert summed.log == multiplied.log == []


def test_the_last_step_goes_over_the_stop_time(unit: Create) -> None:
    """As that of the standards' example does, `while (tc < stopTime)`; one that begins at it is past it."""
    u = started(unit, 0.0, 1.0)
    for n in range(4):
        assert u.step(0.3, 0.3 * n) == OK
    assert u.get("time")[0] == pytest.approx(1.2)
    before = u.state()
    assert u.step(0.3, 0.3 * 4) == ERROR
    assert "the stop time is 1 s" in u.messages()[-1]
    assert u.state() == before
    u = started(unit, 0.0, 1.0)
    assert u.step(1.0, 0.0) == OK
    assert u.step(1e-3, 1.0) == ERROR


def test_a_stop_time_leaves_no_trace(unit: Create) -> None:
    rows = []
    for stop in (None, 2.0, 50.0):
        u = unit(SMOOTH)
        assert u.setup(1e-6, 0.0, stop) == OK
        assert u.initialize() == OK
        rows.append(u.run(2.0, 0.01, ["x", "y"]))
    assert np.array_equal(rows[0], rows[1])
    assert np.array_equal(rows[0], rows[2])
