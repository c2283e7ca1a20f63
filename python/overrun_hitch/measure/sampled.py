"""What lies between samples: integrals, and the cubic through values and rates.

SciPy has both; loading the parts of it that do takes a third of the time of `hitch run`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def integrals(samples: Floats, time: Floats) -> Floats:
    """Integrals (n,) from the start to each `time` (n,), by the trapezoidal rule."""
    areas = np.diff(time) * (samples[1:] + samples[:-1]) / 2.0
    return np.concatenate([[0.0], np.cumsum(areas)])


def refined(time: Floats, samples: Floats, rates: Floats, parts: int) -> tuple[Floats, Floats]:
    """Times (parts (n - 1) + 1,) that divide each step into so many equal parts, and the values there.

    They are those of the cubic Hermite polynomials through the samples (n,) at `time` (n,) with these rates (n,).
    """
    share = np.arange(parts)[None] / parts
    h, slope = np.diff(time)[:, None], (np.diff(samples) / np.diff(time))[:, None]
    before, after = rates[:-1, None], rates[1:, None]
    since = share * h
    bend = before + after - 2.0 * slope
    cubic = samples[:-1, None] + since * (before + share * (slope - before - bend + share * bend))
    fine = time[:-1, None] + since
    return np.append(fine, time[-1]), np.append(cubic, samples[-1])
