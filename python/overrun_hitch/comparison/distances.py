"""How far one trace is from another, and what an error that people make would look like."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from overrun_hitch.decimals import decimals
from overrun_hitch.measure.funnel import Funnel, funnel
from overrun_hitch.parameters import Quantities, quantity
from overrun_hitch.results import VARIABLES, missing, values

Floats = NDArray[np.float64]

ALIKE = 0.05  # of the trace's own size: what a trace may leave, scaled, to be the other one in another unit
FACTORS = {
    1e3: "a factor of 1000, unit?", 1e-3: "a factor of 0.001, unit?", 3.6: "a factor of 3.6, km/h?",
    1 / 3.6: "a factor of 1/3.6, km/h?", 100.0: "a factor of 100, per cent?", 0.01: "a factor of 0.01, per cent?",
}  # fmt: skip


class Allowed(Quantities):
    """How far a trace may be from A's."""

    funnel: float = quantity(1e-3, "", "half height of the funnel, relative to the variable's range", gt=0.0, le=1.0)
    funnel_time: float = quantity(1e-4, "s", "half width of the funnel", ge=0.0, le=1.0)


@dataclass(frozen=True)
class Distance:
    """One variable of one file from A's, over the time that both ran. NaN where a trace is not finite."""

    variable: str
    unit: str
    largest: float = math.nan  # distance, in `unit`
    at: float = math.nan  # s, where it is largest
    rms: float = math.nan  # root mean square of the distance over the samples, in `unit`
    range: float = math.nan  # of A's trace, in `unit`
    allowed: float = math.nan  # half height of the funnel, in `unit`
    outside: float = math.nan  # farthest beyond the funnel, in `unit`; 0 inside
    leaves: float = math.nan  # s, where the trace first leaves the funnel; NaN inside
    hint: str = ""  # what may be the matter: "opposite sign?"
    not_judged: str = ""  # the reason, if there is one

    @property
    def differs(self) -> bool:
        """True where the trace was judged and is not in the funnel from start to end."""
        return not self.not_judged and self.outside != 0.0

    @property
    def verdict(self) -> str:
        """ "agrees", "differs" or "not judged"."""
        return "not judged" if self.not_judged else "differs" if self.differs else "agrees"


def distances(
    reference: xr.Dataset, run: xr.Dataset, label: str, allowed: Allowed, noise: dict[str, float] | None = None
) -> tuple[Distance, ...]:
    """Of all results.VARIABLES, in their order; both runs at the same times, at least two.

    `noise` widens the funnel: by so much, in the variable's unit.
    """
    absent = {name: "A" for name in missing(reference)} | {name: label for name in missing(run)}
    return tuple(
        Distance(name, unit, not_judged=f"{absent[name]} has no {name}")
        if name in absent
        else _distance(reference, run, name, allowed, (noise or {}).get(name, 0.0))
        for name, (unit, _) in VARIABLES.items()
    )


def funnel_around(reference: xr.Dataset, trace: Floats, name: str, allowed: Allowed, noise: float = 0.0) -> Funnel:
    """The funnel around a variable of `reference`, and where `trace` (n,) leaves it; both finite."""
    height, width = _height(values(reference, name), allowed) + noise, allowed.funnel_time
    return funnel(values(reference, "time"), values(reference, name), trace, height=height, width=width)


def _height(trace: Floats, allowed: Allowed) -> float:
    extent = float(np.ptp(trace)) or float(np.abs(trace).max()) or 1.0  # a constant has no range, nothing no size
    return allowed.funnel * extent


def _distance(reference: xr.Dataset, run: xr.Dataset, name: str, allowed: Allowed, noise: float) -> Distance:
    time, a, b = decimals(values(reference, "time")), values(reference, name), values(run, name)
    unit, _ = VARIABLES[name]
    if not np.isfinite([a, b]).all():
        return Distance(name, unit)
    distance = np.abs(b - a)
    outside = funnel_around(reference, b, name, allowed, noise).outside
    return Distance(
        variable=name,
        unit=unit,
        largest=float(distance.max()),
        at=time[distance.argmax()],
        rms=float(np.sqrt(np.mean(distance**2))),
        range=float(np.ptp(a)),
        allowed=_height(a, allowed) + noise,
        outside=float(outside.max()),
        leaves=time[(outside > 0.0).argmax()] if outside.any() else math.nan,
        hint=_hint(a, b) if outside.any() else "",
    )


def _hint(a: Floats, b: Floats) -> str:
    """Where `b` is `a` but for the sign or one of FACTORS; "" else."""
    size = float(a @ a)
    scale = float(a @ b) / size if size > 0.0 else 0.0
    if scale == 0.0 or float(np.sum((b - scale * a) ** 2)) > ALIKE**2 * float(b @ b):
        return ""
    words = next((words for factor, words in FACTORS.items() if abs(abs(scale) / factor - 1.0) < ALIKE), "")
    sign = "opposite sign?" if scale < 0.0 and (words or abs(abs(scale) - 1.0) < ALIKE) else ""
    return ", ".join(filter(None, [sign, words]))
