"""A plan: a sweep and every run of it as a row, ready to be run and stored."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from overrun_hitch.sweeps.job import Job
from overrun_hitch.sweeps.sampling import Columns

STEP_BRAKE = "step brake"  # the profile where there are none


@dataclass(frozen=True)
class Quantity:
    """A parameter or an input that runs may differ in."""

    unit: str
    description: str
    check: Callable[[float], object]  # HitchError, with the allowed range, for a value that is not allowed


@dataclass(frozen=True)
class Plan:
    """The sweep, and every run of it: arrays (runs,)."""

    job: Job
    name: str
    quantities: Mapping[str, Quantity]  # at least those varied
    columns: Columns  # by name as job.varied, SI units
    fmu: NDArray[np.int64]  # places in job.fmus
    profile: NDArray[np.int64]  # places in job.profiles

    @property
    def runs(self) -> int:
        """How many."""
        return len(self.fmu)

    @property
    def identity(self) -> dict[str, Any]:
        """What makes it this sweep and no other, ready for json.dumps."""
        job = self.job
        table = np.array([self.fmu, self.profile, *self.columns.values()], dtype=np.float64)
        return {
            "fmus": [hashlib.sha256(fmu.content).hexdigest() for fmu in job.fmus],
            "profiles": [[each.name, each.knots] for each in job.profiles],
            "parameters": dict(job.fixed),
            "varied": list(job.varied),
            "runs": hashlib.sha256(table.tobytes()).hexdigest(),
            "duration": float(job.points[-1]),
            "communication_step": float(job.points[1]),
            "relative_tolerance": job.relative_tolerance,
            "metrics": list(job.metrics),
            "trajectories": list(job.trajectories),
        }


def differing(identity: Mapping[str, Any], other: Mapping[str, Any]) -> list[str]:
    """The entries in which two identities differ."""
    plain = json.loads(json.dumps(identity))
    return [name for name in plain if plain[name] != other.get(name)]
