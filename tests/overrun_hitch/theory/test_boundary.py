"""The stability boundary: growth below, decay above, and two derivations that know nothing of eigenvalues."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from overrun_hitch.parameters import CASES, HitchError, Parameters
from overrun_hitch.theory.boundary import critical_damping, light_damping_estimate
from overrun_hitch.theory.linear import shunting_mode

SPEEDS = (10.0, 20.0, 40.0)


def growth_rate(parameters: Parameters, C: float, V: float) -> float:
    return float(shunting_mode(parameters.changed({"C": C}), V).growth_rate)


def frequency(parameters: Parameters, C: float, V: float) -> float:
    """rad/s."""
    return float(shunting_mode(parameters.changed({"C": C}), V).eigenvalue.imag)


def damper_for(parameters: Parameters, V: float, s: complex) -> complex:
    """The C with which s is an eigenvalue: the paper's linear equations with the wheels eliminated, solved for C."""
    p = parameters
    J_c, J_t = p.I_c / p.R_c**2, p.I_t / p.R_t**2
    lag_c, lag_t = 1.0 + s * J_c * V / p.C_kc, 1.0 + s * J_t * V / p.C_kt
    m_c, m_t = p.M_c + J_c / lag_c, p.M_t + J_t / lag_t
    return -((s**2 + p.r / p.R_t / (m_t * lag_t)) / (1.0 / m_c + 1.0 / m_t) + p.k) / s


@st.composite
def combinations(draw: st.DrawFn) -> Parameters:
    """Cars and trailers from toys to lorries."""
    k = draw(st.floats(500.0, 1e5))
    return Parameters(
        M_c=draw(st.floats(300.0, 10e3)),
        M_t=draw(st.floats(100.0, 10e3)),
        I_c=draw(st.floats(0.5, 20.0)),
        I_t=draw(st.floats(0.5, 20.0)),
        R_c=draw(st.floats(0.2, 0.5)),
        R_t=draw(st.floats(0.2, 0.5)),
        C_kc=draw(st.floats(1e5, 1e6)),
        C_kt=draw(st.floats(1e5, 1e6)),
        k=k,
        r=k * draw(st.floats(0.1, 20.0)),
    )


@given(combinations(), st.floats(2.0, 60.0))
@settings(max_examples=150, deadline=None)
def test_growth_below_and_decay_above(parameters: Parameters, V: float) -> None:
    C = critical_damping(parameters, V)
    if C == 0.0:
        assert growth_rate(parameters, 0.0, V) <= 0.0
    else:
        assert growth_rate(parameters, (1.0 - 1e-4) * C - 1e-6, V) > 0.0
    assert growth_rate(parameters, (1.0 + 1e-4) * C + 1e-6, V) < 0.0


@given(combinations(), st.floats(2.0, 60.0))
@settings(max_examples=100, deadline=None)
def test_the_wheels_eliminated_by_hand_give_the_same_damper(parameters: Parameters, V: float) -> None:
    C = critical_damping(parameters, V)
    if C > 0.0:
        assert damper_for(parameters, V, 1j * frequency(parameters, C, V)) == pytest.approx(C, rel=1e-6, abs=1e-4)


@given(combinations(), st.floats(2.0, 60.0))
@settings(max_examples=100, deadline=None)
def test_closed_form_for_light_damping(parameters: Parameters, V: float) -> None:
    """To the stated (w T)^2 of the term that feeds the oscillation, where the lags are short."""
    p = parameters
    J_t = p.I_t / p.R_t**2
    lag = V * max(p.I_c / p.R_c**2 / p.C_kc, J_t / p.C_kt)
    exact = critical_damping(p, V)
    small = (lag * frequency(p, exact, V)) ** 2
    if small > 0.1:
        return
    estimate = light_damping_estimate(p, V)
    fed = estimate - light_damping_estimate(p.changed({"r": 0.0}), V)
    assert exact == pytest.approx(max(estimate, 0.0), abs=1.2 * small * fed + 1e-4)


def test_closed_form_of_the_papers_cases() -> None:
    errors = {
        (case, V): light_damping_estimate(CASES[case], V) / critical_damping(CASES[case], V) - 1.0
        for case in CASES
        for V in SPEEDS
    }
    assert min(errors.values()) == errors["vi", 10.0] == pytest.approx(0.7e-4, abs=0.05e-4)
    assert max(errors.values()) == errors["ix", 40.0] == pytest.approx(0.37e-2, abs=0.005e-2)


@pytest.mark.parametrize(("case", "expected"), [("i", 51.896), ("ii", 60.425), ("iii", 65.121)])
def test_rises_with_speed_nearly_in_proportion(case: str, expected: float) -> None:
    """Claims 7 and 8: iii needs the strongest damper; a higher V is destabilising at low C."""
    slow, middle, fast = (critical_damping(CASES[case], V) for V in SPEEDS)
    assert middle == pytest.approx(expected, abs=1e-3)
    assert slow == pytest.approx(0.5 * middle, rel=1e-3)
    assert fast == pytest.approx(2.0 * middle, rel=2e-3)


@given(combinations())
@settings(max_examples=20, deadline=None)
def test_rises_with_speed(parameters: Parameters) -> None:
    """While the lag of the wheels is short beside the oscillation."""
    slow, middle, fast = (critical_damping(parameters, V) for V in (2.0, 5.0, 10.0))
    rounding = 1e-5  # N.s/m; some combinations lie on the boundary without a damper
    assert slow <= middle + rounding <= fast + 2.0 * rounding


def test_own_damper_does_not_count() -> None:
    assert critical_damping(CASES["ii"].changed({"C": 7.0}), 20.0) == critical_damping(CASES["ii"], 20.0)


def test_without_a_trailer_brake_no_damper_is_needed() -> None:
    assert critical_damping(Parameters(r=0.0), 40.0) == 0.0
    assert light_damping_estimate(Parameters(r=0.0), 40.0) < 0.0


def test_no_shunting_mode() -> None:
    with pytest.raises(HitchError, match=r"no shunting mode"):
        critical_damping(Parameters(k=0.0, r=0.0), 20.0)
