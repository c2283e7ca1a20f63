"""The road's grade: free rolling and held speed against their closed forms, and the sign."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import pytest

from overrun_hitch.experiments.limit_cycle import g_n, weight_push
from overrun_hitch.parameters import DATUM
from tests.unit import Unit


@pytest.fixture
def unit(car_trailer_fmu: Path, tmp_path: Path) -> Iterator[Unit]:
    unit = Unit(car_trailer_fmu, tmp_path)
    unit.slave.instantiate()
    yield unit
    unit.slave.freeInstance()


@pytest.mark.parametrize("grade", [-0.1, 0.05, 0.25])
def test_rolling_freely(unit: Unit, grade: float) -> None:
    """Each vehicle's weight along the road moves its mass and its wheels; the wheels slip by what turns them."""
    unit.start(grade=grade, V_0=20.0, C=2000.0, r=0.0)
    unit.slave.doStep(0.0, 3.0)
    p = DATUM
    inertia = p.M_c + p.M_t + p.I_c / p.R_c**2 + p.I_t / p.R_t**2
    expected = -g_n * math.sin(math.atan(grade)) * (p.M_c + p.M_t) / inertia
    a_car, a_trailer, compression = unit.get("a_car", "a_trailer", "compression")
    assert a_car == pytest.approx(expected, rel=1e-3)
    assert a_trailer == pytest.approx(expected, rel=1e-3)
    # Both have the same share of wheels, so neither pushes the other.
    assert compression == pytest.approx(0.0, abs=1e-5)


def test_held_by_the_brake_downhill(unit: Unit) -> None:
    """At constant speed the drawbar and the trailer's brake share the trailer's weight along the road."""
    p, grade = DATUM, -0.1
    push = weight_push(p, grade)
    assert push == pytest.approx(p.M_t * g_n * math.sin(math.atan(0.1)), rel=1e-14)
    beyond = push / (p.k + p.r / p.R_t)
    torque = p.R_c * (push * (p.M_c + p.M_t) / p.M_t) - p.R_c / p.R_t * p.r * beyond
    unit.start(grade=grade, V_0=20.0, compression_start=beyond, brake_torque=torque)
    unit.slave.doStep(0.0, 20.0)
    a_car, compression, v_car = unit.get("a_car", "compression", "v_car")
    assert a_car == pytest.approx(0.0, abs=1e-6)
    assert compression == pytest.approx(beyond, rel=1e-6)
    assert v_car == pytest.approx(20.0, rel=2e-3)
