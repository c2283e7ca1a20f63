"""Standstill and beyond: the unit holds, slides, rolls away, drives back, and loses no energy on the way."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

from overrun_hitch.parameters import DATUM, Parameters
from tests.energy import G_N, Account, follow
from tests.unit import Unit

Start = Callable[..., Parameters]


@pytest.fixture(scope="module")
def unit(car_trailer_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Unit]:
    unit = Unit(car_trailer_fmu, tmp_path_factory.mktemp("unpacked"))
    unit.slave.instantiate()
    yield unit
    unit.slave.freeInstance()


def start(
    unit: Unit, tolerance: float = 1e-6, brake_torque: float = 0.0, grade: float = 0.0, **changes: float
) -> Parameters:
    parameters = DATUM.changed(changes)
    unit.slave.reset()
    unit.set(brake_torque=brake_torque, grade=grade, **parameters.model_dump())
    unit.slave.setupExperiment(tolerance=tolerance, startTime=0.0)
    unit.slave.enterInitializationMode()
    unit.slave.exitInitializationMode()
    return parameters


def run(unit: Unit, begin: float, end: float, *names: str) -> np.ndarray:
    """Rows of ``names`` at the ends of steps of 10 ms from ``begin`` to ``end`` (s)."""
    rows = []
    for n in range(round(begin * 100), round(end * 100)):
        unit.slave.doStep(n / 100, 0.01)
        rows.append(unit.get(*names))
    return np.array(rows)


AS_SOLD = {  # a drawbar with everything, in steps so small that a stop takes it from tension through all of them
    "compression_start": -0.002, "eps": 0.005, "F_0": 150.0, "x_2": 0.02, "k_2": 9000.0, "x_3": 0.035, "k_3": 15e3,
    "travel": 0.045, "k_buffer": 200e3, "rebound": 3.0,
}  # fmt: skip
STOPS = [  # brake torque (N.m), grade, changed parameters
    (2000.0, 0.0, {"C": 500.0}),
    (2000.0, 0.1, {"C": 3200.0, "mu": 1.0}),
    (2000.0, -0.1, {"C": 0.0, "mu": 1.0, "eps": 0.1}),
    (2400.0, 0.0, {"C": 100.0, "mu": 0.3, "eps": 0.1}),
    (1600.0, -0.05, {"C": 500.0, "mu": 0.8, "eps": 0.01, "CdA_c": 0.7, "CdA_t": 1.2, "C_rr": 0.015}),
    (2400.0, 0.05, {"C": 500.0, "mu": 0.3, "sigma": 0.5}),
    (2000.0, 0.0, {"C": 500.0, "tau_b": 0.02, "F_f": 100.0}),
    (2000.0, -0.05, {"C": 1000.0, "mu": 1.0, "tau_b": 0.05, "eps": 0.01, "F_f": 50.0}),
    (2000.0, 0.0, {"C": 300.0, "mu": 1.0, **AS_SOLD}),
]


def account(unit: Unit, torque: float, grade: float, changes: dict[str, float]) -> tuple[Account, Parameters]:
    parameters = start(unit, 1e-8, torque, grade, V_0=30.0, **changes)
    return follow(unit, parameters, grade, 24.0 if changes.get("mu") == 0.3 else 12.0, 5e-4), parameters


@pytest.mark.parametrize(
    ("torque", "grade", "changes"),
    [pytest.param(*stop, marks=[pytest.mark.full] if n % 2 else []) for n, stop in enumerate(STOPS)],
)
def test_energy_and_stopping_distance(unit: Unit, torque: float, grade: float, changes: dict[str, float]) -> None:
    """What the start had is where the parts say; the way follows from it and from what the car's brakes have taken."""
    energy, p = account(unit, torque, grade, changes)
    kinetic = energy.stored[0]
    shares = {name: float(gone[-1] / kinetic) for name, gone in energy.gone.items()}
    print(f"off by {energy.imbalance / kinetic:.1e}; " + ", ".join(f"{n} {s:.4f}" for n, s in shares.items()))
    assert energy.imbalance < 1e-6 * kinetic
    if "travel" in changes:
        compression = energy.values["drawbar.compression"]
        assert compression.max() > p.travel and compression.min() < 0.0
    assert all(share > -1e-9 for share in shares.values())
    distance = float(energy.values["car.body.x"][-1])
    weight = (p.M_c + p.M_t) * G_N * np.sin(np.arctan(grade))
    others = sum(gone[-1] for name, gone in energy.gone.items() if name != "car brakes")
    held = energy.stored[-1] - weight * distance  # in the drawbar
    if p.mu > 1.0 or torque / p.R_c < 0.9 * p.mu * p.M_c * G_N:  # the car's wheels roll to the end
        turned = energy.values["car.wheel.omega"]
        slid = np.trapezoid(energy.values["car.body.v"] - p.R_c * turned, dx=5e-4)
        expected = (kinetic - held - others + torque / p.R_c * slid) / (torque / p.R_c + weight)
        assert distance == pytest.approx(expected, rel=1e-3)
    else:
        assert shares["car tyres"] > 10.0 * shares["car brakes"]


@pytest.mark.parametrize("grade", [-0.1, 0.1])
def test_it_stays_where_it_stopped(unit: Unit, grade: float) -> None:
    """No creep: after a minute on the slope the car stands where it stood."""
    start(unit, 1e-6, 2000.0, grade, V_0=5.0, mu=1.0)
    run(unit, 0.0, 5.0)
    (before,) = run(unit, 5.0, 5.01, "car.body.x", "compression", "v_car", "v_trailer")
    (after,) = run(unit, 5.01, 65.0, "car.body.x", "compression", "v_car", "v_trailer")[-1:]
    np.testing.assert_allclose(after[:2], before[:2], rtol=0.0, atol=1e-6)
    np.testing.assert_array_less(np.abs(after[2:]), 1e-12)


def test_standing_from_the_start(unit: Unit) -> None:
    """On the level nothing moves; on a slope the brake takes up the weight without a shock."""
    start(unit, brake_torque=1000.0, V_0=0.0)
    assert not run(unit, 0.0, 1.0, "v_car", "v_trailer", "compression", "a_car", "a_trailer").any()
    start(unit, brake_torque=1000.0, grade=0.05, V_0=0.0)
    rows = run(unit, 0.0, 10.0, "v_car", "v_trailer", "car.body.x")
    assert np.abs(rows[:, :2]).max() < 0.05
    assert np.abs(rows[-1, :2]).max() < 1e-6
    assert -0.02 < rows[-1, 2] < 0.0


@pytest.mark.parametrize("grade", [-0.1, 0.1])
def test_released_on_a_slope_it_rolls_down(unit: Unit, grade: float) -> None:
    """As soon as nothing holds it: with the acceleration of free rolling, wheels and all."""
    p = start(unit, brake_torque=1500.0, grade=grade, V_0=0.0, C=2000.0, r=0.0)
    run(unit, 0.0, 4.0)
    unit.set(brake_torque=0.0)
    (at_8,) = run(unit, 4.0, 8.0, "v_car", "v_trailer", "a_car", "a_trailer", "slip_car")[-1:]
    inertia = p.M_c + p.M_t + p.I_c / p.R_c**2 + p.I_t / p.R_t**2
    expected = -G_N * np.sin(np.arctan(grade)) * (p.M_c + p.M_t) / inertia
    assert at_8[2:4] == pytest.approx([expected, expected], rel=1e-3)
    assert at_8[:2] == pytest.approx([4.0 * expected] * 2, rel=5e-3)


def test_the_overrun_brake_holds_a_trailer_that_pushes(unit: Unit) -> None:
    """Downhill the car is held back, the trailer pushes and brakes itself; without a linkage it only pushes."""
    speeds = []
    for r in (DATUM.r, 0.0):
        start(unit, brake_torque=200.0, grade=-0.1, V_0=0.0, C=2000.0, r=r)
        speeds.append(run(unit, 0.0, 5.0, "v_car")[-1, 0])
    assert 0.5 < speeds[0] < speeds[1] - 0.5


@pytest.mark.parametrize("mu", [DATUM.mu, 1.0])
def test_braking_backward_is_the_mirror_of_braking_forward(unit: Unit, mu: float) -> None:
    """The car alone (nothing in the drawbar): same way, same time, other sign."""
    loose = {"k": 0.0, "k_t": 0.0, "C": 0.0, "r": 0.0, "mu": mu}
    runs = []
    for sign in (1.0, -1.0):
        start(unit, 1e-9, brake_torque=1000.0, V_0=sign * 10.0, **loose)
        runs.append(sign * run(unit, 0.0, 8.0, "v_car", "v_trailer", "a_car", "slip_car", "car.body.x"))
    np.testing.assert_allclose(runs[1], runs[0], rtol=0.0, atol=1e-9)
    assert abs(runs[0][-1, 0]) < 1e-6 and runs[0][-1, 1] == pytest.approx(10.0, abs=1e-9)


@pytest.mark.parametrize("share", [0.0, 0.2, 1.0])
def test_in_reverse_the_share_of_the_trailers_brakes_that_is_not_locked_out_acts(unit: Unit, share: float) -> None:
    """For a moment: with all of it the trailer that pushes brakes itself ever harder, which is why it is locked out."""
    start(unit, V_0=-10.0, compression_start=0.1, C=3200.0, reverse_braking=share)
    torque, held = run(unit, 0.0, 0.3, "trailer_brake_torque", "linkage.brake_torque").T
    assert held[0] > 1000.0
    np.testing.assert_allclose(torque, -share * held, rtol=1e-12, atol=0.0)


@pytest.mark.parametrize(("share", "C_rr", "bound"), [(1.0, 0.0, 1e-10), (0.0, 0.0, 1e-5), (0.0, 0.01, 1e-6)], ids=str)
def test_the_last_swing(unit: Unit, share: float, C_rr: float, bound: float) -> None:
    """Brakes that let go backward leave it to the damper, and to the rolling resistance."""
    start(unit, brake_torque=2000.0, V_0=30.0, mu=1.0, reverse_braking=share, C_rr=C_rr)
    speeds = np.abs(run(unit, 0.0, 25.0, "v_car", "v_trailer")).max(axis=1)
    standstill = int(np.flatnonzero(speeds > 0.1)[-1])
    print(f"{share:g} of the brakes backward, C_rr = {C_rr:g}: {speeds[standstill + 1000]:.1e} m/s after 10 s")
    assert speeds[standstill + 1000] < bound


def test_the_combination_brakes_in_reverse(unit: Unit) -> None:
    start(unit, brake_torque=1000.0, V_0=-10.0)
    rows = run(unit, 0.0, 15.0, "v_car", "v_trailer", "compression")
    assert np.isfinite(rows).all()
    assert np.abs(rows[-1, :2]).max() < 1e-6
    assert rows[:200, 0].max() < 0.0 and rows[200:, 0].max() < 0.2


def test_a_wheel_locks_and_is_released(unit: Unit) -> None:
    """At mu = 0.3 more torque than the tyres can take stops the car's wheels in a moment; less lets them roll again."""
    p = start(unit, brake_torque=1600.0, V_0=30.0, mu=0.3, r=0.0)
    names = ("car.wheel.omega", "v_car", "car.tyre.F", "car.wheel.tau")
    limit = p.mu * p.M_c * G_N
    locking = run(unit, 0.0, 3.0, *names)
    assert locking[:, 2].max() == pytest.approx(limit, rel=5e-3)  # on the way to locking the force has its peak
    locked = locking[-100:]
    assert np.abs(locked[:, 0]).max() < 1e-3 and (locked[:, 1] > 20.0).all()
    np.testing.assert_allclose(locked[:, 2], p.mu_slide * limit, rtol=1e-3)
    assert locked[-1, 3] == pytest.approx(p.R_c * locked[-1, 2], rel=1e-3)  # the brake gives what the road asks for
    unit.set(brake_torque=200.0)
    rolling = run(unit, 3.0, 5.0, *names)[-1]
    assert rolling[0] * p.R_c == pytest.approx(rolling[1], rel=0.01)
    assert rolling[3] == 200.0
    combination = p.M_c + p.M_t + p.I_c / p.R_c**2 + p.I_t / p.R_t**2
    slowing = 200.0 / p.R_c / combination  # m/s2; it takes a part of the brake's torque to slow the wheel itself
    assert rolling[2] == pytest.approx(200.0 / p.R_c - p.I_c / p.R_c**2 * slowing, rel=5e-3)


def test_the_tyre_force_is_the_magic_formula(unit: Unit) -> None:
    """Pacejka's y = D sin(C arctan(B x - E (B x - arctan(B x)))) with the slope B C D = C_k."""
    p = start(unit, brake_torque=1600.0, V_0=30.0, mu=0.3)
    shape, peak = 1.685, p.mu * p.M_c * G_N
    lock, bent = p.C_kc / (shape * peak), np.tan((np.pi - np.arcsin(p.mu_slide)) / shape)
    curvature = (lock - bent) / (lock - np.arctan(lock))
    unit.slave.doStep(0.0, 0.001)
    rows = []
    for n in range(1, 700):
        unit.slave.doStep(n * 0.001, 0.001)
        rows.append(unit.get("car.tyre.F", "slip_car", "v_car", "car.wheel.omega"))
    force, slip, v, omega = np.array(rows).T
    np.testing.assert_allclose(slip, (v - p.R_c * omega) / v, rtol=1e-12)
    assert slip.min() < 0.05 and slip.max() > 0.99
    x = p.C_kc / (shape * peak) * slip
    np.testing.assert_allclose(force, peak * np.sin(shape * np.arctan(x - curvature * (x - np.arctan(x)))), rtol=1e-11)


def test_never_more_torque_than_the_brake_can_hold(unit: Unit) -> None:
    """Also where a wheel is turned back against a brake that has just held it: rocked on a slope that turns over."""
    start(unit, brake_torque=800.0, V_0=3.0, grade=0.3)
    largest = 0.0
    for n in range(40):
        unit.set(grade=0.3 * (-1.0) ** (n // 10), brake_torque=800.0 if n % 4 else 100.0)
        rows = run(unit, 0.1 * n, 0.1 * (n + 1), "car.wheel.tau", "brake_torque", "car.wheel.z")
        largest = max(largest, float(np.abs(rows[:, 0] / rows[:, 1]).max()))
        assert np.abs(rows[:, 2]).max() < 1.0 + 1e-6
    assert largest < 1.0 + 1e-6
