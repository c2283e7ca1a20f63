"""The shunting mode as the FMU shows it: a small free vibration about gentle steady braking, fitted.

Gentle, because theory (the paper's section 5) is exact at zero slip: at 0.2 m/s2 the slip is below 0.001, and the speed
falls by little over a vibration. Beyond a threshold F_0, which the push exceeds all the time. V is the speed in the
middle of the run.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from overrun_hitch.experiments.step_brake import brake
from overrun_hitch.fmu.settings import Settings
from overrun_hitch.fmu.unit import AnyUnit
from overrun_hitch.measure.envelope import measured_decrement
from overrun_hitch.measure.oscillation import FEWEST_PERIODS, NoOscillation, fitting, measure
from overrun_hitch.parameters import HitchError, Parameters, Scenario
from overrun_hitch.results import values
from overrun_hitch.theory.linear import shunting_mode
from overrun_hitch.theory.steady import inertias, steady
from overrun_hitch.theory.working_point import working_point

DECELERATION = 0.2  # m/s2
SHARE = 0.2  # of the steady compression: the drawbar stays in compression, with room to spare
LONGEST = 6.0  # s
DECAYED = math.log(1e4)  # what the vibration may fall by before the integrator's noise would matter
SAMPLES_A_PERIOD = 40
WHEELS_SETTLED = 0.1  # s: the wheels, which start without slip, take up the brake torque in a few ms
RELATIVE_TOLERANCE = 1e-10


@dataclass(frozen=True)
class MeasuredMode:
    """A shunting mode fitted to a run. Compare with linear.ShuntingMode, whose names these are."""

    V: float  # m/s
    growth_rate: float  # 1/s; positive: self-excited
    frequency: float  # Hz
    amplitude_ratio: float  # |x_t / x_c| (1)
    phase: float  # between x_t and x_c in degrees, 0 to 180
    residual: float  # what the fit leaves, relative (1)

    @property
    def eigenvalue(self) -> complex:
        """1/s, the one with positive imaginary part."""
        return complex(self.growth_rate, 2.0 * math.pi * self.frequency)


def measured_mode(unit: AnyUnit, parameters: Parameters, V: float) -> MeasuredMode:
    """Growth rate, frequency and shape of the shunting mode at V (m/s), by a run of a few seconds.

    Theory is asked only how long to look. HitchError where the motion does not oscillate, or no exponential fits it.
    """
    run, seen = _observed(unit, parameters, V)
    time = values(run, "time")
    found = fitting(measure(time[seen], values(run, "compression")[seen]))
    if isinstance(found, NoOscillation):
        raise HitchError(f"at {V:g} m/s with C = {parameters.C:g} N.s/m nothing could be measured: {found.reason}")
    car, trailer = (found.amplitude_of(time[seen], values(run, name)[seen]) for name in ("a_car", "a_trailer"))
    return MeasuredMode(
        V=V,
        growth_rate=found.growth_rate,
        frequency=found.frequency,
        amplitude_ratio=abs(trailer / car),
        phase=abs(math.degrees(np.angle(trailer / car))),
        residual=found.residual,
    )


def measured_decay(unit: AnyUnit, parameters: Parameters, V: float) -> complex:
    """The eigenvalue (1/s) at V (m/s) by the logarithmic decrement: also of a damper of two rates (see envelope.py).

    HitchError where the motion does not oscillate.
    """
    run, seen = _observed(unit, parameters, V)
    growth_rate, frequency = measured_decrement(values(run, "time")[seen], values(run, "compression")[seen])
    return complex(growth_rate, 2.0 * math.pi * frequency)


def _observed(unit: AnyUnit, parameters: Parameters, V: float) -> tuple[xr.Dataset, NDArray[np.bool_]]:
    """The run, and the samples after the wheels have settled."""
    expected = complex(shunting_mode(working_point(parameters.known_to_theory).linear, V).eigenvalue)
    if expected.imag <= 0.0:
        raise HitchError(f"at {V:g} m/s with C = {parameters.C:g} N.s/m the shunting mode does not oscillate")
    run = brake(unit, _vibration(parameters, V, expected), _settings(expected))
    return run, values(run, "time") >= WHEELS_SETTLED


def _vibration(parameters: Parameters, V: float, expected: complex) -> Scenario:
    """The run: the drawbar starts a little off its steady compression, and ends so where the vibration grows."""
    car, trailer = inertias(parameters)
    torque = DECELERATION / abs(steady(parameters.changed({"F_0": 0.0}), 1.0).A)
    torque += parameters.R_c * parameters.F_0 * (1.0 + car / trailer)  # which the push needs to exceed the threshold
    braking = steady(parameters, torque)
    duration = _duration(expected)
    share = SHARE * min(1.0, math.exp(-expected.real * duration))
    start = parameters.gives_from + (braking.D - parameters.gives_from) * (1.0 + share)
    return Scenario(
        name="free vibration",
        parameters=parameters.changed({"V_0": V - braking.A * 0.5 * duration, "compression_start": start}),
        brake_torque=torque,
        duration=duration,
    )


def _duration(expected: complex) -> float:
    """As long as the vibration is worth looking at, and long enough for the fit."""
    period = 2.0 * math.pi / expected.imag
    fading = min(LONGEST, DECAYED / max(-expected.real, 1e-9))
    return WHEELS_SETTLED + max(fading, 1.2 * FEWEST_PERIODS * period)


def _settings(expected: complex) -> Settings:
    duration = _duration(expected)
    steps = math.ceil(duration * SAMPLES_A_PERIOD * expected.imag / (2.0 * math.pi))
    return Settings(relative_tolerance=RELATIVE_TOLERANCE, communication_step=duration / steps)
