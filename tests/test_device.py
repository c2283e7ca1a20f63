"""A device that lags and rubs: what theory says of it, on the FMU."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from overrun_hitch.commands.run import asked_scenario
from overrun_hitch.comparison.theory import compare
from overrun_hitch.experiments.free_vibration import measured_mode
from overrun_hitch.experiments.step_brake import brake, car_alone
from overrun_hitch.fmu.opening import opened_unit
from overrun_hitch.fmu.settings import Settings
from overrun_hitch.fmu.unit import HitchUnit
from overrun_hitch.measure.envelope import measured_envelope
from overrun_hitch.parameters import CASES, Parameters
from overrun_hitch.theory.dry_friction import onset_amplitude
from overrun_hitch.theory.linear import shunting_mode
from overrun_hitch.theory.steady import braking_at, steady
from overrun_hitch.theory.working_point import g_n
from tests.energy import G_N

X_F = 1e-4  # m, DrawbarFriction.mo


@pytest.fixture(scope="module")
def unit(car_trailer_fmu: Path) -> Iterator[HitchUnit]:
    with opened_unit(car_trailer_fmu) as opened:
        yield opened


POINTS = [(0.005, 250.0, 40.0), (0.02, 500.0, 40.0), (0.02, 900.0, 10.0), (0.05, 1500.0, 40.0)]  # s, N.s/m, m/s


@pytest.mark.parametrize(("tau_b", "C", "V"), POINTS)
def test_a_run_grows_as_theory_says_along_its_falling_speed(unit: HitchUnit, tau_b: float, C: float, V: float) -> None:
    """What `hitch run` says; from a tenth off the steady compression, so that the drawbar stays in."""
    changes = {"tau_b": tau_b, "C": C, "V_0": V, "compression_start": 1.1 * steady(CASES["ii"], 1000.0).D}
    scenario = asked_scenario(None, "ii", changes)
    growth = compare(brake(unit, scenario, Settings()), brake(unit, car_alone(scenario), Settings()))[0]
    print(f"{1e3 * tau_b:g} ms, C = {C:g}, from {V:g} m/s: FMU {growth.found:.5f}, theory {growth.expected:.5f} 1/s")
    assert growth.verdict == "agrees"
    assert growth.found == pytest.approx(growth.expected, abs=1e-3)


@pytest.mark.parametrize(("tau_b", "C", "V"), POINTS)
def test_the_fmu_grows_as_theory_says(unit: HitchUnit, tau_b: float, C: float, V: float) -> None:
    p = CASES["ii"].changed({"tau_b": tau_b, "C": C})
    found, theory = measured_mode(unit, p, V), shunting_mode(p, V)
    print(f"{1e3 * tau_b:g} ms, C = {C:g}, {V:g} m/s: FMU {found.growth_rate:.4f}, theory {theory.growth_rate:.4f} 1/s")
    assert found.growth_rate == pytest.approx(float(theory.growth_rate), abs=1e-3)
    assert found.frequency == pytest.approx(float(theory.frequency), rel=1e-3)


def vibration(unit: HitchUnit, parameters: Parameters, V: float, amplitude: float, mean: float) -> np.ndarray:
    """Amplitudes (m) from swing to swing of a vibration about `mean` (m), downhill with a brake that holds V (m/s)."""
    p = parameters.changed({"V_0": V, "compression_start": mean + amplitude})
    push = mean * (p.k + p.r / p.R_t)
    sine = push / (p.M_t * g_n)
    torque = p.R_c * ((p.M_c + p.M_t) * g_n * sine - p.r * mean / p.R_t)
    unit.start(p, {"brake_torque": torque, "grade": -sine / np.sqrt(1.0 - sine**2)}, 1e-8)
    h, rows = 0.005, [unit.get(["compression"])]
    for n in range(600):
        unit.step(n * h, h)
        rows.append(unit.get(["compression"]))
    return measured_envelope(h * np.arange(len(rows)), np.array(rows)[:, 0])[1]


@pytest.mark.parametrize(
    ("tau_b", "C", "V", "F_f"), [(0.02, 500.0, 40.0, 30.0), (0.02, 400.0, 20.0, 40.0), (0.05, 1000.0, 30.0, 50.0)]
)
def test_friction_hides_an_oscillation_until_it_is_large(
    unit: HitchUnit, tau_b: float, C: float, V: float, F_f: float
) -> None:
    p = CASES["ii"].changed({"tau_b": tau_b, "C": C, "F_f": F_f})
    onset = onset_amplitude(p, V)
    below, above = (vibration(unit, p, V, share * onset, 2.5 * onset) for share in (0.9, 1.1))
    print(f"{1e3 * tau_b:g} ms, C = {C:g}, {V:g} m/s, {F_f:g} N: a* = {1e3 * onset:.1f} mm")
    assert (np.diff(below[:8]) < 0.0).all()
    assert (np.diff(above[:8]) > 0.0).all()


def test_a_cycle_of_friction_costs_the_area_of_its_loop(unit: HitchUnit) -> None:
    """4 F_f (a - x_f), but for what is beyond the first order in x_f."""
    p = CASES["ii"].changed({"C": 50.0, "F_f": 40.0, "V_0": 40.0})
    _, D, torque = braking_at(p, 5.0)
    unit.start(p.changed({"compression_start": 0.5 * D}), {"brake_torque": torque}, 1e-10)
    h, names = 2e-4, ["compression", "drawbar.F_friction", "drawbar.v_rel"]
    rows = []
    for n in range(10_000):
        unit.step(n * h, h)
        rows.append(unit.get(names))
    x, F, v = np.array(rows).T
    turns = np.flatnonzero(v[:-1] * v[1:] < 0.0)
    assert len(turns) >= 4
    for start, end in zip(turns[:-2], turns[2:], strict=True):
        middle = turns[np.searchsorted(turns, start) + 1]
        path = abs(x[middle] - x[start]) + abs(x[end] - x[middle])
        loop = np.trapezoid(F[start : end + 1], x[start : end + 1])
        assert loop == pytest.approx(p.F_f * (path - 4.0 * X_F), rel=2e-3)


def test_a_lag_that_is_set_during_a_run_begins_without_a_jump(unit: HitchUnit) -> None:
    p = CASES["ii"].changed({"C": 300.0})
    unit.start(p, {"brake_torque": 1000.0}, 1e-8)
    for n in range(100):
        unit.step(0.01 * n, 0.01)
    (before,) = unit.get(["trailer_brake_torque"])
    unit.set({"tau_b": 0.02})
    (after,) = unit.get(["trailer_brake_torque"])
    assert after == before > 100.0


@pytest.mark.parametrize("mu", [1.0, 0.3, 0.1])
@pytest.mark.parametrize(("mu_slide", "sigma"), [(0.6, 0.0), (0.75, 0.0), (0.9, 0.0), (0.75, 0.4), (0.6, 1e-3)])
def test_locked_wheels_brake_with_their_share_of_the_peak(
    unit: HitchUnit, mu: float, mu_slide: float, sigma: float
) -> None:
    """At every speed down to rest; so the way is v^2/(2 mu_slide mu g). Tyres that lag do not rebound either."""
    loose = {"k": 0.0, "k_t": 0.0, "C": 0.0, "r": 0.0}
    p = CASES["ii"].changed({**loose, "mu": mu, "mu_slide": mu_slide, "sigma": sigma, "V_0": 20.0})
    unit.start(p, {"brake_torque": 8000.0 * mu}, 1e-8)
    h, names = 0.005 / mu, ["v_car", "a_car", "car.wheel.omega", "car.body.x"]
    rows = []
    for n in range(1000):
        unit.step(n * h, h)
        rows.append(unit.get(names))
    v, a, omega, x = np.array(rows).T
    slides = (np.abs(omega) < 1e-3) & (v > 0.02) & (v < 15.0)
    deceleration = mu_slide * mu * G_N
    np.testing.assert_allclose(a[slides], -deceleration, rtol=0.01)
    assert v[slides].min() < 0.1
    begin = int(np.flatnonzero(slides)[0])
    assert x[-1] - x[begin] == pytest.approx(v[begin] ** 2 / (2.0 * deceleration), rel=2e-3)
    assert abs(v[-1]) < 1e-6
