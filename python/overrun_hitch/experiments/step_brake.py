"""Step brakes on the FMU. Every communication point is a multiple of the step, without accumulated rounding."""

from __future__ import annotations

import json
import math
from importlib.metadata import version
from itertools import pairwise
from numbers import Real
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from overrun_hitch.experiments.drive import drive
from overrun_hitch.experiments.torque import Torque
from overrun_hitch.fmu.guest import GuestLost
from overrun_hitch.fmu.guest_unit import guest_file
from overrun_hitch.fmu.settings import TIME_LIMIT, Settings
from overrun_hitch.parameters import DATUM, HitchError, Parameters, Scenario
from overrun_hitch.results import VARIABLES, Run, scenario_attributes

if TYPE_CHECKING:
    import xarray as xr

    from overrun_hitch.fmu.unit import AnyUnit

Floats = NDArray[np.float64]

MOST_STEPS = 1_000_000  # a table of 10 columns of that length takes 80 MB
STEEPEST = 0.5  # of a road
STANDSTILL = 0.1  # m/s: the paper's slip, a difference over the speed, means nothing at rest


def step_brake(
    scenario: Scenario,
    *,
    fmu: Path,
    relative_tolerance: float = 1e-6,
    communication_step: float = 0.01,
    time_limit: float = TIME_LIMIT,
    torque: Torque | None = None,
    grade: float = 0.0,
) -> xr.Dataset:
    """`brake` on an FMU file that is opened for this one run, in a process of its own; see results.dataset.

    `time_limit` in s. HitchError also for a file that is no such FMU, and for one that crashes or takes longer.
    """
    settings = Settings(relative_tolerance=relative_tolerance, communication_step=communication_step)
    _communication_points(scenario, settings.communication_step)  # what is wrong with it comes first
    with guest_file(fmu, time_limit) as unit:
        return brake(unit, scenario, settings, torque=torque, grade=grade).dataset()


def brake(
    unit: AnyUnit,
    scenario: Scenario,
    settings: Settings,
    times: Floats | None = None,
    torque: Torque | None = None,
    grade: float = 0.0,
) -> Run:
    """Run `scenario` on the unit and sample it at the communication points, t = 0 included.

    At `times` (n,) in s instead, rising from 0 or later, where they are given. `torque`: instead of a step of the
    scenario's brake torque. `grade`: rise of the road over its run, -STEEPEST to STEEPEST.

    The run ends early, with attribute `ended` = "standstill", before car or trailer comes to rest, where the paper's
    model ends. HitchError for too many steps or a start at rest; what the unit refuses ends `opened_unit` with a
    HitchError.
    """
    wanted = _communication_points(scenario, settings.communication_step) if times is None else times
    points = np.union1d(wanted, [0.0, *(torque.knots(0.0, wanted[-1]) if torque else ())])
    steps = [(now, then - now) for now, then in pairwise(points.tolist())]
    courses = torque.courses(points) if torque else None
    inputs = {"brake_torque": courses[0][0] if courses else scenario.brake_torque}
    if grade:  # other people's units have no such input
        inputs["grade"] = _checked_grade(grade)
    try:
        rows = unit.perform(drive, scenario.parameters, inputs, settings.relative_tolerance, steps, STANDSTILL, courses)
    except GuestLost as error:
        raise type(error)(f"{error}; {_differences(scenario)}") from None
    identity = unit.identity
    attributes = {
        **scenario_attributes(scenario),
        **settings.model_dump(),
        "profile": json.dumps([torque.time.tolist(), torque.values.tolist()]) if torque else "",
        "grade": grade,
        "fmu": unit.name,
        "guid": identity.guid,
        "missing": ", ".join(identity.missing),
        "ended": "duration" if len(rows) == len(points) else "standstill",
        "versions": ", ".join(f"{name} {version(name)}" for name in ("fmpy", "numpy", "xarray")),
    }
    shown = np.isin(points[: len(rows)], wanted)
    return Run(points[: len(rows)][shown], dict(zip(VARIABLES, rows[shown].T, strict=True)), attributes)


def car_alone(scenario: Scenario) -> Scenario:
    """The same step brake with nothing between car and trailer (k = k_t = C = r = F_0 = 0): the car as if alone."""
    loose = scenario.parameters.changed(dict.fromkeys(Parameters.having("of", "link"), 0.0))
    return scenario.changed(name=f"{scenario.name}, car alone", parameters=loose)


def _communication_points(scenario: Scenario, h: float) -> Floats:
    """0, h, 2 h, ... and the end of the run, which a last shorter step may have to reach."""
    V_0, duration = scenario.parameters.V_0, scenario.duration
    if V_0 < STANDSTILL:
        raise HitchError(f"V_0 = {V_0:g} m/s is not allowed: a step brake starts at {STANDSTILL} m/s at least")
    if not 1.0 <= duration / h <= MOST_STEPS:
        least = max(duration / MOST_STEPS, Settings.limits("communication_step")[0])
        allowed = f"a run of {duration:g} s has steps from {least:g} to {duration:g} s"
        raise HitchError(f"communication_step = {h:g} s is not allowed: {allowed}")
    steps = math.ceil(duration / h * (1.0 - 1e-12))
    return np.append(np.arange(steps) * h, duration)


def _checked_grade(grade: float) -> float:
    if not (isinstance(grade, Real) and abs(grade) <= STEEPEST):
        shown = f"{grade:g}" if isinstance(grade, Real) else f"{grade!r:.40}"
        raise HitchError(
            f"grade = {shown} is not allowed: rise of the road over its run must be a finite number, at least "
            f"{-STEEPEST:g}, at most {STEEPEST:g}"
        )
    return grade


def _differences(scenario: Scenario) -> str:
    """What the run was, in a line."""
    given = {**scenario.parameters.model_dump(), "brake_torque": scenario.brake_torque}
    datum = {**DATUM.model_dump(), "brake_torque": Scenario.model_fields["brake_torque"].default}
    changed = ", ".join(f"{name}={value:g}" for name, value in given.items() if value != datum[name])
    return f"the run was figure 8 with {changed}" if changed else "the run was figure 8"
