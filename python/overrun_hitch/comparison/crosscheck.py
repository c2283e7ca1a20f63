"""The same step brake by several files that should be the same model, and how far each is from the first, A.

What may differ, and why:

- traces: a funnel (see funnel.py) of 0.1 % of the variable's range in A, and of 0.1 ms to either side. Our FMU at
  tolerances from 1e-3 to 1e-6 stays within 0.02 %; with a damper or a spring 1 % off some variable of every figure
  leaves it. 0.1 ms is a fortieth of the fastest time constant (the wheels' at 40 m/s): a steep flank is no false alarm.
- growth rate 0.001 1/s + 0.1 %, frequency 0.01 %, the damping ratio by both: about ten times closer than theory has to
  come (theory.py), because both sides solve the same equations. Judged where both drawbars stay in compression once
  there; else reported.
- times at which the drawbar passes 0 and eps: the funnel's width, one by one, in the same order.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import zip_longest
from string import ascii_uppercase

import numpy as np
import xarray as xr

from overrun_hitch.comparison.distances import Allowed, Distance, distances
from overrun_hitch.comparison.sources import UnitSource
from overrun_hitch.comparison.theory import shunting
from overrun_hitch.fmu.settings import Settings
from overrun_hitch.measure.judged import Judged
from overrun_hitch.measure.oscillation import NoOscillation, Oscillation
from overrun_hitch.measure.passages import Passage, passages
from overrun_hitch.parameters import HitchError, Scenario
from overrun_hitch.results import VARIABLES, missing, values

LABELS = ascii_uppercase  # of the files, in the order in which they were given; A is the reference

GROWTH_RATE_ALLOWED = (0.001, 0.001)  # 1/s, and relative
FREQUENCY_ALLOWED = 1e-4  # relative


@dataclass(frozen=True)
class Comparison:
    """One of the others against A."""

    label: str
    distances: tuple[Distance, ...] = ()  # in the order of results.VARIABLES
    numbers: tuple[Judged, ...] = ()  # growth rate, frequency, end of the run
    passages: tuple[Judged, ...] = ()  # times (s) at which the drawbar passes 0 or eps
    runs: tuple[xr.Dataset, ...] = ()  # A's and its own
    failure: str = ""  # why there is nothing to compare

    @property
    def not_compared(self) -> list[str]:
        """The names of the variables that one of the two has not."""
        return [distance.variable for distance in self.distances if distance.not_judged]

    @property
    def differing(self) -> list[str]:
        """The names of what differs."""
        names = [distance.variable for distance in self.distances if distance.differs]
        names += [number.quantity for number in self.numbers if number.differs]
        return names + ["drawbar passages"] * any(passage.differs for passage in self.passages)


@dataclass(frozen=True)
class Crosscheck:
    """One scenario on all of them."""

    scenario: Scenario
    reference: xr.Dataset  # A's run
    comparisons: tuple[Comparison, ...]  # of all but A


def crosscheck(scenario: Scenario, sources: Sequence[UnitSource], settings: Settings, allowed: Allowed) -> Crosscheck:
    """Run `scenario` on each and compare with the first. HitchError for what is wrong with that one."""
    reference = sources[0].run(scenario, settings)
    others = zip(LABELS[1:], sources[1:], strict=False)
    return Crosscheck(
        scenario,
        reference,
        tuple(_compared(reference, scenario, other, label, settings, allowed) for label, other in others),
    )


def _compared(
    reference: xr.Dataset, scenario: Scenario, other: UnitSource, label: str, settings: Settings, allowed: Allowed
) -> Comparison:
    """What goes wrong with one of the others is its own affair."""
    try:
        return compare_runs(reference, other.run(scenario, settings), label, allowed)
    except HitchError as error:
        return Comparison(label, failure=str(error))


def compare_runs(reference: xr.Dataset, run: xr.Dataset, label: str, allowed: Allowed) -> Comparison:
    """Compare two runs of one scenario with the same communication points, over the time that both ran.

    HitchError where one of them is at rest from the start.
    """
    for one in (reference, run):
        if one.sizes["time"] < 2:
            raise HitchError(f"{one.attrs['fmu']} does not run: it is at rest at t = 0")
    ends = Judged("end of the run", "s", float(reference["time"][-1]), float(run["time"][-1]), 0.0)
    both = slice(0, min(reference.sizes["time"], run.sizes["time"]))
    reference, run = reference.isel(time=both), run.isel(time=both)
    a, b = with_motion(reference, run), with_motion(run, reference)
    return Comparison(
        label=label,
        distances=distances(reference, run, label, allowed),
        numbers=(*_shunting_numbers(a, b, label), ends),
        passages=() if missing_motion([a, b]) else _passage_numbers(_passages(a), _passages(b), allowed),
        runs=(reference, run),
    )


def with_motion(run: xr.Dataset, other: xr.Dataset) -> xr.Dataset:
    """`run` with the speeds that it has not: the car's from the `other`, the trailer's by the rate of compression."""
    absent = missing(run)
    if "v_car" in absent:
        run = run.assign(v_car=other["v_car"])
    if "v_trailer" in absent:
        rate = np.gradient(values(run, "compression"), values(run, "time"))
        run = run.assign(v_trailer=("time", values(run, "v_car") + rate, run["v_trailer"].attrs))
    return run


def missing_motion(runs: Iterable[xr.Dataset]) -> bool:
    """Whether one of them has no compression, without which nothing is known of shunting and passages."""
    return any("compression" in missing(run) for run in runs)


def _shunting_numbers(reference: xr.Dataset, run: xr.Dataset, label: str) -> tuple[Judged, ...]:
    (a, reason), (b, other_reason) = _shunting(reference), _shunting(run)
    reason = reason or (other_reason and f"{label}: {other_reason}")
    (growth, frequency), (other_growth, other_frequency) = _rates(a), _rates(b)
    growth_allowed = GROWTH_RATE_ALLOWED[0] + GROWTH_RATE_ALLOWED[1] * abs(growth)
    damping, other_damping = _damping(growth, frequency), _damping(other_growth, other_frequency)
    damping_allowed = growth_allowed / (2.0 * math.pi * frequency) + FREQUENCY_ALLOWED * abs(damping)
    return (
        Judged("shunting growth", "1/s", growth, other_growth, growth_allowed, reason),
        Judged("shunting frequency", "Hz", frequency, other_frequency, FREQUENCY_ALLOWED * frequency, reason),
        Judged("damping ratio", "1", damping, other_damping, damping_allowed, reason),
    )


def _shunting(run: xr.Dataset) -> tuple[Oscillation | NoOscillation, str]:
    """The oscillation, and "" or why it is not judged."""
    if missing_motion([run]):
        return NoOscillation(""), "no compression is given"
    if not (_is_finite(run) and (run["v_car"] > 0.0).all()):  # what theory needs to say where start-up is over
        return NoOscillation(""), "the traces are not those of a vehicle that rolls forward"
    found, reason = shunting(run)
    return found, reason or (found.reason if isinstance(found, NoOscillation) else "")


def _rates(found: Oscillation | NoOscillation) -> tuple[float, float]:
    """Growth rate (1/s) and frequency (Hz)."""
    return (found.growth_rate, found.frequency) if isinstance(found, Oscillation) else (math.nan, math.nan)


def _damping(growth: float, frequency: float) -> float:
    return -growth / math.hypot(growth, 2.0 * math.pi * frequency)


def _passages(run: xr.Dataset) -> tuple[Passage, ...]:
    return passages(run) if _is_finite(run) else ()


def _is_finite(run: xr.Dataset) -> bool:
    given = [name for name in VARIABLES if name not in missing(run)]
    return bool(np.isfinite([values(run, name) for name in (*given, "v_car", "v_trailer")]).all())


def _passage_numbers(a: Sequence[Passage], b: Sequence[Passage], allowed: Allowed) -> tuple[Judged, ...]:
    """Each passage of A with that of the other, in order; those of one alone, or of different kinds, differ."""
    rows: list[tuple[str, float, float]] = []
    for ours, theirs in zip_longest(a, b):
        if ours and theirs and ours.kind == theirs.kind:
            rows.append((ours.kind, ours.time, theirs.time))
        else:
            rows += [(ours.kind, ours.time, math.nan)] if ours else []
            rows += [(theirs.kind, math.nan, theirs.time)] if theirs else []
    return tuple(Judged(f"passes {kind}", "s", here, there, allowed.funnel_time) for kind, here, there in rows)
