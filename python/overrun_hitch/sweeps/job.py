"""What goes between the planner of a sweep and the workers: the job once, then batches, and what came of them.

Nothing heavy is imported here, because every worker does.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from overrun_hitch.fmu.profiles import Profile

Floats = NDArray[np.float64]
Progress = Callable[[int, int, int], object]  # told runs done, failed ones among them, runs in all


@dataclass(frozen=True)
class FmuFile:
    """An FMU as it is sent to where it runs."""

    name: str
    content: bytes


@dataclass(frozen=True)
class Job:
    """All that runs have in common."""

    fmus: tuple[FmuFile, ...]
    profiles: tuple[Profile, ...]
    fixed: Mapping[str, float]  # parameters and inputs, SI units
    varied: tuple[str, ...]
    points: Floats  # (points,) in s
    relative_tolerance: float
    metrics: tuple[str, ...]
    trajectories: tuple[str, ...]


@dataclass(frozen=True)
class Batch:
    """Some runs of a job: arrays (runs,), values (runs, varied) in SI units."""

    fmu: NDArray[np.int64]
    profile: NDArray[np.int64]
    values: Floats

    def __len__(self) -> int:
        return len(self.fmu)

    def part(self, chosen: slice) -> Batch:
        """The runs of a slice."""
        return Batch(self.fmu[chosen], self.profile[chosen], self.values[chosen])


@dataclass(frozen=True)
class Done:
    """What came of a batch."""

    messages: tuple[str, ...]  # (runs,): "" or why the run failed
    metrics: Mapping[str, Floats]  # (runs,), SI units; NaN for a run that failed
    trajectories: Mapping[str, Floats]  # (runs, points)

    @staticmethod
    def joined(parts: Sequence[Done]) -> Done:
        """The parts of a batch as one."""
        return Done(
            messages=tuple(message for part in parts for message in part.messages),
            metrics={name: np.concatenate([part.metrics[name] for part in parts]) for name in parts[0].metrics},
            trajectories={
                name: np.concatenate([part.trajectories[name] for part in parts]) for name in parts[0].trajectories
            },
        )

    @staticmethod
    def failed(job: Job, message: str) -> Done:
        """A batch of one run, which failed."""
        return Done(
            messages=(message,),
            metrics={name: np.full(1, np.nan) for name in job.metrics},
            trajectories={name: np.full((1, len(job.points)), np.nan) for name in job.trajectories},
        )
