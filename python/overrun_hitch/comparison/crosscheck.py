"""The same step brake by several files that should be the same model, and how far each is from the first, A.

What may differ, and why, stands in distances.py and numbers.py.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from string import ascii_uppercase

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from overrun_hitch.comparison.alignment import Alignment, align
from overrun_hitch.comparison.distances import Allowed, Distance, distances
from overrun_hitch.comparison.motion import with_motion
from overrun_hitch.comparison.numbers import measured_numbers, passage_numbers, shunting_numbers
from overrun_hitch.comparison.sources import Manoeuvre, Source, TheorySource, TraceSource, UnitSource
from overrun_hitch.comparison.theory import compare
from overrun_hitch.experiments.step_brake import car_alone
from overrun_hitch.measure.judged import Judged
from overrun_hitch.measure.resampling import is_even
from overrun_hitch.parameters import HitchError, Scenario
from overrun_hitch.results import values

Floats = NDArray[np.float64]

LABELS = ascii_uppercase  # of the files, in the order in which they were given; A is the reference
END = "end of the run"
NOISE_ALLOWED = 5.0  # standard deviations: one of two million samples of white noise lies beyond


@dataclass(frozen=True)
class Comparison:
    """One of the others against A."""

    label: str
    distances: tuple[Distance, ...] = ()  # in the order of results.VARIABLES
    numbers: tuple[Judged, ...] = ()  # growth rate, frequency, end of the run
    passages: tuple[Judged, ...] = ()  # times (s) at which the drawbar passes 0 or eps
    runs: tuple[xr.Dataset, ...] = ()  # A's and its own, at the same times
    alignment: Alignment | None = None  # of a measured trace
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
    reference: xr.Dataset | None  # A's run; None for theory
    comparisons: tuple[Comparison, ...]  # of all but A


def crosscheck(asked: Manoeuvre, sources: Sequence[Source], allowed: Allowed, measured: bool = False) -> Crosscheck:
    """Run the scenario on each and compare with the first. HitchError for what is wrong with that one.

    `measured`: traces in files are brought in line with A's time, and their noise is allowed for.
    """
    first, *others = sources
    reference = None if isinstance(first, TheorySource) else first.run(asked)
    if measured and not isinstance(first, UnitSource):
        raise HitchError("--measured needs an FMU as the reference, A, to bring the others in line with")

    def comparison(other: Source, label: str) -> Comparison:
        if reference is None:
            return _with_theory(asked, other, label)
        if measured and isinstance(other, TraceSource):
            return _measured(asked, first, reference, other, label, allowed)
        return _simulated(asked, first, reference, other, label, allowed)

    comparisons = []
    for label, other in zip(LABELS[1:], others, strict=False):
        try:
            comparisons.append(comparison(other, label))
        except HitchError as error:  # what goes wrong with one of the others is its own affair
            comparisons.append(Comparison(label, failure=str(error)))
    return Crosscheck(asked.scenario, reference, tuple(comparisons))


def _simulated(
    asked: Manoeuvre, first: Source, reference: xr.Dataset, other: Source, label: str, allowed: Allowed
) -> Comparison:
    """At the times of a trace, if one of the two is one: a simulation can be asked for any."""
    if isinstance(other, TraceSource):
        run = other.run(asked, _within(reference, other) if isinstance(first, TraceSource) else None)
        reference = first.run(asked, values(run, "time"))
    else:
        run = other.run(asked, values(reference, "time") if isinstance(first, TraceSource) else None)
    found = compare_runs(reference, run, label, allowed)
    if not {TraceSource} & {type(first), type(other)}:
        return found
    if not is_even(values(found.runs[0], "time")):
        even = _even_grid(found.runs[0], asked)
        numbers = compare_runs(first.run(asked, even), other.run(asked, even), label, allowed).numbers
        found = replace(found, numbers=numbers)
    ends = [number for number in found.numbers if number.quantity != END]  # a trace ends where it ends
    return replace(found, numbers=tuple(ends))


def _within(reference: xr.Dataset, other: TraceSource) -> Floats:
    """The times of one trace at which there is another one."""
    time, ends = values(reference, "time"), other.trace.time[[0, -1]]
    return np.asarray(time[(time >= ends[0]) & (time <= ends[1])])


def _even_grid(run: xr.Dataset, asked: Manoeuvre) -> Floats:
    """Multiples of the communication step within the run."""
    h, time = asked.settings.communication_step, values(run, "time")
    return np.asarray(np.arange(math.ceil(time[0] / h - 1e-9), math.floor(time[-1] / h + 1e-9) + 1) * h)


def _measured(
    asked: Manoeuvre, first: Source, reference: xr.Dataset, other: TraceSource, label: str, allowed: Allowed
) -> Comparison:
    alignment = align(reference, other.trace)
    run = TraceSource(other.trace.shifted(alignment.shift)).run(asked)
    own = first.run(asked, values(run, "time"))
    noise = {name: NOISE_ALLOWED * sigma for name, sigma in alignment.noise.items()}
    wider = allowed.model_copy(update={"funnel_time": allowed.funnel_time + alignment.error})
    even = _even_grid(run, asked)
    at_even = TraceSource(other.trace.shifted(alignment.shift)).run(asked, even)
    return Comparison(
        label=label,
        distances=distances(own, run, label, wider, noise),
        numbers=measured_numbers(first.run(asked, even), at_even),
        runs=(own, run),
        alignment=alignment,
    )


def _with_theory(asked: Manoeuvre, other: Source, label: str) -> Comparison:
    run = other.run(asked)
    alone = None
    if isinstance(other, UnitSource):
        alone = other.run(replace(asked, scenario=car_alone(asked.scenario)))
    return Comparison(label, numbers=tuple(compare(run, alone)), runs=(run, run))


def compare_runs(reference: xr.Dataset, run: xr.Dataset, label: str, allowed: Allowed) -> Comparison:
    """Compare two runs of one scenario with the same communication points, over the time that both ran.

    HitchError where one of them is at rest from the start.
    """
    for one in (reference, run):
        if one.sizes["time"] < 2:
            raise HitchError(f"{one.attrs['fmu']} does not run: it is at rest at t = 0")
    ends = Judged(END, "s", float(reference["time"][-1]), float(run["time"][-1]), 0.0)
    both = slice(0, min(reference.sizes["time"], run.sizes["time"]))
    reference, run = reference.isel(time=both), run.isel(time=both)
    a, b = with_motion(reference, run), with_motion(run, reference)
    return Comparison(
        label=label,
        distances=distances(reference, run, label, allowed),
        numbers=(*shunting_numbers(a, b, label), ends),
        passages=passage_numbers(a, b, allowed),
        runs=(reference, run),
    )
