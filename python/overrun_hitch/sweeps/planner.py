"""A sweep made ready: every name known, every value in its range, every run a row. Nothing here runs an FMU.

Names, units and ranges are those of parameters.py; of what is not there (another tool's parameters, inputs beside the
brake torque) those of the FMUs' own descriptions.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from overrun_hitch.fmu.description import Description, described
from overrun_hitch.fmu.profiles import Profile, profile
from overrun_hitch.fmu.settings import Settings
from overrun_hitch.measure.metrics import METRICS
from overrun_hitch.parameters import CASES, DATUM, HitchError, Parameters, Scenario, named, with_unit
from overrun_hitch.results import VARIABLES
from overrun_hitch.sweeps.job import FmuFile, Job
from overrun_hitch.sweeps.plan import STEP_BRAKE, Plan, Quantity
from overrun_hitch.sweeps.sampling import Columns, product, sampled, spaced
from overrun_hitch.sweeps.spec import Range, Sample, SweepSpec

Floats = NDArray[np.float64]

MOST_RUNS = 1_000_000
MOST_POINTS = 100_000  # of a run


def planned(spec: SweepSpec, fmus: Sequence[Path]) -> Plan:
    """The plan of `spec` on these FMU files (its own, or ours). HitchError for whatever would fail before the end.

    What an FMU itself refuses in a run is found in that run, and recorded there.
    """
    base = DATUM if spec.case is None else named("case", spec.case, CASES)
    scenario = Scenario(name=spec.name, parameters=base, duration=spec.duration)
    settings = Settings(relative_tolerance=spec.relative_tolerance, communication_step=spec.communication_step)
    points = _points(scenario.duration, settings.communication_step)
    descriptions = [described(fmu) for fmu in fmus]
    quantities = _quantities(descriptions)
    profiles = _profiles(spec, points, descriptions)
    driven = {name for each in profiles for name in each.knots if name != "time"}
    tables = [table for _, table in _tables(spec)]
    varied = _varied_once(_tables(spec), [*spec.parameters, *driven])
    for place, values in [*_values(spec), *[(f"profiles.{p.name}", p.knots) for p in profiles]]:
        _check(place, values, quantities)
    fixed = {**base.model_dump(), "brake_torque": scenario.brake_torque, **spec.parameters}
    columns = _combined(len(fmus), len(profiles) or 1, tables)
    return Plan(
        job=Job(
            fmus=tuple(FmuFile(fmu.name, fmu.read_bytes()) for fmu in fmus),
            profiles=profiles or (Profile(STEP_BRAKE, {}, ()),),
            fixed={name: float(value) for name, value in fixed.items() if name not in varied and name not in driven},
            varied=varied,
            points=points,
            relative_tolerance=settings.relative_tolerance,
            metrics=_names("metric", spec.metrics, METRICS),
            trajectories=_names("variable", spec.trajectories, VARIABLES),
        ),
        name=spec.name,
        quantities=quantities,
        fmu=columns.pop("fmu").astype(np.int64),
        profile=columns.pop("profile").astype(np.int64),
        columns=columns,
    )


def _profiles(spec: SweepSpec, points: Floats, descriptions: Sequence[Description]) -> tuple[Profile, ...]:
    inputs = {name for description in descriptions for name in description.inputs}
    interpolated = all(description.interpolates for description in descriptions)
    return tuple(profile(name, table, points, inputs, interpolated) for name, table in spec.profiles.items())


def _combined(fmus: int, profiles: int, tables: Sequence[Columns]) -> dict[str, Floats]:
    """Every combination of an FMU, a profile (their places) and a row of each table. HitchError for too many."""
    count = math.prod([fmus, profiles, *(len(next(iter(table.values()))) for table in tables)])
    if count > MOST_RUNS:
        raise HitchError(f"the sweep has {count} runs; allowed: at most {MOST_RUNS}")
    places = {"fmu": np.arange(fmus, dtype=np.float64)}, {"profile": np.arange(profiles, dtype=np.float64)}
    return product([*places, *tables])


def _points(duration: float, h: float) -> Floats:
    steps = round(duration / h)
    if steps < 1 or abs(steps * h - duration) > 1e-9 * duration:
        raise HitchError(f"communication_step = {h:g} s is not allowed: it must divide the duration, {duration:g} s")
    if steps >= MOST_POINTS:
        raise HitchError(f"communication_step = {h:g} s is not allowed: at most {MOST_POINTS} points in {duration:g} s")
    return np.append(np.arange(steps) * h, duration)


def _quantities(descriptions: Sequence[Description]) -> dict[str, Quantity]:
    """By name: those of parameters.py, and of the FMUs' others what all FMUs have."""
    common = [{**description.parameters, **description.inputs} for description in descriptions]
    found = {
        name: Quantity(variable.unit, variable.description, partial(_check_limits, name, variable))
        for name, variable in common[0].items()
        if all(name in others for others in common)
    }
    for name in Parameters.model_fields:
        found[name] = Quantity(Parameters.unit(name), Parameters.description(name), partial(_check_parameter, name))
    unit, description = Scenario.unit("brake_torque"), Scenario.description("brake_torque")
    found["brake_torque"] = Quantity(unit, description, _check_brake_torque)
    return found


def _check_parameter(name: str, value: float) -> None:
    DATUM.changed({name: value})


def _check_brake_torque(value: float) -> None:
    Scenario(name="", parameters=DATUM, brake_torque=value)


def _check_limits(name: str, variable: Any, value: float) -> None:
    if not variable.low <= value <= variable.high:
        raise HitchError(
            f"{name} = {with_unit(value, variable.unit)} is not allowed: {variable.description} must be "
            f"at least {variable.low:g} and at most {with_unit(variable.high, variable.unit)}"
        )


def _tables(spec: SweepSpec) -> list[tuple[str, Columns]]:
    """The parts of the spec whose rows are combined, each with its name. HitchError for a part that is not possible."""
    tables: list[tuple[str, Columns]] = []
    for name, axis in spec.grid.items():
        values = _spaced(f"grid.{name}", axis) if isinstance(axis, Range) else np.array(axis, dtype=np.float64)
        if len(np.unique(values)) < len(values):
            raise HitchError(f"grid.{name} has a value twice; allowed: each once")
        tables.append((f"grid.{name}", {name: values}))
    if spec.runs:
        lengths = {name: len(values) for name, values in spec.runs.items()}
        if len(set(lengths.values())) > 1:
            listed = ", ".join(f"{name} has {count}" for name, count in lengths.items())
            raise HitchError(f"the columns of runs must have equal lengths; {listed}")
        tables.append(("runs", {name: np.array(values, dtype=np.float64) for name, values in spec.runs.items()}))
    if spec.sample:
        tables.append(("sample", _sampled(spec.sample)))
    return tables


def _check_order(place: str, low: float, high: float) -> None:
    if low > high:
        raise HitchError(f"{place}: min = {low:g} is greater than max = {high:g}; allowed: min less than max")
    if low == high:
        raise HitchError(f"{place} is an empty range, from {low:g} to {high:g}; allowed: min less than max")


def _spaced(place: str, axis: Range) -> Floats:
    _check_order(place, axis.min, axis.max)
    if axis.scale == "log" and axis.min <= 0.0:
        raise HitchError(f"{place}: min = {axis.min:g} is not allowed on a log scale; allowed: greater than 0")
    if axis.count > MOST_RUNS:
        raise HitchError(f"{place}: count = {axis.count} is not allowed; allowed: at most {MOST_RUNS}")
    return spaced(axis.min, axis.max, axis.count, axis.scale)


def _sampled(sample: Sample) -> Columns:
    for name, span in sample.ranges.items():
        _check_order(f"sample.ranges.{name}", span.min, span.max)
    if sample.count > MOST_RUNS:
        raise HitchError(f"sample.count = {sample.count} is not allowed; allowed: at most {MOST_RUNS}")
    if sample.method == "sobol" and sample.count & (sample.count - 1):
        below = 2 ** (sample.count.bit_length() - 1)
        raise HitchError(
            f"sample.count = {sample.count} is not allowed: a Sobol sequence is balanced for powers of two alone, "
            f"such as {below} or {2 * below}"
        )
    ranges = {name: (span.min, span.max) for name, span in sample.ranges.items()}
    return sampled(sample.method, sample.count, sample.seed, ranges)


def _varied_once(tables: Sequence[tuple[str, Columns]], given: Sequence[str]) -> tuple[str, ...]:
    """The names of all columns. HitchError if one comes twice, or is `given` otherwise."""
    found: dict[str, str] = dict.fromkeys(given, "parameters or profiles")
    for place, table in tables:
        for name in table:
            if name in found:
                raise HitchError(f"{name} stands in {found[name]} and in {place}; allowed: one of them")
            found[name] = place
    return tuple(name for _, table in tables for name in table)


def _values(spec: SweepSpec) -> list[tuple[str, Mapping[str, Sequence[float]]]]:
    """All values given, with the part of the spec in which they stand; of ranges the ends."""
    spans = spec.sample.ranges if spec.sample else {}
    grid = {name: [axis.min, axis.max] if isinstance(axis, Range) else axis for name, axis in spec.grid.items()}
    sample = {name: [span.min, span.max] for name, span in spans.items()}
    fixed = {name: [value] for name, value in spec.parameters.items()}
    return [("parameters", fixed), ("grid", grid), ("runs", spec.runs), ("sample.ranges", sample)]


def _check(place: str, table: Mapping[str, Sequence[float]], quantities: Mapping[str, Quantity]) -> None:
    try:
        for name, values in table.items():
            if name != "time":
                quantity: Quantity = named("parameter or input", name, quantities)
                for value in values:
                    quantity.check(value)
    except HitchError as error:
        raise HitchError(f"{place}: {error}") from None


def _names(kind: str, asked: Sequence[str] | None, table: Mapping[str, Any]) -> tuple[str, ...]:
    """The names asked for, in the order of `table`; all if None. HitchError for a name that is not there."""
    for name in asked or ():
        named(kind, name, table)
    return tuple(name for name in table if asked is None or name in asked)
