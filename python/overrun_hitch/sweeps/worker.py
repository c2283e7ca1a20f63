"""Runs where a worker is: a batch of rows in, arrays out. An FMU is unpacked once, its instance reset for each run."""

from __future__ import annotations

import tempfile
import threading
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from distributed import WorkerPlugin, get_worker
from numpy.typing import NDArray

from overrun_hitch.fmu.messages import StartRefused, StepRefused
from overrun_hitch.fmu.opening import opened_unit
from overrun_hitch.fmu.profiles import Profile
from overrun_hitch.fmu.sampler import Sampler
from overrun_hitch.fmu.unit import HitchUnit
from overrun_hitch.measure.metrics import NEEDED, Traces, measured
from overrun_hitch.results import VARIABLES
from overrun_hitch.sweeps.job import Batch, Done, Job

Floats = NDArray[np.float64]

NOT_FINITE = "the outputs are not finite"


@dataclass
class _Bench:
    """An FMU, open."""

    unit: HitchUnit
    sampler: Sampler


class Runner:
    """A job on this machine, for one thread. Whoever makes one must close it."""

    def __init__(self, job: Job, folder: Path | None = None) -> None:
        self._job = job
        self._folder = tempfile.TemporaryDirectory(prefix="hitch-", dir=folder)
        self._busy = threading.Lock()  # who closes may be another thread
        self._stacks: dict[int, ExitStack] = {}
        self._benches: dict[int, _Bench] = {}

    def close(self) -> None:
        """Free all instances and remove what was unpacked."""
        with self._busy:
            for place in list(self._benches):
                self._close(place)
            self._folder.cleanup()

    def run(self, batch: Batch) -> Done:
        """Run all of them; what a unit refuses is told in `messages`."""
        job = self._job
        traces = np.full((len(VARIABLES), len(batch), len(job.points)), np.nan)
        with self._busy:
            messages = [self._run_one(batch, run, traces) for run in range(len(batch))]
        good = np.array([not message for message in messages], dtype=np.bool_)
        named = dict(zip(VARIABLES, traces, strict=True))
        metrics = {name: np.full(len(batch), np.nan) for name in job.metrics}
        seen = Traces(job.points, {name: named[name][good] for name in NEEDED}, self._eps(batch)[good])
        for name, values in measured(job.metrics, seen).items() if good.any() else ():
            metrics[name][good] = values
        return Done(tuple(messages), metrics, {name: named[name] for name in job.trajectories})

    def _run_one(self, batch: Batch, run: int, traces: Floats) -> str:
        """Fill traces[:, run]; returns "" or why the run failed."""
        job, place = self._job, int(batch.fmu[run])
        profile = job.profiles[batch.profile[run]]
        values = {**job.fixed, **dict(zip(job.varied, batch.values[run].tolist(), strict=True))}
        if profile.changes:
            values |= profile.changes[0].values
        try:
            bench = self._started(place, values)
            table = bench.sampler.run(_before_step(bench.unit, profile))
        except (StartRefused, StepRefused) as error:
            return str(error)
        if not np.isfinite(table).all():
            return f"{bench.unit.name}: {NOT_FINITE} from t = {job.points[~np.isfinite(table).all(axis=1)][0]:g} s on"
        traces[:, run] = table.T
        return ""

    def _started(self, place: int, values: Mapping[str, float]) -> _Bench:
        """The FMU at t = 0 of a run. StartRefused if a new instance does not take the values either."""
        known = place in self._benches
        bench = self._bench(place)
        try:
            bench.unit.start_with(values, self._job.relative_tolerance)
        except StartRefused:
            self._close(place)
            if not known:
                raise
            # What the run before has left may be beyond a reset.
            bench = self._bench(place)
            bench.unit.start_with(values, self._job.relative_tolerance)
        return bench

    def _bench(self, place: int) -> _Bench:
        if place not in self._benches:
            fmu = self._job.fmus[place]
            file = Path(self._folder.name) / str(place) / fmu.name
            if not file.exists():
                file.parent.mkdir()
                file.write_bytes(fmu.content)
            stack = self._stacks[place] = ExitStack()
            unit = stack.enter_context(opened_unit(file, file.parent))
            self._benches[place] = _Bench(unit, unit.sampler(list(VARIABLES), self._job.points))
        return self._benches[place]

    def _close(self, place: int) -> None:
        self._benches.pop(place, None)
        stack = self._stacks.pop(place, None)
        if stack:
            stack.close()

    def _eps(self, batch: Batch) -> Floats:
        if "eps" in self._job.varied:
            return batch.values[:, self._job.varied.index("eps")]
        return np.full(len(batch), self._job.fixed["eps"])


def _before_step(unit: HitchUnit, profile: Profile) -> dict[int, Callable[[], None]]:
    return {change.step: partial(unit.change, change.values, change.slopes) for change in profile.changes}


def run_batch(name: str, batch: Batch) -> Done:
    """The task: run `batch` on the worker that this is called on, which has Runners under `name`."""
    runners: Runners = get_worker().plugins[name]
    return runners.of_this_thread().run(batch)


class Runners(WorkerPlugin):  # type: ignore[misc]  # Dask has no types here
    """What a worker keeps from batch to batch: a Runner for each of its threads."""

    def __init__(self, job: Job) -> None:
        self._job = job

    def setup(self, worker: Any) -> None:
        """Called by Dask where the worker starts."""
        self._folder = Path(worker.local_directory)
        self._lock = threading.Lock()
        self._runners: dict[int, Runner] = {}

    def teardown(self, worker: Any) -> None:
        """Called by Dask where the worker ends, or the job."""
        for runner in self._runners.values():
            runner.close()

    def of_this_thread(self) -> Runner:
        """The calling thread's own: an instance of an FMU is for one thread."""
        # The lock, because opening an FMU changes the working directory of the process for a moment.
        with self._lock:
            thread = threading.get_ident()
            if thread not in self._runners:
                self._runners[thread] = Runner(self._job, self._folder)
            return self._runners[thread]
