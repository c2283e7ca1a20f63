"""What the paper could not show: the boundary of self-excitation, limit cycles with clearance, stops to standstill."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from overrun_hitch.experiments.free_vibration import measured_mode
from overrun_hitch.experiments.limit_cycle import Sustained, sustained_motion, weight_push
from overrun_hitch.experiments.stop import Stop, stop
from overrun_hitch.fmu.unit import AnyUnit
from overrun_hitch.measure.envelope import measured_envelope
from overrun_hitch.parameters import CASES, DATUM, Parameters, Scenario
from overrun_hitch.theory.boundary import critical_damping
from overrun_hitch.theory.describing_function import Cycle, predicted_cycles
from overrun_hitch.theory.envelope import integrated_compression, predicted_amplitude, turning_speed
from overrun_hitch.theory.steady import steady

Floats = NDArray[np.float64]

DEFLECTION = 0.01  # m for 1 m/s2 of deceleration: how the paper's section 8.1 chooses k
SPEEDS = np.linspace(5.0, 45.0, 17)  # m/s
RATIOS = np.geomspace(0.5, 10.0, 24)  # r/k in m: closer together where the boundary bends
CHECKED_SPEEDS = (10.0, 20.0, 40.0)
CHECKED_RATIOS = (1.225, 2.975, 8.23)  # cases i, ii, iii
BESIDE = 0.1  # of C_crit: how far from the boundary the FMU is asked

CYCLE_SPEED = 40.0  # m/s
CYCLE_GRADE = -0.1
CYCLE_DAMPERS = (40.0, 60.0, 80.0, 100.0, 110.0, 130.0)  # N.s/m
CYCLE_CLEARANCES = (0.0, 0.02, 0.05, 0.1)  # m
SMALL = 0.3  # of the steady compression: where a motion starts if no cycle is predicted

STOP_SPEED = 40.0  # m/s, from which the combination stops
STOP_TORQUE = 1000.0  # N.m, that of the paper's figures 6 to 11
STOPS = ((20.0, 0.15), (60.0, 0.2), (130.0, 0.8), (20.0, 0.6))  # C in N.s/m, disturbance as a share of the steady D
AT_REST = 1.0  # s, how long the run goes on at rest
STOP_ALLOWED = 0.003  # by which the envelopes of FMU and theory may differ


def designed(ratio: float) -> Parameters:
    """The datum with this r/k (m), and k such that the drawbar deflects by 1 cm for 1 m/s2 (equation 15)."""
    trailer = DATUM.M_t + DATUM.I_t / DATUM.R_t**2
    k = trailer / (DEFLECTION * (1.0 + ratio / DATUM.R_t))
    return DATUM.changed({"k": k, "r": ratio * k})


@dataclass(frozen=True)
class Check:
    """The FMU on both sides of the boundary."""

    V: float  # m/s
    ratio: float  # r/k in m
    C_crit: float  # N.s/m
    growth_below: float  # 1/s, at (1 - BESIDE) C_crit
    growth_above: float  # 1/s, at (1 + BESIDE) C_crit

    @property
    def holds(self) -> bool:
        """Growing with less damping than C_crit, decaying with more."""
        return self.growth_below > 0.0 > self.growth_above


@dataclass(frozen=True)
class Boundary:
    """C_crit (n, m) in N.s/m by the linear module at `speeds` (n,) in m/s and `ratios` (m,) r/k in m, and checks."""

    speeds: Floats
    ratios: Floats
    C_crit: Floats
    checks: tuple[Check, ...]


@dataclass(frozen=True)
class Motion:
    """What became of an oscillation with clearance at held speed, predicted and on the FMU."""

    C: float  # N.s/m
    eps: float  # m
    steady: float  # m, the steady compression beyond eps
    predicted: Cycle | None  # the smallest stable one
    fmu: Sustained


@dataclass(frozen=True)
class Envelope:
    """Amplitudes (m,) of the compression in m at `time` (m,) in s, beside those predicted for the same times."""

    time: Floats
    amplitude: Floats
    predicted: Floats

    @property
    def error(self) -> Floats:
        """By how much (m,) the amplitudes are more than predicted, relative (1)."""
        return np.asarray(self.amplitude / self.predicted - 1.0)

    @property
    def largest_error(self) -> float:
        """The largest of them, with its sign."""
        return float(self.error[np.abs(self.error).argmax()])


@dataclass(frozen=True)
class Shunting:
    """How shunting grows and fades in a stop: on the FMU and by the linear equations integrated, beside theory."""

    stop: Stop
    steady: float  # m, the steady compression
    turning: float  # m/s, below which theory lets it fade
    fmu: Envelope  # down to stopping.SLOWEST
    in_theory: Envelope  # of these, those before the drawbar leaves compression
    integrated: Envelope

    @property
    def lowest_speed(self) -> float:
        """The speed (m/s) at which theory ceases to apply."""
        return float(self.stop.v_car[self.stop.in_theory][-1])

    @property
    def turning_on_fmu(self) -> float:
        """The speed (m/s) of the FMU's largest amplitude: the vertex of a parabola through its logarithm over speed."""
        found = self.in_theory
        curvature, slope, _ = np.polyfit(
            np.interp(found.time, self.stop.time, self.stop.v_car), np.log(found.amplitude), 2
        )
        return float(-0.5 * slope / curvature)

    @property
    def agrees(self) -> bool:
        """Whether the FMU's envelope is the predicted one as far as theory applies."""
        return abs(self.in_theory.largest_error) < STOP_ALLOWED


def boundary(unit: AnyUnit) -> Boundary:
    """The chart and its checks."""
    C_crit = np.array([[critical_damping(designed(ratio), V) for ratio in RATIOS] for V in SPEEDS])
    checks = tuple(_check(unit, V, ratio) for V in CHECKED_SPEEDS for ratio in CHECKED_RATIOS)
    return Boundary(SPEEDS, RATIOS, C_crit, checks)


def _check(unit: AnyUnit, V: float, ratio: float) -> Check:
    parameters = designed(ratio)
    C_crit = critical_damping(parameters, V)
    below, above = (
        measured_mode(unit, parameters.changed({"C": factor * C_crit}), V).growth_rate
        for factor in (1.0 - BESIDE, 1.0 + BESIDE)
    )
    return Check(V, ratio, C_crit, below, above)


def motions(unit: AnyUnit, progress: Callable[[str], object]) -> tuple[Motion, ...]:
    """Case ii downhill at held speed, over C and eps."""
    found = []
    for eps in CYCLE_CLEARANCES:
        progress(f"limit cycles: clearance {eps:g} m")
        found += [_motion(unit, CASES["ii"].changed({"C": C, "eps": eps})) for C in CYCLE_DAMPERS]
    return tuple(found)


def _motion(unit: AnyUnit, parameters: Parameters) -> Motion:
    push = weight_push(parameters, CYCLE_GRADE)
    steady = push / (parameters.k + parameters.r / parameters.R_t)
    stable = (cycle for cycle in predicted_cycles(parameters, CYCLE_SPEED, push) if cycle.is_stable)
    predicted = next(stable, None)
    start = SMALL * steady if predicted is None else predicted.amplitude
    fmu = sustained_motion(unit, parameters, CYCLE_SPEED, CYCLE_GRADE, start)
    return Motion(parameters.C, parameters.eps, steady, predicted, fmu)


def stops(unit: AnyUnit) -> tuple[Shunting, ...]:
    """Case ii from 40 m/s to rest, with dampers between which growth turns to decay earlier or later."""
    return tuple(_shunting(unit, CASES["ii"].changed({"C": C}), share) for C, share in STOPS)


def _shunting(unit: AnyUnit, parameters: Parameters, share: float) -> Shunting:
    braking = steady(parameters, STOP_TORQUE)
    scenario = Scenario(
        name="stop",
        parameters=parameters.changed({"V_0": STOP_SPEED, "compression_start": braking.D * (1.0 + share)}),
        brake_torque=STOP_TORQUE,
        duration=round(-STOP_SPEED / braking.A + AT_REST, 1),
    )
    found = stop(unit, scenario)
    time = found.time[found.faster]
    integrated = measured_envelope(time, integrated_compression(scenario, time))
    return Shunting(
        stop=found,
        steady=braking.D,
        turning=turning_speed(parameters, 2.0 * STOP_SPEED),
        fmu=_beside_theory(scenario, *found.envelope(found.faster)),
        in_theory=_beside_theory(scenario, *found.envelope(found.in_theory)),
        integrated=_beside_theory(scenario, *integrated),
    )


def _beside_theory(scenario: Scenario, time: Floats, amplitude: Floats) -> Envelope:
    return Envelope(time, amplitude, predicted_amplitude(scenario, time))
