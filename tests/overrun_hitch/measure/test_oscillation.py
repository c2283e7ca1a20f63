"""The fit finds again what a trace was made of, and says why where it cannot."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from overrun_hitch.measure.oscillation import NoOscillation, Oscillation, measure

Floats = NDArray[np.float64]


def made(time: Floats, growth: float, frequency: float, drift: float = 0.0, phase: float = 0.3) -> Floats:
    """offset 0.026, means as given over the window, both drifting by `drift` of the frequency over it."""
    middle = time - time.mean()
    length = time[-1] - time[0]
    slope = drift * frequency / length
    return 0.026 + 0.01 * np.exp(growth * middle + 0.5 * slope * middle**2) * np.cos(
        2.0 * np.pi * (frequency * middle + 0.5 * slope * middle**2) + phase
    )


@given(
    growth=st.floats(-3.0, 1.0),
    frequency=st.floats(1.0, 8.0),
    drift=st.floats(-0.03, 0.03),
    phase=st.floats(-3.1, 3.1),
    step=st.sampled_from([0.001, 0.01, 0.02]),
)
@settings(max_examples=25, deadline=None)
def test_it_finds_growth_rate_and_frequency(
    growth: float, frequency: float, drift: float, phase: float, step: float
) -> None:
    time = 0.1 + np.arange(round(3.0 / step) + 1) * step
    found = measure(time, made(time, growth, frequency, drift, phase))
    assert isinstance(found, Oscillation)
    assert found.growth_rate == pytest.approx(growth, abs=1e-6)
    assert found.frequency == pytest.approx(frequency, rel=1e-7)
    assert found.offset == pytest.approx(0.026, rel=1e-6)
    assert found.residual < 1e-6


def test_noise_costs_little() -> None:
    time = np.arange(601) * 0.01
    noise = np.random.default_rng(1).normal(0.0, 1e-5, time.size)
    found = measure(time, made(time, -0.5, 1.63, 0.01) + noise)
    assert isinstance(found, Oscillation)
    assert found.growth_rate == pytest.approx(-0.5, abs=1e-3)
    assert found.frequency == pytest.approx(1.63, rel=1e-3)


def test_another_trace_of_the_same_motion() -> None:
    time = np.arange(401) * 0.01
    found = measure(time, made(time, -0.5, 1.63, 0.01, phase=0.3))
    assert isinstance(found, Oscillation)
    assert found.offset_of(time, 7.0 - 300.0 * made(time, -0.5, 1.63, 0.01, phase=1.9)) == pytest.approx(
        7.0 - 7.8, rel=1e-6
    )


@pytest.mark.parametrize(
    ("trace", "reason"),
    [
        (lambda time: np.full_like(time, 0.1), "constant"),
        (lambda time: np.zeros_like(time), "constant"),
        (lambda time: made(time, -0.5, 0.25), "only 1.5 periods"),
        (lambda time: np.exp(-time), "oscillate|periods"),
        (lambda time: made(time, -54.0, 5.7), "only 1.5 periods"),
    ],
)
def test_a_trace_that_cannot_be_measured_says_why(trace: object, reason: str) -> None:
    time = np.arange(601) * 0.01
    found = measure(time, trace(time))  # type: ignore[operator]
    assert isinstance(found, NoOscillation), found
    assert any(word in found.reason for word in reason.split("|")), found.reason


def test_too_few_samples() -> None:
    assert measure(np.arange(5) * 0.1, np.zeros(5)) == NoOscillation("only 5 samples")
