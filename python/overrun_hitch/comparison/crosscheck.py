"""The same step brake on several FMUs that should be the same model, and how far each is from the first, A.

What may differ, and why:

- traces: a funnel (see funnel.py) of 0.1 % of the variable's range in A, and of 0.1 ms to either side. Our FMU at
  tolerances from 1e-3 to 1e-6 stays within 0.02 %; with a damper or a spring 1 % off some variable of every figure
  leaves it. 0.1 ms is a fortieth of the fastest time constant (the wheels' at 40 m/s): a steep flank is no false alarm.
- growth rate 0.001 1/s + 0.1 %, frequency 0.01 %: about ten times closer than theory has to come (theory.py), because
  both sides solve the same equations. Judged where both drawbars stay in compression once there; else reported.
- times at which the drawbar passes 0 and eps: the funnel's width, one by one, in the same order.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import zip_longest
from string import ascii_uppercase

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from overrun_hitch.comparison.theory import shunting
from overrun_hitch.decimals import decimals
from overrun_hitch.experiments.step_brake import brake
from overrun_hitch.fmu.settings import Settings
from overrun_hitch.fmu.unit import AnyUnit
from overrun_hitch.measure.funnel import Funnel, funnel
from overrun_hitch.measure.judged import Judged
from overrun_hitch.measure.oscillation import NoOscillation, Oscillation
from overrun_hitch.measure.passages import Passage, passages
from overrun_hitch.parameters import HitchError, Quantities, Scenario, quantity
from overrun_hitch.results import VARIABLES, values

Floats = NDArray[np.float64]

LABELS = ascii_uppercase  # of the FMUs, in the order in which they were given; A is the reference

GROWTH_RATE_ALLOWED = (0.001, 0.001)  # 1/s, and relative
FREQUENCY_ALLOWED = 1e-4  # relative


class Allowed(Quantities):
    """How far a trace may be from A's."""

    funnel: float = quantity(1e-3, "", "half height of the funnel, relative to the variable's range", gt=0.0, le=1.0)
    funnel_time: float = quantity(1e-4, "s", "half width of the funnel", ge=0.0, le=1.0)


@dataclass(frozen=True)
class Distance:
    """One variable of one FMU from A's, over the time that both ran. NaN where a trace is not finite."""

    variable: str
    unit: str
    largest: float  # distance, in `unit`
    at: float  # s, where it is largest
    range: float  # of A's trace, in `unit`
    outside: float  # farthest beyond the funnel, in `unit`; 0 inside
    leaves: float  # s, where the trace first leaves the funnel; NaN inside

    @property
    def differs(self) -> bool:
        """True where the trace is not in the funnel from start to end."""
        return self.outside != 0.0

    @property
    def verdict(self) -> str:
        """ "agrees" or "differs"."""
        return "differs" if self.differs else "agrees"


@dataclass(frozen=True)
class Comparison:
    """One FMU against A."""

    label: str
    distances: tuple[Distance, ...]  # in the order of results.VARIABLES
    numbers: tuple[Judged, ...]  # growth rate, frequency, end of the run
    passages: tuple[Judged, ...]  # times (s) at which the drawbar passes 0 or eps

    @property
    def differing(self) -> list[str]:
        """The names of what differs."""
        names = [distance.variable for distance in self.distances if distance.differs]
        names += [number.quantity for number in self.numbers if number.differs]
        return names + ["drawbar passages"] * any(passage.differs for passage in self.passages)


@dataclass(frozen=True)
class Crosscheck:
    """One scenario on all FMUs."""

    scenario: Scenario
    runs: tuple[xr.Dataset, ...]  # as LABELS
    comparisons: tuple[Comparison, ...]  # of all but A


def compare_units(scenario: Scenario, units: Sequence[AnyUnit], settings: Settings, allowed: Allowed) -> Crosscheck:
    """Run `scenario` on each unit and compare with the first. HitchError for a file that is no such FMU.

    Units in one process may share more than their names; see guest_file.
    """
    runs = tuple(brake(unit, scenario, settings) for unit in units)
    others = zip(LABELS[1:], runs[1:], strict=False)
    return Crosscheck(scenario, runs, tuple(compare_runs(runs[0], run, label, allowed) for label, run in others))


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
    return Comparison(
        label=label,
        distances=tuple(_distance(reference, run, name, allowed) for name in VARIABLES),
        numbers=(*_shunting_numbers(reference, run, label), ends),
        passages=_passage_numbers(_passages(reference), _passages(run), allowed),
    )


def funnel_around(reference: xr.Dataset, run: xr.Dataset, name: str, allowed: Allowed) -> Funnel:
    """The funnel around a variable of `reference`, and where `run` leaves it; both finite."""
    trace = values(reference, name)
    extent = float(np.ptp(trace)) or float(np.abs(trace).max()) or 1.0  # a constant has no range, nothing no size
    height, width = allowed.funnel * extent, allowed.funnel_time
    return funnel(values(reference, "time"), trace, values(run, name), height=height, width=width)


def _distance(reference: xr.Dataset, run: xr.Dataset, name: str, allowed: Allowed) -> Distance:
    time, a, b = decimals(values(reference, "time")), values(reference, name), values(run, name)
    unit, _ = VARIABLES[name]
    if not np.isfinite([a, b]).all():
        return Distance(name, unit, *[math.nan] * 5)
    distance = np.abs(b - a)
    outside = funnel_around(reference, run, name, allowed).outside
    return Distance(
        variable=name,
        unit=unit,
        largest=float(distance.max()),
        at=time[distance.argmax()],
        range=float(np.ptp(a)),
        outside=float(outside.max()),
        leaves=time[(outside > 0.0).argmax()] if outside.any() else math.nan,
    )


def _shunting_numbers(reference: xr.Dataset, run: xr.Dataset, label: str) -> tuple[Judged, Judged]:
    (a, reason), (b, other_reason) = _shunting(reference), _shunting(run)
    reason = reason or (other_reason and f"{label}: {other_reason}")
    (growth, frequency), (other_growth, other_frequency) = _rates(a), _rates(b)
    growth_allowed = GROWTH_RATE_ALLOWED[0] + GROWTH_RATE_ALLOWED[1] * abs(growth)
    return (
        Judged("shunting growth", "1/s", growth, other_growth, growth_allowed, reason),
        Judged("shunting frequency", "Hz", frequency, other_frequency, FREQUENCY_ALLOWED * frequency, reason),
    )


def _shunting(run: xr.Dataset) -> tuple[Oscillation | NoOscillation, str]:
    """The oscillation, and "" or why it is not judged."""
    if not (_is_finite(run) and (run["v_car"] > 0.0).all()):  # what theory needs to say where start-up is over
        return NoOscillation(""), "the traces are not those of a vehicle that rolls forward"
    found, reason = shunting(run)
    return found, reason or (found.reason if isinstance(found, NoOscillation) else "")


def _rates(found: Oscillation | NoOscillation) -> tuple[float, float]:
    """Growth rate (1/s) and frequency (Hz)."""
    return (found.growth_rate, found.frequency) if isinstance(found, Oscillation) else (math.nan, math.nan)


def _passages(run: xr.Dataset) -> tuple[Passage, ...]:
    return passages(run) if _is_finite(run) else ()


def _is_finite(run: xr.Dataset) -> bool:
    return all(np.isfinite(values(run, name)).all() for name in VARIABLES)


def _passage_numbers(a: Sequence[Passage], b: Sequence[Passage], allowed: Allowed) -> tuple[Judged, ...]:
    """Each passage of A with that of the other FMU, in order; those of one alone, or of different kinds, differ."""
    rows: list[tuple[str, float, float]] = []
    for ours, theirs in zip_longest(a, b):
        if ours and theirs and ours.kind == theirs.kind:
            rows.append((ours.kind, ours.time, theirs.time))
        else:
            rows += [(ours.kind, ours.time, math.nan)] if ours else []
            rows += [(theirs.kind, math.nan, theirs.time)] if theirs else []
    return tuple(Judged(f"passes {kind}", "s", here, there, allowed.funnel_time) for kind, here, there in rows)
