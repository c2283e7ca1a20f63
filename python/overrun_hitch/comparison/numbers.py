"""Growth rate, frequency and damping of two runs, and when the drawbar passes the ends of its clearance.

What may differ, and why:

- growth rate 0.001 1/s + 0.1 %, frequency 0.01 %, the damping ratio by both: about ten times closer than theory has to
  come (theory.py), because both sides solve the same equations. Judged where both drawbars stay in compression once
  there; else reported. Of measured traces the 95 % interval of the fit is added.
- times at which the drawbar passes 0 and eps: the funnel's width, one by one, in the same order.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from itertools import zip_longest

import numpy as np
import xarray as xr

from overrun_hitch.comparison.alignment import CONFIDENT
from overrun_hitch.comparison.distances import Allowed
from overrun_hitch.comparison.motion import with_motion
from overrun_hitch.comparison.theory import shunting, shunting_window
from overrun_hitch.measure.judged import Judged
from overrun_hitch.measure.oscillation import NoOscillation, Oscillation, measure
from overrun_hitch.measure.passages import Passage, passages
from overrun_hitch.results import VARIABLES, missing, values

GROWTH_RATE_ALLOWED = (0.001, 0.001)  # 1/s, and relative
FREQUENCY_ALLOWED = 1e-4  # relative


def shunting_numbers(reference: xr.Dataset, run: xr.Dataset, label: str) -> tuple[Judged, ...]:
    """Growth rate, frequency and damping ratio of both runs; `label` is the other's."""
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
    if missing_compression([run]):
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


def measured_numbers(reference: xr.Dataset, run: xr.Dataset) -> tuple[Judged, ...]:
    """Growth rate and frequency of a measured trace, to the 95 % interval of the fit beside what is allowed else.

    Both fitted where theory expects the oscillation in `reference`: noise passes for many things.
    """
    if missing_compression([reference, run]):
        return ()
    found, reason = _shunting(with_motion(reference, run))
    if isinstance(found, NoOscillation):
        return (Judged("shunting frequency", "Hz", math.nan, math.nan, math.nan, reason),)
    start, end = shunting_window(with_motion(reference, run))
    time = values(run, "time")
    seen = (time >= start) & (time <= end)
    time, trace = time[seen], values(run, "compression")[seen]
    other = measure(time, trace)
    if isinstance(other, NoOscillation):
        return (Judged("shunting frequency", "Hz", found.frequency, math.nan, math.nan, other.reason),)
    errors = other.errors_of(time, trace)
    growth_allowed = GROWTH_RATE_ALLOWED[0] + GROWTH_RATE_ALLOWED[1] * abs(found.growth_rate) + CONFIDENT * errors[0]
    frequency_allowed = FREQUENCY_ALLOWED * found.frequency + CONFIDENT * errors[1]
    return (
        Judged("shunting growth", "1/s", found.growth_rate, other.growth_rate, growth_allowed, reason),
        Judged("shunting frequency", "Hz", found.frequency, other.frequency, frequency_allowed, reason),
    )


def missing_compression(runs: Iterable[xr.Dataset]) -> bool:
    """Whether one of them has none, without which nothing is known of shunting and passages."""
    return any("compression" in missing(run) for run in runs)


def _passages(run: xr.Dataset) -> tuple[Passage, ...]:
    return passages(run) if _is_finite(run) else ()


def _is_finite(run: xr.Dataset) -> bool:
    given = [name for name in VARIABLES if name not in missing(run)]
    return bool(np.isfinite([values(run, name) for name in (*given, "v_car", "v_trailer")]).all())


def passage_numbers(reference: xr.Dataset, run: xr.Dataset, allowed: Allowed) -> tuple[Judged, ...]:
    """Each passage of A with that of the other, in order; those of one alone, or of different kinds, differ."""
    if missing_compression([reference, run]):
        return ()
    a, b = _passages(reference), _passages(run)
    rows: list[tuple[str, float, float]] = []
    for ours, theirs in zip_longest(a, b):
        if ours and theirs and ours.kind == theirs.kind:
            rows.append((ours.kind, ours.time, theirs.time))
        else:
            rows += [(ours.kind, ours.time, math.nan)] if ours else []
            rows += [(theirs.kind, math.nan, theirs.time)] if theirs else []
    return tuple(Judged(f"passes {kind}", "s", here, there, allowed.funnel_time) for kind, here, there in rows)
