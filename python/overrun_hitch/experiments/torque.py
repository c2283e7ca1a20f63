"""A brake torque that changes during a run."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from overrun_hitch.parameters import HitchError, Scenario

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Torque:
    """Straight lines between knots (n,), times in s and torques in N.m; two knots at one time are a jump.

    Before the first and after the last it stays. HitchError for what is none.
    """

    time: Floats
    values: Floats

    def __post_init__(self) -> None:
        if self.time.ndim != 1 or self.time.shape != self.values.shape:
            shapes = f"time has shape {self.time.shape}, brake_torque {self.values.shape}"
            raise HitchError(f"the profile's {shapes}; allowed: (n,), the same for both")
        if not (np.isfinite(self.time).all() and np.isfinite(self.values).all()):
            raise HitchError("the profile has a time or a brake_torque that is not finite; allowed: finite numbers")
        if not self.time.size:
            raise HitchError("the profile has no knot; allowed: one or more")
        if (np.diff(self.time) < 0.0).any():
            at = int(np.argmax(np.diff(self.time) < 0.0))
            raise HitchError(
                f"the profile's time must not decrease: {self.time[at + 1]:g} s is after {self.time[at]:g} s"
            )
        if (self.values < 0.0).any():
            raise HitchError(f"brake_torque = {self.values.min():g} N.m is not allowed: {_RANGE}")

    def knots(self, start: float, end: float) -> Floats:
        """Times of the knots between these two, in s."""
        return np.unique(self.time[(self.time > start) & (self.time < end)])

    def courses(self, points: Floats) -> list[tuple[float, float]]:
        """Torques at the start and at the end of each step between the points (n,) in s; knots must be points."""
        starts, ends = self._values(points[:-1], "right"), self._values(points[1:], "left")
        return list(zip(starts.tolist(), ends.tolist(), strict=True))

    def _values(self, at: Floats, side: str) -> Floats:
        """Limits from that side."""
        left = np.searchsorted(self.time, at, side="right" if side == "right" else "left") - 1
        left, right = np.maximum(left, 0), np.minimum(left + 1, len(self.time) - 1)
        length = self.time[right] - self.time[left]
        share = np.divide(at - self.time[left], length, out=np.zeros_like(at), where=length > 0.0)
        return np.asarray(self.values[left] + np.clip(share, 0.0, 1.0) * (self.values[right] - self.values[left]))


_RANGE = f"{Scenario.description('brake_torque')} must be {Scenario.allowed('brake_torque')}"
