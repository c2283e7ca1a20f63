"""Inputs that change during a run: straight lines between knots, exactly as an FMU with slopes of inputs can follow."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from overrun_hitch.parameters import HitchError

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Change:
    """What inputs do from the start of a step on, by name."""

    step: int  # number of the step, from 0
    values: Mapping[str, float]  # SI units
    slopes: Mapping[str, float]  # SI units per second, during this step; those left out are 0


@dataclass(frozen=True)
class Profile:
    """Inputs over time; before step 0 they have the values of its Change."""

    name: str
    knots: Mapping[str, Sequence[float]]  # "time" in s and the inputs
    changes: tuple[Change, ...]


def profile(
    name: str, table: Mapping[str, Sequence[float]], points: Floats, inputs: Collection[str], interpolates: bool
) -> Profile:
    """The profile of `table` ("time" and inputs) in a run through `points` (n,) in s, beyond the last knot constant.

    Two knots at the same time are a jump. `interpolates`: the FMU takes slopes. HitchError for knots that are not at
    communication points, and whatever else can't be followed.
    """
    place = f"profiles.{name}"
    time = np.array(table.get("time", ()), dtype=np.float64)
    driven = [key for key in table if key != "time"]
    _check_shape(place, table, time, driven, inputs)
    at = np.searchsorted(points, time - 1e-9 * points[-1])
    if (at >= len(points)).any() or (np.abs(points[np.minimum(at, len(points) - 1)] - time) > 1e-9 * points[-1]).any():
        raise HitchError(f"{place}.time: every knot must be a communication point, a multiple of {points[1]:g} s")
    values = np.array([table[key] for key in driven], dtype=np.float64)
    starts, slopes = _starts_and_slopes(at, values, points)
    if slopes.any() and not interpolates:
        raise HitchError(f"{place} has ramps, and an FMU does not interpolate inputs; allowed: jumps")
    return Profile(name, {key: tuple(table[key]) for key in table}, _changes(driven, starts, slopes))


def _check_shape(
    place: str, table: Mapping[str, Sequence[float]], time: Floats, driven: Sequence[str], inputs: Collection[str]
) -> None:
    if not len(time) or time[0] != 0.0 or (np.diff(time) < 0.0).any():
        raise HitchError(f"{place}.time is not allowed: it must start at 0 s and not decrease")
    if not driven:
        raise HitchError(f"{place} has no input; allowed: {', '.join(sorted(inputs))}")
    for key in driven:
        if key not in inputs:
            raise HitchError(f"{place}: there is no input {key!r:.40}; allowed: {', '.join(sorted(inputs))}")
        if len(table[key]) != len(time):
            raise HitchError(f"{place}.{key} has {len(table[key])} values for {len(time)} knots; allowed: one for each")


def _starts_and_slopes(at: NDArray[np.intp], values: Floats, points: Floats) -> tuple[Floats, Floats]:
    """Value at the start of every step and slope in it, both (inputs, steps)."""
    steps = np.arange(len(points) - 1)
    left = np.searchsorted(at, steps, side="right") - 1  # the last of several knots at one point
    right = np.minimum(left + 1, len(at) - 1)
    length = points[at[right]] - points[at[left]]
    rise = values[:, right] - values[:, left]
    slopes = np.divide(rise, length, out=np.zeros_like(rise), where=length > 0.0)
    return values[:, left] + slopes * (points[steps] - points[at[left]]), slopes


def _changes(driven: Sequence[str], starts: Floats, slopes: Floats) -> tuple[Change, ...]:
    """Step 0, and every later one in which an input does not just keep its value."""
    changes = []
    for step, (start, slope) in enumerate(zip(starts.T, slopes.T, strict=True)):
        if step == 0 or slope.any() or slopes[:, step - 1].any() or (start != starts[:, step - 1]).any():
            values = dict(zip(driven, start.tolist(), strict=True))
            sloping = {key: value for key, value in zip(driven, slope.tolist(), strict=True) if value}
            changes.append(Change(step, values, sloping))
    return tuple(changes)
