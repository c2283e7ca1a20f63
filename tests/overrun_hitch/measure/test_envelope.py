"""The logarithmic decrement: of a harmonic, and of a damper of two rates, whose cycles no harmonic fits."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from overrun_hitch.measure.envelope import measured_decrement
from overrun_hitch.measure.oscillation import NoOscillation, fitting, measure

TIME = np.linspace(0.0, 6.0, 601)
OMEGA = 10.0  # rad/s


@given(growth=st.floats(-1.5, 1.0), phase=st.floats(-3.1, 3.1))
@settings(max_examples=25, deadline=None)
def test_a_harmonic(growth: float, phase: float) -> None:
    trace = 0.03 + 0.01 * np.exp(growth * TIME) * np.cos(OMEGA * TIME + phase)
    assert measured_decrement(TIME, trace) == pytest.approx((growth, OMEGA / (2.0 * math.pi)), abs=2e-3)


@pytest.mark.parametrize(("pushed", "pulled"), [(0.1, 0.3), (0.05, 0.15), (0.1, 0.0)])
def test_a_damper_of_two_rates(pushed: float, pulled: float) -> None:
    """Of a mass on a spring: half a cycle with one damping ratio, half with the other, exactly."""

    def rates(_: float, y: list[float]) -> list[float]:
        ratio = pushed if y[1] > 0.0 else pulled
        return [y[1], -(OMEGA**2) * y[0] - 2.0 * ratio * OMEGA * y[1]]

    solved = solve_ivp(rates, (0.0, 6.0), [1.0, 0.0], t_eval=TIME, rtol=1e-9, atol=1e-12, max_step=0.01)
    damped = [OMEGA * math.sqrt(1.0 - ratio**2) for ratio in (pushed, pulled)]
    period = sum(math.pi / each for each in damped)
    decrement = sum(ratio * OMEGA * math.pi / each for ratio, each in zip((pushed, pulled), damped, strict=True))
    seen = 5.0 * period > TIME
    growth, frequency = measured_decrement(TIME[seen], solved.y[0][seen])
    assert growth == pytest.approx(-decrement / period, rel=5e-3)
    assert frequency == pytest.approx(1.0 / period, rel=2e-3)
    assert isinstance(fitting(measure(TIME, solved.y[0])), NoOscillation)


def test_too_little_to_tell() -> None:
    assert np.isnan(measured_decrement(TIME, TIME)).all()
