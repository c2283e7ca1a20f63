"""The smallest value of one parameter with which the shunting mode is damped as wanted at every speed of a range.

Linear theory finds it, for small motions about gentle braking; the FMU confirms it by free vibrations
(free_vibration.py) and tells what it costs.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq, minimize_scalar

from overrun_hitch.experiments.free_vibration import measured_vibration
from overrun_hitch.experiments.step_brake import brake
from overrun_hitch.fmu.settings import Settings
from overrun_hitch.fmu.unit import AnyUnit
from overrun_hitch.measure.judged import Judged
from overrun_hitch.measure.metrics import NEEDED, Traces, measured
from overrun_hitch.parameters import HitchError, Parameters, Quantities, Scenario, quantity, with_unit
from overrun_hitch.results import values
from overrun_hitch.theory.linear import REBOUND_REACH, ShuntingMode, check_known, rebound_error, shunting_mode
from overrun_hitch.theory.working_point import working_point

Floats = NDArray[np.float64]

SPEEDS = 33  # looked at, before the worst is refined
VALUES = 200  # of the free parameter, looked at for the first that reaches the ratio
COSTS = ("trailer_brake_delay", "peak_jerk", "peak_compression")
SETTINGS = Settings(relative_tolerance=1e-8, communication_step=0.01)
# What a measured damping ratio may be off: growth rate and frequency of a free vibration drift with the falling speed.
ALLOWED = 0.005  # relative
SAME = 1e-9  # damping ratios closer than that do not differ


class Wanted(Quantities):
    """The damping ratio to reach, at every speed from V_low to V_high."""

    ratio: float = quantity(0.1, "1", "damping ratio", ge=0.001, lt=0.95)  # less is lost in what the run is fitted to
    V_low: float = quantity(10.0, "m/s", "lowest speed", ge=1.0)
    V_high: float = quantity(40.0, "m/s", "highest speed", ge=1.0)


@dataclass(frozen=True)
class Smallest:
    """The smallest value of a range that is enough by linear theory."""

    value: float  # in the parameter's unit
    worst: float  # m/s, the speed with the least damping there
    is_edge: bool  # the range begins with it: less may be enough too
    enough_until: float  # from the value on; infinite where it is up to the end of the range


@dataclass(frozen=True)
class Optimum:
    """What was found."""

    name: str  # of the free parameter
    found: Smallest
    before: Parameters
    after: Parameters
    damping: tuple[Judged, ...]  # at the worst speed and the ends of the range: theory, and the FMU
    residual: float  # the largest that a fitted vibration leaves (1); NaN: measured by the decrement, not fitted
    costs: Mapping[str, tuple[float, float]]  # metric: before, after; step brake at V_high


def optimise(unit: AnyUnit, parameters: Parameters, name: str, low: float, high: float, wanted: Wanted) -> Optimum:
    """The smallest `name` from `low` to `high` (SI units) that is enough, confirmed. HitchError if none is."""
    found = smallest(parameters, name, low, high, wanted)
    after = parameters.changed({name: found.value})
    speeds = dict.fromkeys((found.worst, wanted.V_low, wanted.V_high))
    damping, residuals = zip(*(_confirmed(unit, after, V) for V in speeds), strict=True)
    return Optimum(
        name=name,
        found=found,
        before=parameters,
        after=after,
        damping=damping,
        residual=max(residuals),
        costs=_costs(unit, parameters, after, wanted.V_high),
    )


def smallest(parameters: Parameters, name: str, low: float, high: float, wanted: Wanted) -> Smallest:
    """By linear theory. HitchError if no value is enough, or the parameter has no influence."""
    if not wanted.V_low < wanted.V_high:
        raise HitchError(f"speeds from {wanted.V_low:g} to {wanted.V_high:g} m/s are an empty range")
    if not low < high:
        raise HitchError(f"{name} from {low:g} to {with_unit(high, Parameters.unit(name))} is an empty range")

    def excess(value: float) -> float:
        return least_damping(parameters.changed({name: float(value)}), wanted)[0] - wanted.ratio

    candidates = np.linspace(low, high, VALUES)
    found = np.array([excess(value) for value in candidates])
    if np.ptp(found) <= SAME:
        raise HitchError(
            f"{name} has no influence: by linear theory the damping ratio is {found[0] + wanted.ratio:.4g} for all "
            f"{name} from {low:g} to {with_unit(high, Parameters.unit(name))}"
        )
    if not (found >= 0.0).any():
        best = int(found.argmax())
        raise HitchError(
            f"no {name} from {low:g} to {with_unit(high, Parameters.unit(name))} gives a damping ratio of "
            f"{wanted.ratio:g} at all speeds from {wanted.V_low:g} to {wanted.V_high:g} m/s; the most is "
            f"{found[best] + wanted.ratio:.4g} with {name} = {candidates[best]:.4g}"
        )
    first = int((found >= 0.0).argmax())
    value = float(candidates[0]) if first == 0 else float(brentq(excess, candidates[first - 1], candidates[first]))
    less = np.flatnonzero(found[first:] < 0.0) + first  # beyond, where more is not better
    until = float(brentq(excess, candidates[less[0] - 1], candidates[less[0]])) if len(less) else math.inf
    return Smallest(value, least_damping(parameters.changed({name: value}), wanted)[1], first == 0, until)


def gentle_mode(parameters: Parameters, V: ArrayLike) -> ShuntingMode:
    """The shunting mode of small motions about gentle braking at V (m/s). HitchError for what theory does not know."""
    check_known(parameters)
    return shunting_mode(working_point(parameters).linear, V)


def least_damping(parameters: Parameters, wanted: Wanted) -> tuple[float, float]:
    """The least damping ratio from V_low to V_high and the speed (m/s) at which it is, by linear theory."""
    speeds = np.linspace(wanted.V_low, wanted.V_high, SPEEDS)
    ratios = gentle_mode(parameters, speeds).damping_ratio
    place = int(ratios.argmin())
    if place in (0, SPEEDS - 1):
        return float(ratios[place]), float(speeds[place])
    found = minimize_scalar(
        lambda V: float(gentle_mode(parameters, V).damping_ratio),
        bounds=(speeds[place - 1], speeds[place + 1]),
        method="bounded",
    )
    return (
        (float(found.fun), float(found.x))
        if found.fun < ratios[place]
        else (float(ratios[place]), float(speeds[place]))
    )


def _confirmed(unit: AnyUnit, parameters: Parameters, V: float) -> tuple[Judged, float]:
    """Theory and the FMU, and what the fit leaves."""
    theory = float(gentle_mode(parameters, V).damping_ratio)
    measured = measured_vibration(unit, parameters, V)
    found = -measured.eigenvalue.real / abs(measured.eigenvalue)
    allowed = (ALLOWED + min(rebound_error(parameters, V), REBOUND_REACH)) * theory
    return Judged(f"damping ratio at {V:.4g} m/s", "1", theory, found, allowed), measured.residual


def _costs(unit: AnyUnit, before: Parameters, after: Parameters, V: float) -> dict[str, tuple[float, float]]:
    """The metrics COSTS of step brakes at V (m/s), before and after."""
    runs = [
        brake(unit, Scenario(name="cost", parameters=each.changed({"V_0": V})), SETTINGS) for each in (before, after)
    ]
    length = min(len(run.time) for run in runs)
    traces = Traces(
        values(runs[0], "time")[:length],
        {name: np.array([values(run, name)[:length] for run in runs]) for name in NEEDED},
        np.array([before.eps, after.eps]),
    )
    return {name: (float(found[0]), float(found[1])) for name, found in measured(COSTS, traces).items()}


def default_range(parameters: Parameters, name: str) -> tuple[float, float]:
    """From the lowest value allowed, or a hundredth of the present one, to ten times it, or the highest.

    HitchError where the present one is 0.
    """
    present = float(getattr(parameters, name))
    if not present > 0.0:
        raise HitchError(
            f"{name} = {with_unit(present, Parameters.unit(name))} gives no range to look in: say --range A:B"
        )
    lowest, highest = Parameters.limits(name)
    return 0.01 * present if lowest > 0.0 else 0.0, min(10.0 * present, highest)
