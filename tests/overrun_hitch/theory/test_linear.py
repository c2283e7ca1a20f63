"""The dynamic matrix: its forms against each other, against the nonlinear equations, and the paper's claims."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from overrun_hitch.parameters import CASES, HitchError, Parameters
from overrun_hitch.theory.linear import (
    compression_matrix,
    dynamic_matrix,
    reduced_matrix,
    shunting_mode,
    wheel_decay_rate,
)
from overrun_hitch.theory.steady import steady
from tests.oracles import radau

WEAK = 1e-3  # N/m: the rigid body then swings once in two hours


def motions(matrix: NDArray[np.float64]) -> NDArray[np.complex128]:
    """Eigenvalues of shunting and wheel modes (4,), rigid body and wheel angles apart."""
    values = np.linalg.eigvals(matrix).astype(np.complex128)
    return np.sort_complex(values[np.argsort(np.abs(values))[-4:]])


@pytest.mark.parametrize("V", [10.0, 20.0, 40.0])
@pytest.mark.parametrize("C", [0.0, 500.0, 3200.0])
@pytest.mark.parametrize("case", CASES)
def test_three_forms_of_the_matrix_have_the_same_modes(case: str, C: float, V: float) -> None:
    p = CASES[case].changed({"C": C})
    with_spring = motions(dynamic_matrix(p, V, s=WEAK))
    assert with_spring == pytest.approx(motions(reduced_matrix(p, V)), rel=1e-6)
    assert motions(compression_matrix(p, V)) == pytest.approx(motions(reduced_matrix(p, V)), rel=1e-10)


def test_weak_spring_lifts_the_rigid_body_off_zero_and_leaves_the_rest() -> None:
    p = CASES["ii"]
    moved = [np.abs(motions(dynamic_matrix(p, 20.0, s)) - motions(dynamic_matrix(p, 20.0))).max() for s in (1e-2, 1.0)]
    assert moved[0] < 1e-5
    assert moved[1] / moved[0] == pytest.approx(100.0, rel=0.2)  # in proportion to s
    rigid = np.sort(np.abs(np.linalg.eigvals(dynamic_matrix(p, 20.0, s=1.0))))[2:4]
    # The trailer's brake takes its share of the inertia, as in steady braking: what the spring feels is the car's part.
    felt = (p.M_c + p.I_c / p.R_c**2) / steady(p, 1000.0).ratio
    assert rigid == pytest.approx([np.sqrt(1.0 / felt)] * 2, rel=1e-3)


@given(
    st.sampled_from(sorted(CASES)),
    st.floats(0.0, 1e5),
    st.floats(1.0, 60.0),
)
@settings(max_examples=50, deadline=None)
def test_it_is_the_jacobian_of_the_nonlinear_equations_at_zero_slip(case: str, C: float, V: float) -> None:
    """Central differences of the oracle's right-hand side about rolling at V without brakes."""
    p = CASES[case].changed({"C": C})
    state = np.array([0.0, V, V, V / p.R_c, V / p.R_t])
    columns = []
    for i in range(5):
        step = np.zeros(5)
        step[i] = 1e-5 * max(1.0, abs(state[i]))
        # One-sided in regime: the equations of compression are linear in delta and so hold at delta < 0 too.
        ahead, behind = (radau.derivatives(p, 0.0, radau.COMPRESSION, state + sign * step) for sign in (1.0, -1.0))
        columns.append((ahead - behind) / (2.0 * step[i]))
    matrix = compression_matrix(p, V)
    assert np.column_stack(columns) == pytest.approx(matrix, rel=1e-6, abs=1e-8 * np.abs(matrix).max())


@pytest.mark.parametrize("case", CASES)
def test_claim_4_self_excited_without_damper_and_stable_with_one(case: str) -> None:
    assert (shunting_mode(CASES[case].changed({"C": 0.0}), [20.0, 40.0]).growth_rate > 0.0).all()
    assert (shunting_mode(CASES[case].changed({"C": 500.0}), [10.0, 20.0, 40.0]).growth_rate < 0.0).all()


@pytest.mark.parametrize(("case", "light"), [("i", 9.0), ("ii", 19.0), ("iii", 48.0)])
def test_claim_5_amplitude_ratio(case: str, light: float) -> None:
    """Printed in whole numbers; case iii comes out as 49."""
    lightly, heavily = (shunting_mode(CASES[case].changed({"C": C}), 20.0) for C in (0.0, 3200.0))
    assert float(lightly.amplitude_ratio) == pytest.approx(light, rel=0.025)
    assert round(float(heavily.amplitude_ratio)) == 3


def test_claim_6_phase() -> None:
    phases = [float(shunting_mode(CASES["ii"].changed({"C": C}), 20.0).phase) for C in (0.0, 800.0, 1600.0, 3200.0)]
    assert phases[0] > 178.0
    assert phases == sorted(phases, reverse=True)
    assert phases[-1] == pytest.approx(110.0, abs=2.0)


@pytest.mark.parametrize("case", CASES)
def test_shunting_mode_is_followed_through_any_damping(case: str) -> None:
    """One continuous branch from oscillating to creeping, at every speed."""
    for V in (10.0, 20.0, 40.0):
        modes = [shunting_mode(CASES[case].changed({"C": C}), V) for C in np.geomspace(1.0, 1e6, 400)]
        oscillates = [bool(mode.oscillates) for mode in modes]
        turning = oscillates.index(False)
        assert not any(oscillates[turning:])
        frequency = np.array([float(mode.frequency) for mode in modes[:turning]])
        assert 1.3 < frequency[0] < 1.8
        assert (np.diff(frequency) < 1e-3).all()
        creeping = np.array([float(mode.growth_rate) for mode in modes[turning:]])
        assert (creeping < 0.0).all()
        assert (np.diff(creeping) > 0.0).all()  # the stronger the damper, the slower it creeps back
        assert float(modes[-1].damping_ratio) == pytest.approx(1.0)


def test_speeds_of_any_shape() -> None:
    mode = shunting_mode(CASES["ii"], [[10.0, 20.0], [30.0, 40.0]])
    assert mode.growth_rate.shape == (2, 2)
    assert mode.eigenvalue[1, 1] == shunting_mode(CASES["ii"], 40.0).eigenvalue


@pytest.mark.parametrize("V", [10.0, 40.0])
def test_wheels_settle_as_fast_as_design_says(V: float) -> None:
    """C_k R^2 / (I V) and a little more for the vehicle's own mass."""
    p = CASES["ii"]
    wheel = (p.C_kc / V) * (p.R_c**2 / p.I_c + 1.0 / p.M_c)
    assert wheel_decay_rate(p, V) == pytest.approx(wheel, rel=0.05)


def test_no_shunting_mode_without_drawbar() -> None:
    with pytest.raises(HitchError, match=r"no shunting mode"):
        shunting_mode(Parameters(k=0.0, r=0.0), 20.0)


def test_what_grows_is_the_shunting_mode() -> None:
    """Large, soft-tyred wheels at high speed: the slip of the wheels is in it as much as the drawbar is."""
    p = Parameters(
        M_c=266.0, M_t=973.0, I_c=4.29, I_t=9.46, R_c=0.158, R_t=0.163, C_kc=893e3, C_kt=439e3, k=204e3, r=4.42e6
    )
    for C in (0.0, 100.0, 1e3, 1e4, 3e4, 1e5):
        largest = motions(compression_matrix(p.changed({"C": C}), 76.2)).real.max()
        growth_rate = float(shunting_mode(p.changed({"C": C}), 76.2).growth_rate)
        assert (growth_rate > 0.0) == (largest > 0.0)
    assert float(shunting_mode(p.changed({"C": 0.0}), 76.2).growth_rate) > 20.0
