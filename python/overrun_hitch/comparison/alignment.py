"""When a measured trace begins in the time of a run, and how sure that is."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar

from overrun_hitch.comparison.traces import TraceFile
from overrun_hitch.measure.noise import noise
from overrun_hitch.parameters import HitchError
from overrun_hitch.results import missing, scenario_of, values

Floats = NDArray[np.float64]

LEAST_OVERLAP = 0.5  # of the shorter of the two
STEP = 0.005  # s, of the search: far less than any period
TAKEN_UP = 0.1  # s: until then the car's wheels take up the torque, so fast that its samples would promise too much
CONFIDENT = 1.96  # standard deviations: 95 % of a normal distribution


@dataclass(frozen=True)
class Alignment:
    """How late the clock of a trace is, and how noisy its samples are."""

    shift: float  # s; positive: the trace shows a moment with a later time than the run
    error: float  # s, half of the 95 % interval
    noise: Mapping[str, float]  # standard deviation of what is white in a variable, in its unit


def align(reference: xr.Dataset, trace: TraceFile) -> Alignment:
    """The shift that brings the trace closest to the run, in least squares, all variables weighted by their noise.

    Before t = 0 the run is taken to roll on as it starts, if the drawbar starts at rest. HitchError where they have no
    variable in common.
    """
    common = [name for name in trace.columns if name not in missing(reference)]
    if not common:
        raise HitchError(f"{trace.path} has no variable in common with A")
    sigma = {name: noise(trace.columns[name]) for name in common}
    time, courses = _courses(reference, common)
    weights = {name: 1.0 / max(sigma[name], 1e-3 * float(np.ptp(courses[name])), 1e-300) for name in common}

    def misfit(shift: float) -> float:
        at = trace.time - shift
        inside = (at >= time[0]) & (at <= time[-1])
        left = [weights[n] * (trace.columns[n] - np.interp(at, time, courses[n]))[inside] for n in common]
        return float(np.mean(np.square(left)))

    least = LEAST_OVERLAP * min(trace.time[-1] - trace.time[0], time[-1])
    shifts = np.arange(trace.time[0] + least - time[-1], trace.time[-1] - least - time[0].clip(0.0), STEP)
    best = float(min(shifts, key=misfit))
    finest = {"xatol": 1e-6 * STEP}
    found = float(minimize_scalar(misfit, bounds=(best - STEP, best + STEP), method="bounded", options=finest).x)
    return Alignment(found, CONFIDENT * _error(reference, trace.shifted(found), common), sigma)


def _courses(reference: xr.Dataset, names: list[str]) -> tuple[Floats, dict[str, Floats]]:
    """The run, finely, and what was before it."""
    scenario, time = scenario_of(reference), values(reference, "time")
    fine = np.linspace(time[0], time[-1], round((time[-1] - time[0]) / (0.1 * STEP)) + 1)
    courses = {name: np.interp(fine, time, values(reference, name)) for name in names}
    if scenario.parameters.compression_start != 0.0:
        return fine, courses
    speed = dict.fromkeys(("v_car", "v_trailer"), scenario.parameters.V_0)
    before = np.array([-1e6, -1e-9])
    return np.append(before, fine), {n: np.append([speed.get(n, 0.0)] * 2, course) for n, course in courses.items()}


def _error(reference: xr.Dataset, trace: TraceFile, names: list[str]) -> float:
    """Standard deviation of the shift (s): by the slopes of the run and what the trace leaves, taken to be white."""
    time = values(reference, "time")
    inside = (trace.time >= TAKEN_UP) & (trace.time <= time[-1])
    at, information = trace.time[inside], 0.0
    for name in names:
        course = values(reference, name)
        left = trace.columns[name][inside] - np.interp(at, time, course)
        slopes = np.interp(at, time, np.gradient(course, time))
        variance = max(float(np.mean(left**2)), (1e-9 * float(np.ptp(course))) ** 2, 1e-300)
        information += float(np.sum(slopes**2)) / variance
    return float(1.0 / np.sqrt(information)) if information > 0.0 else float("inf")
