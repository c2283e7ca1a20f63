"""Runs where an FMU is: a batch of rows in, arrays out. The FMU is unpacked once, its instance reset for each run."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from overrun_hitch.fmu.guest import OURS, tell
from overrun_hitch.fmu.messages import StartRefused, StepRefused
from overrun_hitch.fmu.opening import opened_unit
from overrun_hitch.fmu.profiles import Profile
from overrun_hitch.fmu.sampler import Sampler
from overrun_hitch.fmu.unit import HitchUnit
from overrun_hitch.measure.metrics import NEEDED, Traces, measured
from overrun_hitch.results import VARIABLES
from overrun_hitch.sweeps.job import Batch, Done, FmuFile, Job

Floats = NDArray[np.float64]

NOT_FINITE = "the outputs are not finite"


class Runner:
    """A job on one of its FMUs, which is opened anew where it does not start any more. It tells which run it is at."""

    def __init__(self, job: Job, fmu: Path) -> None:
        self._job = job
        self._fmu = fmu
        self._read = read(job)
        self._stack = ExitStack()
        self._unit: HitchUnit | None = None

    def close(self) -> None:
        """Free the instance."""
        self._unit = None
        self._stack.close()

    def run(self, batch: Batch) -> Done:
        """Run all of them; what the unit refuses is told in `messages`."""
        job = self._job
        traces = np.full((len(self._read), len(batch), len(job.points)), np.nan)
        messages = [self._run_one(batch, run, traces) for run in range(len(batch))]
        tell(OURS)
        good = np.array([not message for message in messages], dtype=np.bool_)
        named = dict(zip(self._read, traces, strict=True))
        metrics = {name: np.full(len(batch), np.nan) for name in job.metrics}
        if job.metrics and good.any():
            seen = Traces(job.points, {name: named[name][good] for name in NEEDED}, self._eps(batch)[good])
            for name, values in measured(job.metrics, seen).items():
                metrics[name][good] = values
        return Done(tuple(messages), metrics, {name: named[name] for name in job.trajectories})

    def _run_one(self, batch: Batch, run: int, traces: Floats) -> str:
        """Fill traces[:, run]; returns "" or why the run failed."""
        tell(run)
        job = self._job
        profile = job.profiles[batch.profile[run]]
        values = {**job.fixed, **dict(zip(job.varied, batch.values[run].tolist(), strict=True))}
        if profile.changes:
            values |= profile.changes[0].values
        try:
            unit = self._started(values)
            table = self._sampler.run(_before_step(unit, profile))
        except (StartRefused, StepRefused) as error:
            return str(error)
        if not np.isfinite(table).all():
            return f"{unit.name}: {NOT_FINITE} from t = {job.points[~np.isfinite(table).all(axis=1)][0]:g} s on"
        traces[:, run] = table.T
        return ""

    def _started(self, values: Mapping[str, float]) -> HitchUnit:
        """The FMU at t = 0 of a run. StartRefused if a new instance does not take the values either."""
        was_open = self._unit is not None
        unit = self._opened()
        try:
            unit.start_with(values, self._job.relative_tolerance)
        except StartRefused:
            self.close()
            if not was_open:
                raise
            # What the run before has left may be beyond a reset.
            unit = self._opened()
            unit.start_with(values, self._job.relative_tolerance)
        return unit

    def _opened(self) -> HitchUnit:
        if self._unit is None:
            self._unit = self._stack.enter_context(opened_unit(self._fmu))
            self._sampler: Sampler = self._unit.sampler(self._read, self._job.points)
        return self._unit

    def _eps(self, batch: Batch) -> Floats:
        if "eps" in self._job.varied:
            return batch.values[:, self._job.varied.index("eps")]
        return np.full(len(batch), self._job.fixed["eps"])


def read(job: Job) -> list[str]:
    """The outputs that are read in each run: what is asked for, and what its metrics are made of."""
    return [name for name in VARIABLES if name in job.trajectories or (job.metrics and name in NEEDED)]


def _before_step(unit: HitchUnit, profile: Profile) -> dict[int, Callable[[], None]]:
    return {change.step: partial(unit.change, change.values, change.slopes) for change in profile.changes}


@contextmanager
def runner(job: Job, fmu: FmuFile) -> Iterator[Runner]:
    """A Runner for an FMU that comes from elsewhere."""
    with tempfile.TemporaryDirectory(prefix="hitch-") as folder:
        file = Path(folder, fmu.name)
        file.write_bytes(fmu.content)
        made = Runner(job, file)
        try:
            yield made
        finally:
            made.close()
