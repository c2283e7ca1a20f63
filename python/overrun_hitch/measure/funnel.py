"""Whether a trace stays in a funnel around another one. The one module that touches pyfunnel, which has no types.

pyfunnel (Lawrence Berkeley National Laboratory) moves a rectangle along the reference and takes its hull: so many units
up and down, so many seconds to either side. It answers in files, and takes differences below 1e-10 for none, whatever
the unit: hence the temporary folder and the scaling. It takes NaN for inside: nothing but finite numbers may reach it.
"""

from __future__ import annotations

import contextlib
import io
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pyfunnel
from numpy.typing import NDArray

from overrun_hitch.parameters import HitchError

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Funnel:
    """The funnel around a reference and where a trace is outside of it; samples (n,) in the unit of the trace."""

    lower: Floats
    upper: Floats
    outside: Floats  # beyond the nearer bound; 0 inside


def funnel(time: Floats, reference: Floats, trace: Floats, *, height: float, width: float) -> Funnel:
    """Compare two traces (n,), n >= 2, all finite, both sampled at `time` (n,) in s.

    height > 0, in the unit of the trace, and width, in s, are half those of the rectangle. HitchError on a machine for
    which pyfunnel has no library.
    """
    with tempfile.TemporaryDirectory(prefix="funnel-") as folder, contextlib.redirect_stdout(io.StringIO()) as said:
        try:
            status = pyfunnel.compareAndReport(
                time, reference / height, time, trace / height, outputDirectory=folder, atolx=width, atoly=1.0
            )
        except RuntimeError as error:
            raise HitchError(f"traces cannot be compared here: {' '.join(str(error).split())}") from None
        if status != 0:
            raise HitchError(f"traces cannot be compared: {' '.join(said.getvalue().split())}")
        outside, lower, upper = (_read(Path(folder) / f"{name}.csv") for name in ("errors", "lowerBound", "upperBound"))
    return Funnel(
        lower=height * np.interp(time, lower[:, 0], lower[:, 1]),
        upper=height * np.interp(time, upper[:, 0], upper[:, 1]),
        outside=height * outside[:, 1],
    )


def _read(path: Path) -> Floats:
    """The two columns (n, 2) of one of pyfunnel's tables."""
    return np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2, dtype=np.float64)
