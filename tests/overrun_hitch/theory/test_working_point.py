"""Small motions about a steady state: forces that balance, slopes that are those of the laws."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from overrun_hitch.parameters import CASES, DATUM, HitchError, Parameters
from overrun_hitch.theory.linear import check_known, compression_matrix, shunting_mode
from overrun_hitch.theory.steady import braking_at, inertias, steady
from overrun_hitch.theory.working_point import C_x, curvature, tyre_slope, working_point

DEVICE = {"eps": 0.01, "F_0": 150.0, "x_2": 0.02, "k_2": 9e3, "x_3": 0.035, "k_3": 2e4, "travel": 0.055}


def spring(p: Parameters, D: float) -> float:
    """The closed form: what each change of stiffness adds."""
    ends = (p.eps, p.gives_from, p.eps + p.x_2, p.eps + p.x_3, p.travel)
    slopes = (0.0, p.k_t, p.k, p.k_2, p.k_3, p.k_buffer)
    return sum((b - a) * max(D - end, 0.0) for end, a, b in zip(ends, slopes, slopes[1:], strict=False))


@given(deceleration=st.floats(0.05, 9.0))
def test_forces_balance_on_every_piece(deceleration: float) -> None:
    p = DATUM.changed(DEVICE)
    car, trailer = inertias(p)
    _, D, torque = braking_at(p, deceleration)
    brake = p.r / p.R_t * max(D - p.gives_from, 0.0)
    assert trailer * deceleration == pytest.approx(spring(p, D) + brake)
    assert car * deceleration == pytest.approx(torque / p.R_c - spring(p, D))
    found = steady(p, torque)
    assert pytest.approx((-deceleration, D)) == (found.A, found.D)


def test_the_stiffness_is_that_where_the_drawbar_rests() -> None:
    p = DATUM.changed(DEVICE)
    points = [working_point(p, deceleration) for deceleration in (0.1, 0.0, 1.0, 3.0, 5.0, 9.0)]
    assert [point.stiffness for point in points] == ["k_t", "k", "k", "k_2", "k_3", "k_buffer"]
    assert [point.linear.k for point in points] == [p.k_t, p.k, p.k, p.k_2, p.k_3, p.k_buffer]
    assert [point.linear.r for point in points] == [0.0, *[p.r] * 5]
    for point in points:
        assert point.reach[0] <= point.compression < point.reach[1]


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("deceleration", [0.0, 5.0])
def test_the_papers_drawbar_is_its_own(case: str, deceleration: float) -> None:
    point = working_point(CASES[case], deceleration)
    assert point.linear == CASES[case]
    assert point.reach == (0.0, math.inf)


@given(X=st.floats(0.0, 1.5), E_x=st.floats(0.344, 0.99))
def test_the_tyres_slope_is_that_of_the_magic_formula(X: float, E_x: float) -> None:
    def force(X: float) -> float:
        return math.sin(C_x * math.atan(X - E_x * (X - math.atan(X))))

    step = 1e-6
    slope = (force(X + step) - force(X - step)) / (2.0 * step * C_x)
    assert tyre_slope(force(X), 1.0, E_x, "") == pytest.approx(slope, abs=1e-8)


@given(mu=st.floats(0.05, 3.0), mu_slide=st.floats(0.5, 0.95))
def test_a_locked_wheel_brakes_with_its_share_of_the_peak(mu: float, mu_slide: float) -> None:
    p = DATUM.changed({"mu": mu, "mu_slide": mu_slide})
    X, E_x = p.C_kc / (C_x * mu * p.M_c * 9.80665), curvature(p.C_kc, p.M_c, p)
    assert math.sin(C_x * math.atan(X - E_x * (X - math.atan(X)))) == pytest.approx(mu_slide, rel=1e-9)
    assert curvature(p.C_kc, p.M_c, DATUM) == 0.344


def test_friction_takes_what_the_tyres_hold() -> None:
    slopes = [working_point(DATUM.changed({"mu": mu}), 5.0).linear.C_kc for mu in (0.6, 0.8, 1.2, 1e9)]
    assert slopes == sorted(slopes) and slopes[0] < 0.5 * DATUM.C_kc and slopes[-1] == DATUM.C_kc
    with pytest.raises(HitchError, match=r"^mu does not allow 5 m/s2: that takes 5274 N, friction gives 2942 N"):
        working_point(DATUM.changed({"mu": 0.3}), 5.0)


@pytest.mark.parametrize("changes", [{"CdA_c": 0.7}, {"CdA_t": 2.0}, {"C_rr": 0.01}])
def test_what_theory_does_not_know_is_refused_by_name(changes: dict[str, float]) -> None:
    ((name, value),) = changes.items()
    for refused in (check_known, lambda p: shunting_mode(p, 20.0)):
        with pytest.raises(HitchError, match=rf"^linear theory does not know {name} = {value:g}.*; allowed: 0$"):
            refused(DATUM.changed(changes))


def test_a_damper_of_two_rates_is_one_of_their_mean() -> None:
    one, two = DATUM.changed({"C": 160.0}), DATUM.changed({"C": 80.0, "rebound": 3.0})
    assert shunting_mode(two, 40.0) == shunting_mode(one, 40.0)


@pytest.mark.parametrize("V", [10.0, 40.0])
def test_a_short_relaxation_length_is_none(V: float) -> None:
    """The mode moves in proportion to sigma, to nothing."""
    eigenvalue = complex(shunting_mode(DATUM, V).eigenvalue)
    moved = [abs(complex(shunting_mode(DATUM.changed({"sigma": s}), V).eigenvalue) - eigenvalue) for s in (1e-3, 1e-4)]
    assert moved[0] == pytest.approx(10.0 * moved[1], rel=0.02) and moved[0] < 1e-3
    assert compression_matrix(DATUM.changed({"sigma": 0.3}), V).shape == (7, 7)


@pytest.mark.parametrize(
    ("changes", "deceleration", "message"),
    [
        ({"F_0": 100.0, "k_t": 0.0}, 1.0, "F_0 = 100 N is not allowed with k_t = 0 N/m"),
        ({"travel": 0.01, "k_buffer": 0.0, "r": 0.0}, 5.0, "k_buffer = 0 N/m and r = 0 N.m/m hold no trailer"),
        ({}, -1.0, "deceleration = -1 m/s2 is not allowed"),
        ({}, math.nan, "deceleration = nan m/s2 is not allowed"),
    ],
)
def test_where_there_is_none(changes: dict[str, float], deceleration: float, message: str) -> None:
    with pytest.raises(HitchError, match=f"^{message}"):
        working_point(DATUM.changed(changes), deceleration)
