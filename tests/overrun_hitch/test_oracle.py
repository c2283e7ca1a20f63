"""How good the oracle is: two methods of different families, with the drawbar's kinks located."""

from __future__ import annotations

import numpy as np
import pytest

from overrun_hitch.parameters import FIGURES
from tests.oracles import radau
from tests.sampling import sampled


@pytest.mark.parametrize("figure", sampled(["6a", "6b", "8", "10"], ["6b", "10"]))
def test_it_is_converged(figure: str) -> None:
    p = FIGURES[figure].parameters
    oracle = radau.trajectory(p)
    other = radau.solve(p, 1000.0, oracle.time, method="DOP853", rtol=1e-13)
    assert oracle.compression == pytest.approx(other.compression, abs=2e-11)
    assert oracle.v_car == pytest.approx(other.v_car, abs=1e-9)
    assert oracle.v_trailer == pytest.approx(other.v_trailer, abs=1e-9)
    assert oracle.events == pytest.approx(other.events, abs=1e-9)


def test_the_faster_method_is_as_good() -> None:
    p = FIGURES["8"].parameters
    assert radau.trajectory(p, method="DOP853").compression == pytest.approx(radau.trajectory(p).compression, abs=1e-11)


def test_momentum_changes_by_the_forces_on_the_road() -> None:
    """Car and trailer together: the hitch force and what it does inside cancel."""
    p = FIGURES["6a"].parameters
    run = radau.trajectory(p)
    road = -(p.C_kc * run.slip_car + p.C_kt * run.slip_trailer)
    assert p.M_c * run.a_car + p.M_t * run.a_trailer == pytest.approx(road, abs=1e-6)


def test_regimes_meet_without_a_jump() -> None:
    p = FIGURES["10"].parameters
    for delta, regimes in ((0.0, (radau.TENSION, radau.CLEARANCE)), (p.eps, (radau.CLEARANCE, radau.COMPRESSION))):
        sides = [radau.drawbar(p, regime, np.array(delta), np.array(0.3)) for regime in regimes]
        assert np.array(sides[0]) == pytest.approx(np.array(sides[1]))
