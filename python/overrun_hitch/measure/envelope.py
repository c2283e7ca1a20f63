"""The envelope of an oscillation, from the peaks and valleys of a sampled trace, without any theory of the vehicle."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def measured_envelope(time: Floats, trace: Floats) -> tuple[Floats, Floats]:
    """Times (m,) in s of the extrema, but for the first and the last, and the amplitudes (m,) there.

    trace (n,) in any unit, sampled evenly at `time` (n,) in s. Exact for a sine that grows or fades exponentially about
    a value that stays, but for the parabola that is put through the three samples at each extremum.
    """
    instants, extrema = _extrema(time, trace)
    before, after = np.abs(np.diff(extrema))[:-1], np.abs(np.diff(extrema))[1:]
    # With a factor q from one extremum to the next the swings before and after are a (1 + 1/q) and a (1 + q).
    at_extremum = before * after / (before + after)
    # A growing sine has its extrema where the cosine is not quite 1.
    tangent = np.log(after / before) / np.pi  # growth rate over angular frequency
    return instants[1:-1], at_extremum * np.sqrt(1.0 + tangent**2)


def measured_decrement(time: Floats, trace: Floats) -> tuple[float, float]:
    """Growth rate (1/s) and frequency (Hz) from swings, peak to valley, one period apart: the logarithmic decrement.

    trace (n,) in any unit, sampled evenly at `time` (n,) in s. Needs no harmonic: right for all motions whose cycles
    are alike but for their size, as those of a damper of two rates, whose mean shifts with the amplitude. NaN where
    there is not one period.
    """
    instants, extrema = _extrema(time, trace)
    swings = np.abs(np.diff(extrema))
    if len(swings) < 3:
        return float("nan"), float("nan")
    middles = 0.5 * (instants[1:] + instants[:-1])
    periods = middles[2:] - middles[:-2]
    return float(np.mean(np.log(swings[2:] / swings[:-2]) / periods)), float(1.0 / np.mean(periods))


def _extrema(time: Floats, trace: Floats) -> tuple[Floats, Floats]:
    slope = np.diff(trace)
    at = np.flatnonzero(slope[:-1] * slope[1:] < 0.0) + 1
    left, middle, right = trace[at - 1], trace[at], trace[at + 1]
    offset = 0.5 * (left - right) / (left - 2.0 * middle + right)  # in samples
    return time[at] + offset * (time[1] - time[0]), middle - 0.25 * (left - right) * offset
