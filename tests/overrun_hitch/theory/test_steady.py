"""Equation 15 against the paper's numbers, its claims, and the nonlinear equations of motion."""

from __future__ import annotations

import numpy as np
import pytest

from overrun_hitch.parameters import CASES, FIGURES, HitchError
from overrun_hitch.theory.steady import steady
from tests.oracles import radau

RATIOS = {"i": 0.90, "ii": 0.95, "iii": 0.98} | dict.fromkeys(["iv", "v", "vi", "vii", "viii", "ix"], 0.95)


@pytest.mark.parametrize(("case", "printed"), RATIOS.items())
def test_claim_1_deceleration_ratio(case: str, printed: float) -> None:
    assert steady(CASES[case], 1000.0).ratio == pytest.approx(printed, abs=5e-4)


@pytest.mark.parametrize("case", ["i", "ii", "iii"])
def test_claim_2_one_centimetre_per_metre_per_second_squared(case: str) -> None:
    result = steady(CASES[case], 1000.0)
    assert pytest.approx(0.01, rel=2e-3) == result.D / -result.A


@pytest.mark.parametrize("case", CASES)
def test_claim_3_damping_and_speed_do_not_enter_and_k_with_r_scales_compression(case: str) -> None:
    p = CASES[case]
    result = steady(p, 1000.0)
    assert steady(p.changed({"C": 3200.0, "V_0": 10.0}), 1000.0) == result
    scaled = steady(p.changed({"k": 3.0 * p.k, "r": 3.0 * p.r}), 1000.0)
    assert scaled.ratio == pytest.approx(result.ratio, rel=1e-14)
    assert pytest.approx(result.D / 3.0, rel=1e-14) == scaled.D


def test_clearance_adds_to_the_compression_alone() -> None:
    without, with_clearance = steady(FIGURES["8"].parameters, 1000.0), steady(FIGURES["10"].parameters, 1000.0)
    assert pytest.approx(without.D + 0.1, rel=1e-14) == with_clearance.D
    assert with_clearance.A == without.A


@pytest.mark.parametrize("F_0", [100.0, 500.0])
def test_a_threshold_is_pushed_and_braked_beyond(F_0: float) -> None:
    """Each vehicle's own balance of forces; a push within the threshold moves the frame alone."""
    p, torque = FIGURES["10"].parameters.changed({"F_0": F_0}), 1000.0
    car, trailer = p.M_c + p.I_c / p.R_c**2, p.M_t + p.I_t / p.R_t**2
    s = steady(p, torque)
    push = car * s.A + torque / p.R_c
    beyond = s.D - p.eps - F_0 / p.k_t
    assert pytest.approx(F_0 + p.k * beyond, rel=1e-12) == push
    assert -trailer * s.A == pytest.approx(push + p.r / p.R_t * beyond, rel=1e-12)
    assert s.A_c < s.A < 0.0 and s.ratio == pytest.approx(s.A / s.A_c)
    gentle = steady(p, 0.1 * torque)
    if F_0 == 500.0:
        assert pytest.approx(-0.1 * torque / p.R_c / (car + trailer), rel=1e-14) == gentle.A
        assert pytest.approx(p.eps - trailer * gentle.A / p.k_t, rel=1e-12) == gentle.D
    edge = torque * F_0 / (trailer * car / (car + trailer)) / (torque / p.R_c / car)  # where the threshold is reached
    below, above = steady(p, edge * (1.0 - 1e-12)), steady(p, edge * (1.0 + 1e-12))
    assert pytest.approx(below.A, rel=1e-9) == above.A and pytest.approx(below.D, rel=1e-9) == above.D


@pytest.mark.parametrize("figure", ["8", "10"])
def test_it_satisfies_the_nonlinear_equations_of_motion(figure: str) -> None:
    """Rates at the steady state: all zero but a common deceleration, to the slip's share of the wheels' inertia."""
    p = FIGURES[figure].parameters
    s = steady(p, 1000.0)
    V = 30.0
    slip_c = -(p.M_c * s.A - p.k * (s.D - p.eps)) / p.C_kc
    slip_t = -(p.M_t * s.A + p.k * (s.D - p.eps)) / p.C_kt
    state = np.array([s.D, V, V, V * (1.0 - slip_c) / p.R_c, V * (1.0 - slip_t) / p.R_t])
    rates = radau.derivatives(p, 1000.0, radau.COMPRESSION, state)
    assert rates[:3] == pytest.approx([0.0, s.A, s.A], rel=1e-12)
    assert rates[3:] == pytest.approx([s.A / p.R_c, s.A / p.R_t], rel=1e-12)


def test_nothing_between_car_and_trailer_has_no_steady_state() -> None:
    with pytest.raises(HitchError, match=r"^k = 0 N/m and r = 0 N.m/m"):
        steady(CASES["ii"].changed({"k": 0.0, "r": 0.0}), 1000.0)
