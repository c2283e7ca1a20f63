"""When the drawbar enters and leaves compression, tension and its clearance, found between the samples of a run.

Compression is taken to be the cubic Hermite polynomial through its samples and its rates (trailer's less car's speed),
because a short visit can lie between two samples.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from overrun_hitch.measure.sampled import refined
from overrun_hitch.results import scenario_of, values

if TYPE_CHECKING:
    import xarray as xr

Floats = NDArray[np.float64]

FINE = 16  # parts of a sampling step


@dataclass(frozen=True)
class Passage:
    """The drawbar passes one end of its clearance."""

    time: float  # s
    end: str  # "0" or "eps"; "0" if there is no clearance
    inwards: bool  # being pushed in

    @property
    def kind(self) -> str:
        """What is passed and how: "eps in", "0 out"."""
        return f"{self.end} {'in' if self.inwards else 'out'}"


def passages(run: xr.Dataset) -> tuple[Passage, ...]:
    """Every time at which the drawbar of a run (see results.dataset, at least two samples) passes 0 or eps, in order.

    A touch without passing is none, nor is the start. Sampled every 10 ms, those of the paper's figure 10 are within
    3e-7 s of the oracle's.
    """
    from scipy.interpolate import CubicHermiteSpline  # here: `compressed_from` goes without, and is quickly loaded

    eps = scenario_of(run).parameters.eps
    time = values(run, "time")
    path = CubicHermiteSpline(time, values(run, "compression"), values(run, "v_trailer") - values(run, "v_car"))
    found = [
        Passage(float(root), end, bool(inwards))
        for end, level in ({"0": 0.0, "eps": eps} if eps > 0.0 else {"0": 0.0}).items()
        for root, inwards in _crossings(path, time, level)
    ]
    return tuple(sorted(found, key=lambda passage: passage.time))


def compressed_from(
    time: Floats, compression: Floats, rate: Floats, start: float, end: float
) -> tuple[float, bool, str]:
    """When (s) the drawbar is first compressed, whether it stays so, and a sentence if it was or is not so.

    Compressed between `start` and `end` (m), where its stiffness is one. Samples are (n,), in s, m and m/s. To a
    sixteenth, FINE, of the sampling step.
    """
    fine, path = refined(time, compression, rate, FINE)
    inside = path > start
    if not inside.any():
        return float(time[0]), False, "drawbar is never in compression"
    first = int(inside.argmax())
    entry = float(fine[first])
    if not inside[first:].all():
        leaves = fine[first + int((~inside[first:]).argmax())]
        return entry, False, f"drawbar leaves compression at t = {leaves:.2f} s"
    if (path > end).any():
        passed = fine[int((path > end).argmax())]
        return entry, False, f"drawbar's stiffness changes, at {end:g} m, at t = {passed:.2f} s"
    if compression[0] < start:
        return entry, True, f"drawbar comes into compression only at t = {entry:.2f} s"
    return entry, True, ""


def _crossings(path: Any, time: Floats, level: float) -> list[tuple[float, bool]]:
    """Times (s) at which `path` passes `level`, and whether upwards."""
    roots = path.solve(level, extrapolate=False)
    # NaN marks a stretch that lies on the level; a root at the start is where the drawbar was put.
    roots = np.unique(roots[np.isfinite(roots) & (roots > time[0]) & (roots < time[-1])])
    ends = np.concatenate([[time[0]], roots, [time[-1]]])
    above = path(0.5 * (ends[:-1] + ends[1:])) > level
    return [(root, after) for root, before, after in zip(roots, above, above[1:], strict=False) if before != after]
