"""Relations: where they change, what they do at their surfaces, and what happens when they never come to rest."""

from __future__ import annotations

from collections.abc import Callable
from math import cos, pi, sin

import numpy as np
import pytest

from tests.fmu_build.runtime.runtime_models import NO_STATES, OSCILLATOR, PARADOX, PULSE, SLIDING
from tests.fmu_build.runtime.runtime_unit import DISCARD, ERROR, OK, Unit


def oscillator(unit: Callable[..., Unit], tolerance: float, **values: float) -> Unit:
    u = unit(OSCILLATOR, logging=True)
    assert u.setup(tolerance) == OK
    assert u.set(**values) == OK
    assert u.initialize() == OK
    return u


def test_zero_clearance_from_the_surface(unit: Callable[..., Unit]) -> None:
    """Half waves of p = 4 (pi / 2 long) and of q = 900 (pi / 30 long) in turn; v = +1, -1 at the crossings."""
    u = oscillator(unit, 1e-12)
    u.run(5.0, 0.01, ["x"])
    first, second = pi / 2, pi / 30
    crossings = np.cumsum([first, second] * 3)
    events = u.event_times()
    assert events[0] == ("x > gap becomes true", 0.0)
    located = np.array([t for _, t in events[1:]]).reshape(-1, 2)
    expected = crossings[crossings < 5]
    print("errors of the event times:", located[:, 0] - expected)
    assert np.all(located[:, 0] == located[:, 1])  # both relations change together
    np.testing.assert_allclose(located[:, 0], expected, rtol=0, atol=1e-12)
    assert u.counters().events == 1 + len(expected)


def test_starts_towards_the_other_side(unit: Callable[..., Unit]) -> None:
    u = oscillator(unit, 1e-10, v=-1.0)
    assert u.step(0.05) == OK
    assert u.event_times() == [("x < 0 becomes true", 0.0)]
    assert u.get("x")[0] == pytest.approx(-sin(30 * 0.05) / 30, abs=1e-11)


def test_rests_on_the_surface(unit: Callable[..., Unit]) -> None:
    u = oscillator(unit, 1e-6, v=0.0)
    u.run(1.0, 0.1, ["x"])
    assert u.counters().events == 0
    assert u.counters().steps < 60
    assert u.get("x")[0] == 0.0


@pytest.mark.parametrize("size", [0.01, 0.1, 3.0])
def test_finite_clearance(unit: Callable[..., Unit], size: float) -> None:
    """Across the gap, half a wave above it, back across it, half a wave below zero."""
    gap = 0.25
    u = oscillator(unit, 1e-12, gap=gap, x=0.1)
    u.run(3.0, size, ["x"])
    expected = np.cumsum([gap - 0.1, pi / 2, gap, pi / 30, gap])
    times = [t for _, t in u.event_times()]
    print("errors of the event times:", np.array(times) - expected[: len(times)])
    assert [text for text, _ in u.event_times()] == [
        "x > gap becomes true",
        "x > gap becomes false",
        "x < 0 becomes true",
        "x < 0 becomes false",
        "x > gap becomes true",
    ][: len(times)]
    assert len(times) == 5
    np.testing.assert_allclose(times, expected, rtol=0, atol=2e-12)


def test_state_behind_an_event_is_accurate(unit: Callable[..., Unit]) -> None:
    """One long communication step with events inside: the error stays that of the tolerance."""
    for tolerance in (1e-5, 1e-7, 1e-9):
        u = oscillator(unit, tolerance, p=100.0, q=2500.0)
        assert u.step(10.0) == OK
        period = pi / 10 + pi / 50
        phase = 10.0 % period
        x = sin(10 * phase) / 10 if phase < pi / 10 else -sin(50 * (phase - pi / 10)) / 50
        v = cos(10 * phase) if phase < pi / 10 else -cos(50 * (phase - pi / 10))
        error = np.abs(u.get("x", "v") - [x, v])
        print(tolerance, error, u.counters())
        assert error.max() < 5 * tolerance  # with states from the dense output of whole steps: up to 25


@pytest.mark.parametrize("disturbed", [False, True])
def test_crossed_and_crossed_back(unit: Callable[..., Unit], disturbed: bool) -> None:
    """Nothing but the relation makes a step shorter than ten communication steps, at whose ends it is looked at.

    If something is set before each step, integrator steps end there too, and quarters of them are looked at.
    """
    u = unit(PULSE, logging=True)
    half = 0.15 if disturbed else 0.5
    u.set(centre=5.4, half=half)
    assert u.initialize() == OK
    for n in range(10):
        if disturbed:
            u.set(half=half * (1.0 + 1e-15 * (n % 2)))
        assert u.step(1.0) == OK
    print(u.counters(), u.event_times())
    assert u.counters().steps < 60
    np.testing.assert_allclose([t for _, t in u.event_times()], [5.4 - half, 5.4 + half], atol=1e-14)
    assert u.get("y")[0] == pytest.approx(2.0 * half, abs=1e-13)


def test_time_event_without_states(unit: Callable[..., Unit]) -> None:
    u = unit(NO_STATES, logging=True)
    assert u.initialize() == OK
    assert u.run(0.5, 0.1, ["y"])[:, 0].tolist() == [1.0, 1.0, 1.0, 2.0, 2.0, 2.0]
    [(_, time)] = u.event_times()
    assert 0.255 < time < 0.255 + 2e-12  # where the residual, here in s, leaves the band that is taken for rounding
    assert u.set(u=-3.0) == OK
    assert u.get("y")[0] == -6.0


def test_sliding_ends_with_the_name_of_the_relation(unit: Callable[..., Unit]) -> None:
    u = unit(SLIDING)
    assert u.initialize() == OK
    assert u.step(0.5) == OK
    assert u.step(1.0) == DISCARD
    (message,) = u.messages("logStatusWarning")
    assert "x > 0" in message and "t = 1 s" in message
    assert u.get("time", "x") == pytest.approx([0.5, 0.5], abs=1e-9)  # back where it was


def test_contradiction_is_refused(unit: Callable[..., Unit]) -> None:
    u = unit(PARADOX)
    assert u.initialize() == ERROR
    assert "lie" in u.messages()[-1]


def test_truths_follow_a_changed_parameter(unit: Callable[..., Unit]) -> None:
    u = oscillator(unit, 1e-9, x=0.2, v=0.0)
    assert u.get("der_v")[0] == pytest.approx(-0.8)
    assert u.set(gap=0.3) == OK
    assert u.get("der_v")[0] == 0.0
    assert u.step(0.1) == OK
    assert u.get("x")[0] == pytest.approx(0.2, abs=1e-15)


def test_short_contact_after_a_long_flight(unit: Callable[..., Unit]) -> None:
    """Half a wave of 30 ms beyond a surface that was reached after a thousand seconds of free flight."""
    u = oscillator(unit, 1e-8, gap=1.0, x=0.0, v=1e-3, p=1e4, q=1.0)
    assert u.step(1500.0) == OK
    grazing = pi / 100
    times = [t for _, t in u.event_times()][:2]
    assert times[0] == pytest.approx(1000.0, rel=1e-9)
    assert times[1] - times[0] == pytest.approx(grazing, rel=1e-6)
