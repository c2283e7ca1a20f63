"""The FMU's directional derivatives against the paper's dynamic matrix, entry by entry."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from overrun_hitch.experiments.linearisation import FMU_STATES, STATES, Linearisation, at_steady_braking, at_zero_slip
from overrun_hitch.fmu.opening import opened_unit
from overrun_hitch.parameters import CASES, FIGURES
from overrun_hitch.theory.linear import reduced_matrix


@pytest.mark.parametrize("case", CASES)
def test_at_zero_slip_it_is_the_papers(case: str, car_trailer_fmu: Path) -> None:
    with opened_unit(car_trailer_fmu) as unit:
        for V in (10.0, 20.0, 40.0):
            for C in (0.0, 500.0):
                parameters = CASES[case].changed({"C": C})
                for eps in (0.0, 0.1):
                    found = at_zero_slip(unit, parameters.changed({"eps": eps}), V)
                    assert found.slip_car == found.slip_trailer == 0.0
                    assert found.difference.max() < 1e-9
                    np.testing.assert_array_equal(found.theory, reduced_matrix(parameters, V))
    print(f"case {case}: largest difference of an entry {found.difference.max():.1e}")


@pytest.mark.full
def test_another_parameter_is_another_matrix(car_trailer_fmu: Path) -> None:
    """The comparison can fail: each of these parameters is in the matrix."""
    for name in ("M_c", "M_t", "I_c", "I_t", "R_c", "R_t", "C_kc", "C_kt", "k", "C", "r"):
        base = CASES["ii"].changed({"C": 500.0})
        with opened_unit(car_trailer_fmu) as unit:
            found = at_zero_slip(unit, base.changed({name: 1.001 * getattr(base, name)}), 20.0)
        other = Linearisation(20.0, 0.0, 0.0, found.fmu, reduced_matrix(base, 20.0))
        assert other.difference.max() > 1e-4, name


def test_in_steady_braking_the_difference_is_the_slip(car_trailer_fmu: Path) -> None:
    """A slope of the tyre force by the speed is C_k (1 - slip) / v; where the paper's has no 1 - slip, put it in."""
    p = FIGURES["8"].parameters
    with opened_unit(car_trailer_fmu) as unit:
        found = at_steady_braking(unit, p, 20.0, 1000.0)
    assert abs(found.V - 20.0) < 0.1
    explained = found.theory.copy()
    v_c, v_t, w_c, w_t = (STATES.index(name) for name in ("v_c", "v_t", "omega_c", "omega_t"))
    for speed, wheel, M, inertia, R, C_k, slip in (
        (v_c, w_c, p.M_c, p.I_c, p.R_c, p.C_kc, found.slip_car),
        (v_t, w_t, p.M_t, p.I_t, p.R_t, p.C_kt, found.slip_trailer),
    ):
        explained[speed, speed] += slip * C_k / found.V / M
        explained[wheel, speed] -= slip * C_k / found.V * R / inertia
    unexplained = Linearisation(found.V, 0.0, 0.0, found.fmu, explained).difference.max()
    print(f"slips {found.slip_car:.4f}, {found.slip_trailer:.4f}; largest difference {found.difference.max():.1e}, "
          f"with the slip put in {unexplained:.1e}")  # fmt: skip
    assert 5e-3 < found.difference.max() < 8e-3
    assert unexplained < 1e-4  # the trailer's speed is not quite the car's


def test_eigenvalues_beside_each_other(car_trailer_fmu: Path) -> None:
    """Those of the rigid body are a double zero with one eigenvector, so rounding moves them by its square root."""
    with opened_unit(car_trailer_fmu) as unit:
        fmu, theory = at_zero_slip(unit, CASES["ii"], 20.0).eigenvalues
    moving = np.abs(theory) > 1e-3
    assert moving.sum() == 4
    np.testing.assert_allclose(fmu[moving], theory[moving], rtol=1e-9)
    assert np.abs(fmu[~moving]).max() < 1e-5


def test_at_speed_nothing_depends_on_the_states_that_count_at_standstill(car_trailer_fmu: Path) -> None:
    """What brakes and tyres need to hold: at speed the six states of the paper do not see it."""
    with opened_unit(car_trailer_fmu) as unit:
        at_steady_braking(unit, FIGURES["8"].parameters, 20.0, 1000.0)
        names, jacobian = unit.jacobian()
    papers = [names.index(name) for name in FMU_STATES.values()]
    tyres = [names.index(f"{vehicle}.tyre.u") for vehicle in ("car", "trailer")]
    brakes = [names.index(f"{vehicle}.wheel.z") for vehicle in ("car", "trailer")]
    neutral = [names.index(name) for name in ("drawbar.friction.z", "linkage.T_missing")]
    assert sorted(papers + tyres + brakes + neutral) == list(range(len(names)))
    assert not jacobian[neutral].any() and not jacobian[:, neutral].any()  # without friction and lag
    assert not jacobian[np.ix_(papers, tyres)].any()
    assert not jacobian[np.ix_(brakes, papers + tyres)].any()  # so they stay what they are at the start
    assert (np.diag(jacobian)[tyres + brakes] < 0.0).all()
