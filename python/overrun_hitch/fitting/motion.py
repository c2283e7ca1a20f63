"""The motion behind a measured travel: smooth, with its rate, and how far it may be off."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import UnivariateSpline
from scipy.ndimage import maximum_filter1d, minimum_filter1d

from overrun_hitch.fitting.trace import Floats, Trace
from overrun_hitch.measure.noise import noise

# Of the samples' noise in square, what a spline may leave: from all of it to what one with 200 knots in 1000 leaves.
LEFT = (1.0, 0.97, 0.94, 0.91, 0.88, 0.84, 0.8)
STILL = 10.0  # errors that something must move to be moving


@dataclass(frozen=True)
class Motion:
    """Compression (n,) in m and its rate (n,) in m/s at the times (n,) in s of a trace."""

    time: Floats
    compression: Floats
    v_rel: Floats
    error: float  # m, standard deviation by which compression may be off the true motion
    memory: int  # samples, over which that error hangs together
    still: NDArray[np.bool_]  # (n,), near samples where it moves less than can be told from that error


def motion(trace: Trace) -> Motion:
    """Travel and, where it was measured, speed as one motion.

    Noise is taken to be white, of the size that its fourth differences have, and the motion to be smooth: a spline of
    the smoothness that cross-validation finds best. A measured speed is integrated, and the travel corrects what
    has added up, so that an offset of the speed does no harm.
    """
    time = trace.time
    sway, sway_rate = np.zeros_like(time), np.zeros_like(time)
    if trace.v_rel is not None:
        speed = _spline(time, trace.v_rel, 4, noise(trace.v_rel))
        sway, sway_rate = speed.antiderivative()(time), speed(time)
    sigma = noise(trace.compression)
    rest = _spline(time, trace.compression - sway, 5, sigma)
    spacing = len(time) / len(rest.get_coeffs())  # samples for each coefficient, which takes in the noise of one
    compression = sway + rest(time)
    # Twice the noise that a spline lets through, for where it bends off the motion itself.
    error, memory = 2.0 * sigma / float(np.sqrt(spacing)), int(np.ceil(4.0 * spacing))
    reach = maximum_filter1d(compression, memory) - minimum_filter1d(compression, memory)
    return Motion(
        time=time,
        compression=compression,
        v_rel=sway_rate + rest.derivative()(time),
        error=error,
        memory=memory,
        still=maximum_filter1d(reach < STILL * error, memory),
    )


def _spline(time: Floats, samples: Floats, degree: int, sigma: float) -> UnivariateSpline:
    """The one of least generalized cross-validation error (Craven and Wahba 1979): residual over (n - coefficients)."""
    n = len(time)
    splines = [UnivariateSpline(time, samples, w=np.full(n, 1.0 / sigma), k=degree, s=left * n) for left in LEFT]
    return min(splines, key=lambda spline: spline.get_residual() / (n - len(spline.get_coeffs())) ** 2)
