"""The describing function of the drawbar against quadrature, and the cycles that it predicts."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from overrun_hitch.parameters import CASES
from overrun_hitch.theory.describing_function import predicted_cycles, ramp_gain
from overrun_hitch.theory.linear import shunting_mode


@given(st.floats(-3.0, 3.0), st.floats(1e-3, 10.0))
def test_gains_are_fourier_coefficients(bias: float, amplitude: float) -> None:
    def ramp(angle: float) -> float:
        return max(0.0, bias + amplitude * np.sin(angle))

    kinks = np.arcsin(np.clip(-bias / amplitude, -1.0, 1.0))
    points = sorted({float(kinks % (2.0 * np.pi)), float((np.pi - kinks) % (2.0 * np.pi))})
    mean = quad(ramp, 0.0, 2.0 * np.pi, points=points)[0] / (2.0 * np.pi)
    first = quad(lambda angle: ramp(angle) * np.sin(angle), 0.0, 2.0 * np.pi, points=points)[0] / np.pi
    assert ramp_gain(bias, amplitude) == pytest.approx((mean, first / amplitude), abs=1e-7)


@pytest.mark.parametrize("eps", [0.02, 0.1])
def test_where_cycles_are(eps: float) -> None:
    """None above the damper of the linear boundary (120.65 N.s/m), just below it one that enters the clearance."""
    push = 488.0
    steady = push / (CASES["ii"].k + CASES["ii"].r / CASES["ii"].R_t)

    def cycles(C: float) -> list[float]:
        return [
            c.amplitude for c in predicted_cycles(CASES["ii"].changed({"C": C, "eps": eps}), 40.0, push) if c.is_stable
        ]

    assert cycles(121.0) == []
    assert cycles(120.0) == pytest.approx([steady], rel=0.1)
    amplitudes = [cycles(C)[0] for C in (120.0, 110.0, 100.0, 90.0)]
    assert amplitudes == sorted(amplitudes)


def test_a_cycle_is_neither_growing_nor_decaying() -> None:
    """With the gains of its amplitude the linear mode is at the boundary, at the cycle's frequency."""
    p = CASES["ii"].changed({"C": 100.0, "eps": 0.1})
    (cycle,) = predicted_cycles(p, 40.0, 488.0)
    _, gain = ramp_gain(cycle.mean - p.eps, cycle.amplitude)
    mode = shunting_mode(p.changed({"k": gain * p.k, "r": gain * p.r}), 40.0)
    assert float(mode.growth_rate) == pytest.approx(0.0, abs=1e-7)
    assert float(mode.frequency) == pytest.approx(cycle.frequency, rel=1e-9)


def test_cycles_scale_with_the_push() -> None:
    p = CASES["ii"].changed({"C": 100.0, "eps": 0.1})
    (once,), (twice,) = predicted_cycles(p, 40.0, 200.0), predicted_cycles(p, 40.0, 400.0)
    assert twice.amplitude == pytest.approx(2.0 * once.amplitude, rel=1e-6)
    assert twice.frequency == pytest.approx(once.frequency, rel=1e-6)
