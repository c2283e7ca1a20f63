"""What was measured: travel, force and, where there are, speed and brake torque over time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from overrun_hitch.parameters import HitchError

Floats = NDArray[np.float64]

LEAST = 50  # samples: a fit has up to ten parameters
# By the names of the FMU's variables, with its units and its signs.
UNITS: Mapping[str, str] = MappingProxyType(
    {"time": "s", "compression": "m", "F_hitch": "N", "v_rel": "m/s", "trailer_brake_torque": "N.m"}
)


@dataclass(frozen=True)
class Trace:
    """A measurement: arrays (n,) in UNITS; HitchError for what is none."""

    time: Floats
    compression: Floats  # positive when pushed in; 0 where the drawbar is pulled out
    F_hitch: Floats  # positive when the drawbar is pushed in
    v_rel: Floats | None = None  # rate of compression
    trailer_brake_torque: Floats | None = None

    def __post_init__(self) -> None:
        for name, channel in self.channels().items():
            if channel.shape != self.time.shape or channel.ndim != 1:
                raise HitchError(f"{name} has shape {channel.shape}; allowed: {self.time.shape}, that of time, (n,)")
            wrong = np.flatnonzero(~np.isfinite(channel))
            if wrong.size:
                raise HitchError(f"{name} of sample {wrong[0] + 1} is {channel[wrong[0]]:g}; a finite number is needed")
        if len(self.time) < LEAST:
            raise HitchError(f"the trace has {len(self.time)} samples; at least {LEAST} are needed")
        back = np.flatnonzero(np.diff(self.time) <= 0.0)
        if back.size:
            n = int(back[0]) + 1
            raise HitchError(
                f"time does not increase from sample {n} ({self.time[n - 1]:.9g} s) to {n + 1} ({self.time[n]:.9g} s)"
            )
        for name, channel in self.channels().items():
            if np.ptp(channel) == 0.0:
                raise HitchError(f"{name} is {channel[0]:g} {UNITS[name]} all the time; nothing can be learned from it")
        if np.corrcoef(self.compression, self.F_hitch)[0, 1] < 0.0:
            raise HitchError("F_hitch falls as compression rises; both must be positive when the drawbar is pushed in")

    def channels(self) -> dict[str, Floats]:
        """Name to samples (n,) of what was measured."""
        given = {field.name: getattr(self, field.name) for field in fields(self)}
        return {name: channel for name, channel in given.items() if channel is not None}
