"""Traces between their samples: smooth where they are, and never over a jump."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from overrun_hitch.measure.noise import noise
from overrun_hitch.measure.resampling import is_even, jumps, resampled


@given(st.lists(st.floats(0.05, 0.95), min_size=1, max_size=4, unique_by=lambda x: round(x, 2)), st.floats(-10, 10))
def test_nothing_is_interpolated_over_a_jump(places: list[float], height: float) -> None:
    """A straight line that jumps: every value lies on the line of its own piece, at the jump on that after it."""
    places = sorted(places)
    grid = np.linspace(0.0, 1.0, 41)
    grid = grid[np.abs(grid[:, None] - places).min(axis=1) > 1e-3]
    time = np.sort(np.concatenate([grid, places, places]))
    pieces = np.zeros(len(time))
    pieces[jumps(time)] = 1.0
    trace = 3.0 * time + height * np.cumsum(pieces)
    at = np.append(np.random.default_rng(1).uniform(0.0, 1.0, 200), places)
    expected = 3.0 * at + height * np.searchsorted(places, at, side="right")
    np.testing.assert_allclose(resampled(time, trace, at), expected, atol=1e-6 * (1.0 + abs(height)))


def test_it_is_the_samples_at_their_times_and_of_third_order_between() -> None:
    at, errors = np.linspace(0.3, 0.7, 777), []
    for n in (50, 100, 200):
        time = np.linspace(0.0, 1.0, n) ** 1.5
        np.testing.assert_allclose(resampled(time, np.sin(9.0 * time), time), np.sin(9.0 * time), atol=1e-14)
        errors.append(np.abs(resampled(time, np.sin(9.0 * time), at) - np.sin(9.0 * at)).max())
    assert (np.log2(np.divide(errors[:-1], errors[1:])) > 2.0).all()


@pytest.mark.parametrize(("step", "even"), [(0.01, True), (0.1, True), (1e-5, True)])
def test_an_even_grid_is_known_as_such(step: float, even: bool) -> None:
    time = np.arange(1000) * step
    assert is_even(time) is even and is_even(time + 7.0) is even
    assert not is_even(np.append(time, time[-1] + 1.01 * step))
    assert not is_even(np.insert(time, 500, time[500]))


def test_noise_is_found_beside_a_motion_and_jumps() -> None:
    time, random = np.arange(2000) * 0.01, np.random.default_rng(5)
    motion = np.sin(10.0 * time) + (time > 9.0)
    for sigma in (0.003, 0.03):
        assert noise(motion + sigma * random.normal(size=2000)) == pytest.approx(sigma, rel=0.1)
