"""A sweep: on this machine's cores, or on a Dask cluster that is running elsewhere, with the same call.

The client alone reads and writes the store; workers get rows and give arrays, so they need no common file system. So
few batches are under way at once that memory does not grow with the sweep.
"""

from __future__ import annotations

import itertools
import logging
import uuid
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import CancelledError
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import xarray as xr
from dask.system import CPU_COUNT
from distributed import Client, Future, KilledWorker, as_completed
from distributed.comm import CommClosedError
from distributed.utils import silence_logging_cmgr

from overrun_hitch.fmu.settings import TIME_LIMIT, checked_time_limit
from overrun_hitch.parameters import HitchError
from overrun_hitch.sweeps.job import Batch, Done, Job, Progress
from overrun_hitch.sweeps.layout import FAILED, MISSING
from overrun_hitch.sweeps.local_crew import LocalCrew
from overrun_hitch.sweeps.plan import Plan
from overrun_hitch.sweeps.planner import planned
from overrun_hitch.sweeps.remote import connected, own_version, run_here
from overrun_hitch.sweeps.spec import SweepSpec, read_spec
from overrun_hitch.sweeps.store import SweepStore, opened_store, read_sweep
from overrun_hitch.sweeps.worker import Runners, run_batch

AHEAD = 2  # batches for each thread of a worker: one under way, one at hand
WORKERS_PATIENCE = 60.0  # s, for the first worker
WORKER_DIED = "the worker process died in this run, and again when it was repeated"


def sweep(
    spec: SweepSpec | Mapping[str, Any] | Path,
    store: Path,
    *,
    fmus: Sequence[Path] = (),
    scheduler: str | None = None,
    workers: int | None = None,
    repair: bool = False,
    time_limit: float = TIME_LIMIT,
    progress: Progress = lambda done, failed, runs: None,
) -> xr.Dataset:
    """Run what is missing of the sweep in the Zarr `store` and return the whole, see store.read_sweep.

    spec: a SweepSpec, its keywords or a TOML file. fmus: the files to run where the spec names none; ours, if it is
    empty too. scheduler: the address of a Dask scheduler ("tls://host:8786"), on whose workers this package is
    installed (certificates are those of Dask's configuration); else `workers` processes (one for each core) on this
    machine. repair: run again what is damaged in the store, which else is an error. time_limit: of a run, in s.
    HitchError for whatever is wrong with the spec or the store, before the first run; a run that fails is recorded.
    """
    if isinstance(spec, Path):
        spec = read_spec(spec)
    elif isinstance(spec, Mapping):
        spec = SweepSpec(**spec)
    return run_plan(
        planned(spec, _fmus(spec, fmus)),
        store,
        scheduler=scheduler,
        workers=workers,
        repair=repair,
        time_limit=time_limit,
        progress=progress,
    )


def run_plan(
    plan: Plan,
    store: Path,
    *,
    scheduler: str | None = None,
    workers: int | None = None,
    repair: bool = False,
    time_limit: float = TIME_LIMIT,
    progress: Progress,
) -> xr.Dataset:
    """As `sweep`, of a plan."""
    if workers is not None and not 1 <= workers <= 1000:
        raise HitchError(f"workers = {workers} is not allowed; allowed: 1 to 1000 processes")
    limit = checked_time_limit(time_limit)
    with opened_store(store, plan, repair=repair) as opened:
        tally = _Tally(opened, plan.runs, progress)
        if opened.missing():
            if scheduler is None:
                with LocalCrew(plan.job, limit, min(workers or CPU_COUNT, opened.batches)) as crew:
                    _run_missing(crew, opened, tally)
            else:
                with _client(scheduler) as client:
                    try:
                        with _Crew(client, plan.job, limit) as crew:
                            # One run at a time, with nothing else under way: so the one that dies is the one to blame.
                            for number in _run_missing(crew, opened, tally):
                                tally.write(number, crew.one_by_one(opened.batch(number)))
                    except (CancelledError, CommClosedError, OSError, TimeoutError):
                        raise HitchError(
                            f"the scheduler is gone; {tally.done} of {plan.runs} runs are in {store}, and the same "
                            "command goes on from there"
                        ) from None
    return read_sweep(store)


def _fmus(spec: SweepSpec, fmus: Sequence[Path]) -> list[Path]:
    from overrun_hitch.fmu.files import CAR_TRAILER, build, is_current

    if spec.fmus or fmus:
        return [Path(fmu) for fmu in spec.fmus or fmus]
    if not is_current(CAR_TRAILER):
        build(CAR_TRAILER)
    return [CAR_TRAILER]


class _Tally:
    """How far the sweep is."""

    def __init__(self, store: SweepStore, runs: int, progress: Progress) -> None:
        status = store.status()
        self.done, self._failed = int((status != MISSING).sum()), int((status == FAILED).sum())
        self._runs, self._progress, self._store = runs, progress, store
        progress(self.done, self._failed, runs)

    def write(self, number: int, done: Done) -> None:
        """Store a batch and tell."""
        self._store.write(number, done)
        self.done += len(done.messages)
        self._failed += sum(bool(message) for message in done.messages)
        self._progress(self.done, self._failed, self._runs)


@contextmanager
def _client(scheduler: str) -> Iterator[Client]:
    with silence_logging_cmgr(logging.CRITICAL), connected(scheduler) as client:  # what the user is to know, we say
        yield client


def _run_missing(crew: LocalCrew | _Crew, store: SweepStore, tally: _Tally) -> list[int]:
    """Returns the numbers of the batches in which workers died."""
    waiting = iter(store.missing())
    under_way = crew.completions()
    numbers: dict[Any, int] = {}
    deadly = []

    def top_up() -> None:
        for number in itertools.islice(waiting, max(0, AHEAD * crew.threads() - len(numbers))):
            future = crew.submit(store.batch(number))
            numbers[future] = number
            under_way.add(future)

    top_up()
    for future in under_way:
        number = numbers.pop(future)
        try:
            tally.write(number, crew.result(future))
        except KilledWorker:
            deadly.append(number)
        top_up()
    return deadly


class _Crew:
    """The workers, equipped for one job."""

    def __init__(self, client: Client, job: Job, time_limit: float) -> None:
        self._client, self._job, self._time_limit = client, job, time_limit
        self._name = f"hitch-sweep-{uuid.uuid4().hex}"

    def __enter__(self) -> _Crew:
        self._client.wait_for_workers(1, timeout=WORKERS_PATIENCE)
        self._client.register_plugin(Runners(self._job, self._time_limit), name=self._name)
        return self

    def __exit__(self, *_: object) -> None:
        with suppress(CommClosedError, OSError, TimeoutError):
            self._client.unregister_worker_plugin(self._name)

    def threads(self) -> int:
        """How many batches can run at once, now; at least 1, for a worker that has died is replaced."""
        return max(1, int(sum(self._client.nthreads().values())))

    def completions(self) -> as_completed:
        """An iterator over futures as they are done, that takes more while it runs."""
        return as_completed(loop=self._client.loop)

    def submit(self, batch: Batch) -> Future:
        return self._client.submit(run_here, own_version(), run_batch, self._name, batch, pure=False)

    def result(self, future: Future) -> Done:
        """What came of a batch. KilledWorker; HitchError for what else went wrong there; errors of the network."""
        try:
            done: Done = future.result()
        except (HitchError, KilledWorker):
            raise
        except Exception as error:
            if future.status != "error":
                raise
            raise HitchError(f"a worker can't run its batch: {type(error).__name__}: {error}") from None
        return done

    def one_by_one(self, batch: Batch) -> Done:
        """The batch, with a message for each run in which a worker dies."""
        return Done.joined([self._one(batch.part(slice(run, run + 1))) for run in range(len(batch))])

    def _one(self, run: Batch) -> Done:
        try:
            return self.result(self.submit(run))
        except KilledWorker:
            return Done.failed(self._job, WORKER_DIED)
