"""Drag and rolling resistance: coasting, terminal speed, rest against closed forms; a trailer that is pushed back."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from overrun_hitch.parameters import DATUM, Parameters
from tests.energy import G_N
from tests.unit import Unit

RHO = 1.225  # kg/m3, ISO 2533
# The trailer has more drag for its mass: it hangs on the drawbar. No linkage, so that nothing brakes where it pushes.
RESISTED = DATUM.changed({"CdA_c": 0.7, "CdA_t": 1.2, "C_rr": 0.015, "C": 2000.0, "r": 0.0})


@pytest.fixture(scope="module")
def unit(car_trailer_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Unit]:
    unit = Unit(car_trailer_fmu, tmp_path_factory.mktemp("unpacked"))
    unit.slave.instantiate()
    yield unit
    unit.slave.freeInstance()


def speeds(unit: Unit, parameters: Parameters, grade: float, time: np.ndarray) -> np.ndarray:
    """v_car and v_trailer (2, n) in m/s at equidistant times from 0 on."""
    unit.slave.reset()
    unit.start(grade=grade, **parameters.model_dump())
    rows = [unit.get("v_car", "v_trailer")]
    for now in time[:-1]:
        unit.slave.doStep(now, time[1])
        rows.append(unit.get("v_car", "v_trailer"))
    return np.array(rows).T


def coefficients(p: Parameters, grade: float) -> tuple[float, float, float]:
    """m, a, c in m v' = -(a + c v^2) while rolling forward, wheels turning as if without slip."""
    m = p.M_c + p.M_t + p.I_c / p.R_c**2 + p.I_t / p.R_t**2
    angle = np.arctan(grade)
    a = (p.M_c + p.M_t) * G_N * (p.C_rr * np.cos(angle) + np.sin(angle))
    return m, a, 0.5 * RHO * (p.CdA_c + p.CdA_t)


def test_coasting(unit: Unit) -> None:
    """v(t) by tan, down to half the speed; slips of 1e-3 and the drawbar that stretches at first are left out."""
    p = RESISTED.changed({"V_0": 30.0})
    m, a, c = coefficients(p, 0.0)
    time = np.linspace(0.0, 40.0, 401)
    expected = np.sqrt(a / c) * np.tan(np.arctan(p.V_0 * np.sqrt(c / a)) - np.sqrt(a * c) / m * time)
    assert expected[-1] < 0.5 * p.V_0
    off = np.abs(speeds(unit, p, 0.0, time) / expected - 1.0)
    print(f"off by {off.max():.1e}, after a second by {off[:, 10:].max():.1e}")
    assert off.max() < 1e-3 and off[:, 10:].max() < 1e-4


def test_terminal_speed_downhill(unit: Unit) -> None:
    """v(t) by tanh; the speed in the end is exact: nothing accelerates any more."""
    p, grade = RESISTED.changed({"V_0": 10.0}), -0.1
    m, a, c = coefficients(p, grade)
    terminal = np.sqrt(-a / c)
    time = np.linspace(0.0, 400.0, 401)
    expected = terminal * np.tanh(np.arctanh(p.V_0 / terminal) + np.sqrt(-a * c) / m * time)
    found = speeds(unit, p, grade, time)
    off = np.abs(found / expected - 1.0)
    print(f"off by {off.max():.1e}, in the end by {off[:, -1].max():.1e}")
    assert off.max() < 1e-3
    np.testing.assert_allclose(found[:, -1], terminal, rtol=1e-6)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_drag_is_against_the_motion_in_both_directions(unit: Unit, sign: float) -> None:
    p = RESISTED.changed({"V_0": sign * 30.0, "k": DATUM.k_t})  # the drawbar is as stiff in both directions
    m, a, c = coefficients(p, 0.0)
    time = np.linspace(0.0, 10.0, 101)
    expected = np.sqrt(a / c) * np.tan(np.arctan(30.0 * np.sqrt(c / a)) - np.sqrt(a * c) / m * time)
    np.testing.assert_allclose(sign * speeds(unit, p, 0.0, time)[:, 10:], [expected[10:]] * 2, rtol=1e-4)


@pytest.mark.parametrize(("grade", "rests"), [(0.012, True), (-0.012, True), (0.018, False)])
def test_it_rests_on_a_slope_of_less_than_the_rolling_resistance(unit: Unit, grade: float, rests: bool) -> None:
    """Up to C_rr a slope does not set it in motion again once it has rolled out; a steeper one takes it down."""
    p = RESISTED.changed({"V_0": 0.3})
    found = speeds(unit, p, grade, np.linspace(0.0, 100.0, 1001))
    if rests:
        assert np.abs(found[:, -1]).max() < 1e-6
        assert unit.get("car.body.x") > 0.0
        before = unit.get("car.body.x")[0]
        unit.slave.doStep(100.0, 60.0)
        assert unit.get("car.body.x")[0] == pytest.approx(before, abs=1e-6)
    else:
        assert (found[:, -1] < -1.0).all()


@pytest.mark.parametrize("locked_out", [True, False])
def test_a_trailer_that_is_pushed_back(pair_fmus: dict[int, dict[str, Path]], tmp_path: Path, locked_out: bool) -> None:
    """With a reversing lock-out its rolling resistance alone pushes; without, its brakes lock and its tyres drag."""
    unit = Unit(pair_fmus[2]["Trailer"], tmp_path)
    unit.slave.instantiate()
    try:
        unit.start(V_0=-2.0, v_car=-2.0, C_rr=0.015, mu=0.8, reverse_braking=0.0 if locked_out else 1.0)
        unit.slave.doStep(0.0, 20.0)
        pushed = unit.get("F_hitch", "trailer_brake_torque", "v_trailer", "trailer.wheel.omega")
    finally:
        unit.slave.freeInstance()
    load = DATUM.M_t * G_N
    assert pushed[2] == pytest.approx(-2.0, abs=1e-3)
    if locked_out:
        assert pushed[0] == pytest.approx(0.015 * load, rel=1e-4)
        assert pushed[1] == 0.0
    else:
        assert 0.5 * 0.8 * load < pushed[0] < 0.8 * load
        assert abs(pushed[3]) < 1e-6
