"""A brake that lags: the boundary from the whole matrix, beside a table computed elsewhere and the closed form."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from overrun_hitch.parameters import CASES, HitchError
from overrun_hitch.theory.boundary import critical_damping, light_damping_estimate
from overrun_hitch.theory.linear import compression_matrix, equations_of_motion, shunting_mode
from overrun_hitch.theory.steady import steady

SPEEDS = (5.0, 10.0, 20.0, 40.0)  # m/s
# C_crit (N.s/m) of case ii by tau_b (s), from eigenvalues of a 6x6 system written by other hands.
TABLE = {
    0.0001: (18, 33, 64, 124),
    0.005: (170, 185, 215, 275),
    0.010: (322, 337, 367, 426),
    0.020: (611, 626, 655, 712),
    0.050: (1283, 1295, 1321, 1370),
}
GROWTH = {(0.005, 250.0, 40.0): 0.0358, (0.02, 500.0, 40.0): 0.2936, (0.02, 900.0, 10.0): -0.3817,
          (0.05, 1500.0, 40.0): -0.1596}  # fmt: skip


@pytest.mark.parametrize("tau_b", TABLE)
def test_the_boundary_is_the_tables(tau_b: float) -> None:
    p = CASES["ii"].changed({"tau_b": tau_b})
    found = [critical_damping(p, V) for V in SPEEDS]
    np.testing.assert_allclose(found, TABLE[tau_b], rtol=0.0, atol=0.51)


@pytest.mark.parametrize(("tau_b", "C", "V"), GROWTH)
def test_growth_at_held_speed(tau_b: float, C: float, V: float) -> None:
    p = CASES["ii"].changed({"tau_b": tau_b, "C": C})
    assert float(shunting_mode(p, V).growth_rate) == pytest.approx(GROWTH[tau_b, C, V], abs=5.1e-5)


@given(case=st.sampled_from(sorted(CASES)), tau_b=st.floats(1e-4, 0.05), V=st.sampled_from(SPEEDS))
def test_the_lags_share_of_the_boundary_in_closed_form(case: str, tau_b: float, V: float) -> None:
    """What theory adds for the lag is what the closed form adds, to some per cent; and some 31 N.s/m a millisecond."""
    p = CASES[case]
    lagging = p.changed({"tau_b": tau_b})
    added = critical_damping(lagging, V) - critical_damping(p, V)
    estimated = light_damping_estimate(lagging, V) - light_damping_estimate(p, V)
    assert estimated == pytest.approx(added, rel=0.035 if case == "ii" else 0.08)
    if case == "ii" and tau_b < 0.01:
        assert added == pytest.approx(31e3 * tau_b, rel=0.03)


@given(tau_b=st.floats(1e-6, 1.0), sigma=st.sampled_from([0.0, 0.4]))
def test_the_lag_leaves_what_is_steady(tau_b: float, sigma: float) -> None:
    p = CASES["ii"].changed({"sigma": sigma})
    lagging = p.changed({"tau_b": tau_b})
    assert steady(lagging, 1000.0) == steady(p, 1000.0)
    prompt, matrix = compression_matrix(p, 20.0), compression_matrix(lagging, 20.0)
    # A torque that has settled acts as the prompt one: with T put in, the matrices are the same.
    n = len(prompt)
    settled = matrix[:n, :n] - np.outer(matrix[:n, n], matrix[n, :n]) / matrix[n, n]
    np.testing.assert_allclose(settled, prompt, rtol=1e-12, atol=1e-9)


def test_a_short_lag_is_none() -> None:
    p = CASES["ii"]
    for V in SPEEDS:
        short = shunting_mode(p.changed({"tau_b": 1e-7}), V).eigenvalue
        assert abs(short - shunting_mode(p, V).eigenvalue) < 1e-4


def test_the_papers_equations_refuse_it() -> None:
    with pytest.raises(HitchError, match=r"^the paper's equations do not know tau_b = 0\.02 s$"):
        equations_of_motion(CASES["ii"].changed({"tau_b": 0.02}), 40.0)
