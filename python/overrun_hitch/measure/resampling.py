"""A trace between its samples. Two samples at one time are a jump, over which nothing is interpolated."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import Akima1DInterpolator

Floats = NDArray[np.float64]

SAME_TIME = 1e-9  # relative to the length of a trace
UNEVEN = 1e-6  # relative to the step: what the steps of an even grid may differ by, written with few digits


def jumps(time: Floats) -> NDArray[np.intp]:
    """Places of the samples (n,) that come right after a jump."""
    return np.flatnonzero(np.diff(time) <= SAME_TIME * (time[-1] - time[0])) + 1


def resampled(time: Floats, samples: Floats, at: Floats) -> Floats:
    """Values at the times `at` (m,) in s, within those of the samples (n,); at a jump those after it.

    Akima's cubics from jump to jump: local, so that a kink spoils only its neighbours.
    """
    ends = [0, *jumps(time), len(time)]
    starts = time[ends[:-1]]
    piece = np.maximum(np.searchsorted(starts, at + SAME_TIME * (time[-1] - time[0]), side="right") - 1, 0)
    found = np.empty_like(at)
    for number, (first, last) in enumerate(pairwise(ends)):
        mine = piece == number
        x, y = time[first:last], samples[first:last]
        if last - first < 3:
            found[mine] = np.interp(at[mine], x, y)
        else:
            found[mine] = Akima1DInterpolator(x, y)(np.clip(at[mine], x[0], x[-1]))
    return found


def is_even(time: Floats) -> bool:
    """Whether the samples (n,) are at even distances."""
    steps = np.diff(time)
    return bool(np.ptp(steps) <= UNEVEN * steps.mean() + 2.0 * np.spacing(np.abs(time).max()))
