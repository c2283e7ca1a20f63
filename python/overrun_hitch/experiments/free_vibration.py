"""The shunting mode as the FMU shows it: a small free vibration about gentle steady braking, fitted.

Gentle, because theory (the paper's section 5) is exact at zero slip: at 0.2 m/s2 the slip is below 0.001, and the speed
falls by little over a vibration. Beyond a threshold F_0, which the push exceeds all the time. V is the speed in the
middle of the run.

Without dry friction F_f, as in theory: it holds so small a vibration at once, and leaves none a growth rate, because it
takes the more of a motion the smaller that is. `left_out` says so.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from overrun_hitch.experiments.step_brake import brake
from overrun_hitch.fmu.settings import Settings
from overrun_hitch.fmu.unit import AnyUnit
from overrun_hitch.measure.envelope import measured_decrement
from overrun_hitch.measure.oscillation import FEWEST_PERIODS, NoOscillation, fitting, measure
from overrun_hitch.parameters import HitchError, Parameters, Scenario, with_unit
from overrun_hitch.results import Run, values
from overrun_hitch.theory.linear import shunting_mode
from overrun_hitch.theory.steady import inertias, steady
from overrun_hitch.theory.working_point import working_point

Floats = NDArray[np.float64]

DECELERATION = 0.2  # m/s2
SHARE = 0.2  # of the steady compression: the drawbar stays in compression, with room to spare
LONGEST = 6.0  # s
DECAYED = math.log(1e4)  # what the vibration may fall by before the integrator's noise would matter
GROWN = math.log(20.0)  # what it may grow by: so does what the wheels start, and the drawbar must stay in compression
SAMPLES_A_PERIOD = 40
WHEELS_SETTLED = 0.1  # s: the wheels, which start without slip, take up the brake torque in a few ms
RELATIVE_TOLERANCE = 1e-10


@dataclass(frozen=True)
class Measured:
    """Growth and frequency of a run's vibration. Compare with linear.ShuntingMode, whose names these are."""

    V: float  # m/s
    growth_rate: float  # 1/s; positive: self-excited
    frequency: float  # Hz
    residual: float  # what the fit leaves, relative (1); NaN: by the decrement, which leaves nothing to tell

    @property
    def eigenvalue(self) -> complex:
        """1/s, the one with positive imaginary part."""
        return complex(self.growth_rate, 2.0 * math.pi * self.frequency)


@dataclass(frozen=True)
class MeasuredMode(Measured):
    """With the shape of the mode."""

    amplitude_ratio: float  # |x_t / x_c| (1)
    phase: float  # between x_t and x_c in degrees, 0 to 180


def measured_mode(unit: AnyUnit, parameters: Parameters, V: float) -> MeasuredMode:
    """Growth rate, frequency and shape of the shunting mode at V (m/s), by a run of a few seconds.

    Theory is asked only how long to look. HitchError where the motion does not oscillate, or no exponential fits it.
    """
    run = _run(unit, parameters, V)
    seen = values(run, "time") >= WHEELS_SETTLED
    time = values(run, "time")[seen]
    found = fitting(measure(time, values(run, "compression")[seen]))
    if isinstance(found, NoOscillation):
        raise _nothing(parameters, V, found)
    car, trailer = (found.amplitude_of(time, values(run, name)[seen]) for name in ("a_car", "a_trailer"))
    return MeasuredMode(
        V=V,
        growth_rate=found.growth_rate,
        frequency=found.frequency,
        residual=found.residual,
        amplitude_ratio=abs(trailer / car),
        phase=abs(math.degrees(np.angle(trailer / car))),
    )


def measured_vibration(unit: AnyUnit, parameters: Parameters, V: float) -> Measured:
    """Growth rate and frequency alone: also of a damper of two rates. HitchError as `measured_mode`."""
    run = _run(unit, parameters, V)
    found = measured_in(parameters, V, values(run, "time"), values(run, "compression"))
    if isinstance(found, NoOscillation):
        raise _nothing(parameters, V, found)
    return found


def measured_in(parameters: Parameters, V: float, time: Floats, compression: Floats) -> Measured | NoOscillation:
    """The same from the compression (n,) in m at `time` (n,) in s of somebody's run through `vibration`.

    By the logarithmic decrement where a damper of two rates makes the motion no exponential (see envelope.py).
    """
    seen = time >= WHEELS_SETTLED
    if parameters.rebound != 1.0:
        growth_rate, frequency = measured_decrement(time[seen], compression[seen])
        if math.isnan(frequency):
            return NoOscillation("the drawbar does not swing through one period")
        return Measured(V, growth_rate, frequency, math.nan)
    found = fitting(measure(time[seen], compression[seen]))
    if isinstance(found, NoOscillation):
        return found
    return Measured(V, found.growth_rate, found.frequency, found.residual)


def vibration(parameters: Parameters, V: float, longest: float = LONGEST) -> Scenario:
    """The run: the drawbar starts a little off its steady compression, and ends so where the vibration grows.

    At most `longest` s of it, or what a fit needs. HitchError where the mode does not oscillate.
    """
    p = parameters.at_default("large")
    expected = _expected(p, V)
    car, trailer = inertias(p)
    torque = DECELERATION / abs(steady(p.changed({"F_0": 0.0}), 1.0).A)
    torque += p.R_c * p.F_0 * (1.0 + car / trailer)  # which the push needs to exceed the threshold
    braking = steady(p, torque)
    # As long as the vibration is worth looking at, and long enough for the fit.
    lasting = min(longest, DECAYED / max(-expected.real, 1e-9), GROWN / max(expected.real, 1e-9))
    duration = WHEELS_SETTLED + max(lasting, 1.2 * FEWEST_PERIODS * 2.0 * math.pi / expected.imag)
    share = SHARE * min(1.0, math.exp(-expected.real * duration))
    start = p.gives_from + (braking.D - p.gives_from) * (1.0 + share)
    return Scenario(
        name="free vibration",
        parameters=p.changed({"V_0": V - braking.A * 0.5 * duration, "compression_start": start}),
        brake_torque=torque,
        duration=duration,
    )


def left_out(parameters: Parameters) -> list[str]:
    """What a reader must know of parameters that the vibration leaves out, a sentence each."""
    return [
        f"{_told(parameters, name)} is left out: it holds small motions, and leaves none a growth rate"
        for name in parameters.off_default("large")
    ]


def _run(unit: AnyUnit, parameters: Parameters, V: float) -> Run:
    scenario = vibration(parameters, V)
    steps = math.ceil(scenario.duration * SAMPLES_A_PERIOD * _expected(parameters, V).imag / (2.0 * math.pi))
    settings = Settings(relative_tolerance=RELATIVE_TOLERANCE, communication_step=scenario.duration / steps)
    return brake(unit, scenario, settings)


def _expected(parameters: Parameters, V: float) -> complex:
    """Theory's eigenvalue (1/s)."""
    expected = complex(shunting_mode(working_point(parameters.at_default("neutral")).linear, V).eigenvalue)
    if expected.imag <= 0.0:
        raise HitchError(f"at {V:g} m/s with C = {parameters.C:g} N.s/m the shunting mode does not oscillate")
    return expected


def _nothing(parameters: Parameters, V: float, found: NoOscillation) -> HitchError:
    neutral = [_told(parameters, name) for name in parameters.off_default("neutral")]
    without = f"; it is about steady braking without {' and '.join(neutral)}" if neutral else ""
    return HitchError(
        f"at {V:g} m/s with C = {parameters.C:g} N.s/m nothing could be measured: {found.reason}{without}"
    )


def _told(parameters: Parameters, name: str) -> str:
    return f"{name} = {with_unit(getattr(parameters, name), Parameters.unit(name))}"
