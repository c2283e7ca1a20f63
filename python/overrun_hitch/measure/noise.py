"""How noisy a sampled trace is, without a model of what it shows."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def noise(channel: Floats) -> float:
    """Standard deviation of what is white in the samples (n,): from fourth differences, in which motion is small.

    Motion that has 30 samples or more a cycle adds 0.0002 of its amplitude or less.
    """
    differences = np.diff(channel, 4) / np.sqrt(70.0)  # the sum of squares of 1, 4, 6, 4, 1
    typical = 1.4826 * float(np.median(np.abs(differences)))  # of a normal distribution, whatever a few jumps add
    return max(typical or float(differences.std()), 1e-6 * float(np.ptp(channel)))
