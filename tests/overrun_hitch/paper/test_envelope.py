"""Shunting on the way to standstill: predicted by the growth rate, by linear equations, and what the FMU does."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid, solve_ivp

from overrun_hitch.experiments.stop import SLOWEST, Stop, stop
from overrun_hitch.fmu.opening import opened_unit
from overrun_hitch.fmu.unit import HitchUnit
from overrun_hitch.measure.envelope import measured_envelope
from overrun_hitch.parameters import CASES, HitchError, Parameters, Scenario
from overrun_hitch.theory.boundary import critical_damping
from overrun_hitch.theory.envelope import integrated_compression, predicted_amplitude, speed, turning_speed
from overrun_hitch.theory.linear import Floats, compression_matrix, shunting_mode
from overrun_hitch.theory.steady import steady

V_0 = 40.0  # m/s


@pytest.fixture(scope="module")
def unit(car_trailer_fmu: Path) -> Iterator[HitchUnit]:
    with opened_unit(car_trailer_fmu) as unit:
        yield unit


def braking(parameters: Parameters, share: float, torque: float = 1000.0, duration: float | None = None) -> Scenario:
    """From 40 m/s, the drawbar pushed in by a share more than it is in steady braking; without duration, to rest."""
    found = steady(parameters, torque)
    start = parameters.changed({"V_0": V_0, "compression_start": found.D * (1.0 + share)})
    return Scenario(name="stop", parameters=start, brake_torque=torque, duration=duration or -V_0 / found.A + 0.5)


def case_ii(C: float) -> Parameters:
    return CASES["ii"].changed({"C": C})


def moving(scenario: Scenario) -> Floats:
    """Every 10 ms until 0.5 m/s, but for the moment in which the wheels settle."""
    time = np.arange(10, round(scenario.duration / 0.01)) * 0.01
    A = steady(scenario.parameters, scenario.brake_torque).A
    return time[A * time + V_0 > SLOWEST]


def error(found: Stop, part: slice) -> Floats:
    """FMU over prediction, less 1."""
    time, amplitude = found.envelope(part)
    return amplitude / predicted_amplitude(found.scenario, time) - 1.0


@pytest.mark.parametrize("growth", [-0.8, 0.0, 0.5])
def test_the_envelope_of_a_pure_oscillation_is_exact(growth: float) -> None:
    time = np.arange(1000) * 0.01
    trace = 7.0 + 0.3 * np.exp(growth * time) * np.sin(10.0 * time + 1.0)
    instants, amplitude = measured_envelope(time, trace)
    assert len(instants) > 28
    np.testing.assert_allclose(amplitude, 0.3 * np.exp(growth * instants), rtol=1e-4)


@pytest.mark.parametrize("C", [20.0, 60.0, 130.0])
def test_the_prediction_grows_at_each_speed_with_the_mode(C: float) -> None:
    scenario = braking(case_ii(C), 0.2)
    A = steady(scenario.parameters, 1000.0).A
    assert predicted_amplitude(scenario, np.array([0.0, 1.0]))[0] == pytest.approx(0.2 * steady(case_ii(C), 1000.0).D)
    for V in (35.0, 20.0, 5.0, 1.0):
        before, after = np.log(predicted_amplitude(scenario, (V - V_0) / A + np.array([-0.05, 0.05])))
        assert (after - before) / 0.1 == pytest.approx(float(shunting_mode(case_ii(C), V).growth_rate), abs=2e-5)


def test_it_turns_where_the_damper_is_critical() -> None:
    parameters = case_ii(critical_damping(CASES["ii"], 17.0))
    assert turning_speed(parameters, V_0) == pytest.approx(17.0, rel=1e-9)
    scenario = braking(parameters, 0.2)
    time = moving(scenario)
    largest = time[predicted_amplitude(scenario, time).argmax()]
    assert speed(scenario, np.array([largest]))[0] == pytest.approx(17.0, abs=0.1)
    assert np.isnan(turning_speed(case_ii(0.0), V_0)) and np.isnan(turning_speed(case_ii(500.0), V_0))


def test_there_is_no_prediction_at_rest() -> None:
    for ask in (predicted_amplitude, integrated_compression):
        with pytest.raises(HitchError, match="t = 16 s is not allowed"):
            ask(braking(case_ii(20.0), 0.2), np.array([1.0, 16.0]))


def test_what_the_growth_rate_leaves_out_is_the_changing_shape_of_the_mode() -> None:
    """The next term of the WKB expansion, -l dr/dt, counted from the first extremum on: the start is another matter."""
    p = case_ii(20.0)
    scenario = braking(p, 0.15)
    time, amplitude = measured_envelope(moving(scenario), integrated_compression(scenario, moving(scenario)))
    V = np.linspace(V_0, SLOWEST, 500)
    right, left = np.empty((2, len(V), 5), dtype=complex)
    for n, (one, value) in enumerate(zip(V, shunting_mode(p, V).eigenvalue, strict=True)):
        values, vectors = np.linalg.eig(compression_matrix(p, one))
        mode = np.abs(values - value).argmin()
        right[n] = vectors[:, mode] / vectors[0, mode]  # counted from the compression
        left[n] = np.linalg.inv(vectors)[mode] * vectors[0, mode]
    shape = -np.sum(left * np.gradient(right, V, axis=0), axis=1).real
    summed = cumulative_trapezoid(shape, V, initial=0.0)
    expected = np.exp(np.interp(-speed(scenario, time), -V, summed))
    ratio = amplitude / predicted_amplitude(scenario, time)
    left_out, explained = ratio / ratio[0], expected / expected[0]
    print(f"{left_out[-1] - 1:+.2e}, explained {explained[-1] - 1:+.2e} of {summed[-1]:+.2e} down to rest")
    assert explained[-1] > 1.0 + 5e-4
    np.testing.assert_allclose(left_out, explained, rtol=2e-5)


@pytest.mark.parametrize(("C", "share"), [(20.0, 0.15), (60.0, 0.2), (130.0, 0.8)])
def test_the_fmu_shunts_in_the_predicted_envelope(unit: HitchUnit, C: float, share: float) -> None:
    found = stop(unit, braking(case_ii(C), share))
    assert found.in_theory == found.faster and found.v_car[found.faster][-1] < SLOWEST + 0.05
    off = error(found, found.in_theory)
    print(f"C = {C:g} N.s/m: {100 * off.min():+.3f} to {100 * off.max():+.3f} % at {len(off)} extrema")
    assert len(off) > 40 and np.abs(off).max() < 2e-3


def test_a_small_disturbance_is_drowned_by_the_wheels_start(unit: HitchUnit) -> None:
    """A start of 0.5 mm becomes 5 % larger at once, on the FMU and by the linear equations; then it grows alike."""
    scenario = braking(case_ii(60.0), 0.02)
    found = stop(unit, scenario)
    time, amplitude = measured_envelope(moving(scenario), integrated_compression(scenario, moving(scenario)))
    for off in (error(found, found.in_theory), amplitude / predicted_amplitude(scenario, time) - 1.0):
        assert off == pytest.approx(0.05, abs=2e-3)


def test_a_wrong_growth_rate_would_be_seen(unit: HitchUnit, monkeypatch: pytest.MonkeyPatch) -> None:
    """1 % more than theory's, or that of a damper of 61 instead of 60 N.s/m."""
    strong, balanced = (stop(unit, braking(case_ii(C), share)) for C, share in ((130.0, 0.8), (60.0, 0.2)))
    time, amplitude = balanced.envelope(balanced.in_theory)
    other = predicted_amplitude(braking(case_ii(61.0), 0.2), time)
    assert np.abs(amplitude / other - 1.0).max() > 5e-3

    class Falsified:
        def __init__(self, parameters: Parameters, V: Floats) -> None:
            self.growth_rate = 1.01 * shunting_mode(parameters, V).growth_rate

    monkeypatch.setattr("overrun_hitch.theory.envelope.shunting_mode", Falsified)
    assert np.abs(error(strong, strong.in_theory)).max() > 5e-3


@pytest.mark.parametrize("torque", [1000.0, 3000.0])
@pytest.mark.parametrize("case", CASES)
def test_every_case_does(unit: HitchUnit, case: str, torque: float) -> None:
    """With C critical at 20 m/s; the wheels' start, different in every case, is the larger part of the difference."""
    parameters = CASES[case].changed({"C": critical_damping(CASES[case], 20.0)})
    found = stop(unit, braking(parameters, 0.2, torque))
    off = error(found, found.in_theory)
    print(f"{case}: {100 * off.min():+.3f} to {100 * off.max():+.3f} % at {len(off)} extrema")
    assert np.abs(off).max() < 6e-3
    assert np.ptp(off) < 3e-3


@pytest.mark.full
def test_what_the_fmu_adds_to_the_linear_equations_is_slip(unit: HitchUnit) -> None:
    """Tyre slopes by v less by 1 - slip, and the speed that is not lost while the slip builds up."""
    p = case_ii(20.0)
    found = stop(unit, braking(p, 0.15))
    samples = found.time[found.in_theory]
    time, amplitude = found.envelope(found.in_theory)
    plain, with_slip = (
        np.abs(amplitude / np.interp(time, *measured_envelope(samples, compression)) - 1.0).max()
        for compression in (integrated_compression(found.scenario, samples), slipping(found))
    )
    print(f"as they are {plain:.1e}, with slip {with_slip:.1e}")
    assert plain > 5e-4 > 10.0 * with_slip


def slipping(found: Stop) -> Floats:
    """The linear equations about steady braking with its slip, in the same samples as `found.in_theory`."""
    p = found.scenario.parameters
    A, D, slip_c, slip_t = steady_with_slip(found.scenario)
    late = p.I_c / p.R_c**2 * V_0 / p.C_kc  # s, the lag of the wheels: the trailer's is the same
    assert late == pytest.approx(p.I_t / p.R_t**2 * V_0 / p.C_kt)

    def matrix(t: float, _: Floats) -> Floats:
        V = V_0 + A * (t - late)
        matrix = compression_matrix(p, V)
        matrix[[1, 3], 1] += slip_c * p.C_kc / V * np.array([1.0 / p.M_c, -p.R_c / p.I_c])
        matrix[[2, 4], 2] += slip_t * p.C_kt / V * np.array([1.0 / p.M_t, -p.R_t / p.I_t])
        return matrix

    time = found.time[found.in_theory]
    solution = solve_ivp(
        lambda t, y: matrix(t, y) @ y,
        (0.0, time[-1]),
        disturbance(found.scenario),
        method="Radau",
        t_eval=time,
        jac=matrix,
        rtol=1e-7,
        atol=1e-10,
    )
    return np.asarray(solution.y[0] + D)


def disturbance(scenario: Scenario) -> Floats:
    """Start less steady braking (5,), in the order of linear.compression_matrix: wheels that do not slip yet."""
    p = scenario.parameters
    _, D, slip_c, slip_t = steady_with_slip(scenario)
    return np.array([p.compression_start - D, 0.0, 0.0, slip_c * V_0 / p.R_c, slip_t * V_0 / p.R_t])


def steady_with_slip(scenario: Scenario) -> tuple[float, float, float, float]:
    """A (m/s2), D (m) and both slips (1): steady.py's, but that wheels decelerate by 1 - slip of what vehicles do."""
    p = scenario.parameters
    slip_c = slip_t = A = D = 0.0
    for _ in range(10):
        car, trailer = p.M_c + p.I_c * (1.0 - slip_c) / p.R_c**2, p.M_t + p.I_t * (1.0 - slip_t) / p.R_t**2
        A = -scenario.brake_torque / p.R_c / (car + p.k / (p.k + p.r / p.R_t) * trailer)
        D = -A * trailer / (p.k + p.r / p.R_t)
        slip_c, slip_t = (p.k * D - p.M_c * A) / p.C_kc, (-p.k * D - p.M_t * A) / p.C_kt
    return A, D, slip_c, slip_t


def test_theory_ends_where_the_drawbar_leaves_compression(unit: HitchUnit) -> None:
    """Until then the envelope is the predicted one; after, the trailer's brake lets go, and it grows less."""
    found = stop(unit, braking(case_ii(20.0), 0.6))
    assert np.abs(error(found, found.in_theory)).max() < 2e-3
    time, amplitude = found.envelope(found.faster)
    inside = time < found.time[found.in_theory][-1]
    D = steady(found.scenario.parameters, found.scenario.brake_torque).D
    assert amplitude[inside][:-1].max() < D < amplitude[~inside].min()
    grown = amplitude / predicted_amplitude(found.scenario, time)
    assert (np.diff(grown[~inside]) < 0.0).all() and grown[-1] < 0.92
