"""What coupling does to the shunting oscillation: growth rate and created energy over the step, scheme by scheme.

The manoeuvre is that of free_vibration.py: a small vibration about gentle steady braking, the speed in the middle of
the run being V. What the pair shows beyond CarTrailer.fmu, the same model in one piece, is the coupling's.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from overrun_hitch.coupling.pair import SCHEMES, Coupled, Scheme, Units
from overrun_hitch.experiments.free_vibration import DECELERATION, SHARE, MeasuredMode, measured_mode
from overrun_hitch.fmu.messages import StepRefused
from overrun_hitch.fmu.unit import AnyUnit
from overrun_hitch.measure.oscillation import NoOscillation, measure
from overrun_hitch.parameters import HitchError, Parameters
from overrun_hitch.theory.steady import inertias, steady

DURATION = 6.0  # s
ONSET = 0.1  # s: the wheels have taken up the brake torque
RELATIVE_TOLERANCE = 1e-9
SHORTEST_STEP = 1e-5  # s: half a minute for each scheme
LONGEST_STEP = 0.1  # s: longer ones see fewer than six points of an oscillation of 1.6 Hz


@dataclass(frozen=True)
class Point:
    """One scheme at one step."""

    scheme: Scheme
    H: float  # s
    growth_rate: float  # 1/s; NaN where nothing could be measured
    frequency: float  # Hz
    created: float  # J, what the coupling has fed in at the end of the run, by the pair's own works
    told: float  # J, the same as the unit tells it in coupling_energy; it is one step behind
    expected: float  # 1/s, rise of the growth rate by the closed form for light damping


@dataclass(frozen=True)
class CouplingStudy:
    """All schemes over all steps, and the model in one piece."""

    parameters: Parameters
    V: float  # m/s
    whole: MeasuredMode
    points: tuple[Point, ...]

    def of(self, scheme: Scheme) -> list[Point]:
        """The points of a scheme, by rising H."""
        return sorted((point for point in self.points if point.scheme == scheme), key=lambda point: point.H)


def study_coupling(
    pair: Units,
    trio: Units,
    whole: AnyUnit,
    parameters: Parameters,
    V: float,
    steps: Iterable[float],
    progress: Callable[[str], object] = lambda _: None,
    schemes: Sequence[Scheme] = SCHEMES,
) -> CouplingStudy:
    """Run every scheme at every step H (s): `pair` those of Trailer.fmu, `trio` those of Hitch.fmu.

    HitchError where there is nothing to measure: see measured_mode.
    """
    mode = measured_mode(whole, parameters, V)
    points = []
    for H in steps:
        progress(f"steps of {1000.0 * H:g} ms")
        points += [_point(trio if scheme.alone else pair, scheme, parameters, V, H) for scheme in schemes]
    return CouplingStudy(parameters, V, mode, tuple(points))


def check_step(H: float) -> None:
    """HitchError for a communication step (s) that is none, takes hours, or is longer than a tenth of a second."""
    if not SHORTEST_STEP <= H <= LONGEST_STEP:
        allowed = f"at least {SHORTEST_STEP:g} s, at most {LONGEST_STEP:g} s"
        raise HitchError(f"H = {H:g} s is not allowed: the step must be {allowed}")


def longest_stable_step(scheme: Scheme, parameters: Parameters, growth_rate: float) -> float:
    """The step (s) at which this scheme makes the combination shunt by itself, by the closed form (light damping).

    growth_rate (1/s) is that in one piece. 0 where it shunts without any coupling, infinite where the scheme delays
    nothing to first order.
    """
    if growth_rate >= 0.0:
        return 0.0
    rise = rise_per_second(scheme, parameters)
    return -growth_rate / rise if rise > 0.0 else math.inf


def rise_per_second(scheme: Scheme, parameters: Parameters) -> float:
    """The rise of the growth rate (1/s) for each second of H: see pair.py and trio.py."""
    p = parameters
    front, rear = inertias(p)
    late = p.k / front + (p.k + p.r / p.R_t) / rear if scheme.alone else p.k / front
    return scheme.lateness * late / 2.0


def gentle_braking(parameters: Parameters, V: float) -> tuple[Parameters, float]:
    """The start of the manoeuvre, and its brake torque in N.m."""
    torque = DECELERATION / abs(steady(parameters, 1.0).A)
    braking = steady(parameters, torque)
    compression = parameters.eps + (braking.D - parameters.eps) * (1.0 + SHARE)
    return parameters.changed({"V_0": V - 0.5 * DURATION * braking.A, "compression_start": compression}), torque


def _point(units: Units, scheme: Scheme, parameters: Parameters, V: float, H: float) -> Point:
    check_step(H)
    start, torque = gentle_braking(parameters, V)
    expected = rise_per_second(scheme, parameters) * H
    try:
        run = units.run(scheme, start, torque, DURATION, H, RELATIVE_TOLERANCE)
    except StepRefused:  # the coupling has let the motion grow until the model ends, or does not converge
        return Point(scheme, H, math.nan, math.nan, math.nan, math.nan, expected)
    growth, frequency = _oscillation(run)
    created, told = float(run.created[-1]), float(run.values["coupling_energy"][-1])
    return Point(scheme, H, growth, frequency, created, told, expected)


def _oscillation(run: Coupled) -> tuple[float, float]:
    """Growth rate (1/s) and frequency (Hz) of the compression."""
    seen = run.time >= ONSET
    compression = run.values["compression"][seen]
    if not np.isfinite(compression).all():
        return math.nan, math.nan
    found = measure(run.time[seen], compression)
    return (math.nan, math.nan) if isinstance(found, NoOscillation) else (found.growth_rate, found.frequency)
