"""A sweep on Dask: a cluster on this machine, or one that is running elsewhere, with the same call.

The client alone reads and writes the store; workers get rows and give arrays, so they need no common file system. So
few batches are under way at once that memory does not grow with the sweep.
"""

from __future__ import annotations

import itertools
import logging
import signal
import tempfile
import uuid
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import CancelledError
from contextlib import contextmanager, suppress
from multiprocessing import resource_tracker
from pathlib import Path
from typing import Any

import dask
import xarray as xr
from dask.system import CPU_COUNT
from distributed import Client, Future, KilledWorker, LocalCluster, as_completed
from distributed.comm import CommClosedError
from distributed.utils import silence_logging_cmgr
from tornado.ioloop import PeriodicCallback

from overrun_hitch.parameters import HitchError
from overrun_hitch.sweeps.job import Batch, Done, Job
from overrun_hitch.sweeps.layout import FAILED, MISSING
from overrun_hitch.sweeps.plan import Plan
from overrun_hitch.sweeps.planner import planned
from overrun_hitch.sweeps.remote import connected, own_version, run_here
from overrun_hitch.sweeps.spec import SweepSpec, read_spec
from overrun_hitch.sweeps.store import SweepStore, opened_store, read_sweep
from overrun_hitch.sweeps.worker import Runners, run_batch

LOOPBACK = "127.0.0.1"
AHEAD = 2  # batches for each thread of a worker: one under way, one at hand
WORKERS_PATIENCE = 60.0  # s, for the first worker
SETTINGS = {
    "distributed.deploy.lost-worker-timeout": "5s",  # after which a worker that is gone is replaced
    "distributed.worker.profile.enabled": False,  # looks into the worker every 10 ms
}
WORKER_DIED = "the worker process died in this run, and again when it was repeated"

Progress = Callable[[int, int, int], object]  # told runs done, failed ones among them, runs in all


def sweep(
    spec: SweepSpec | Mapping[str, Any] | Path,
    store: Path,
    *,
    fmus: Sequence[Path] = (),
    scheduler: str | None = None,
    workers: int | None = None,
    repair: bool = False,
    progress: Progress = lambda done, failed, runs: None,
) -> xr.Dataset:
    """Run what is missing of the sweep in the Zarr `store` and return the whole, see store.read_sweep.

    spec: a SweepSpec, its keywords or a TOML file. fmus: the files to run where the spec names none; ours, if it is
    empty too. scheduler: the address of a Dask scheduler ("tls://host:8786"), on whose workers this package is
    installed (certificates are those of Dask's configuration); else `workers` processes (one for each core) on this
    machine, which listen on the loopback alone. repair: run again what is damaged in the store, which else is an error.
    A script that calls this needs the `if __name__ == "__main__"` that Python asks for where processes are made.
    HitchError for whatever is wrong with the spec or the store, before the first run; a run that fails is recorded.
    """
    if isinstance(spec, Path):
        spec = read_spec(spec)
    elif isinstance(spec, Mapping):
        spec = SweepSpec(**spec)
    plan = planned(spec, _fmus(spec, fmus))
    return run_plan(plan, store, scheduler=scheduler, workers=workers, repair=repair, progress=progress)


def run_plan(
    plan: Plan,
    store: Path,
    *,
    scheduler: str | None = None,
    workers: int | None = None,
    repair: bool = False,
    progress: Progress,
) -> xr.Dataset:
    """As `sweep`, of a plan."""
    if workers is not None and not 1 <= workers <= 1000:
        raise HitchError(f"workers = {workers} is not allowed; allowed: 1 to 1000 processes")
    with opened_store(store, plan, repair=repair) as opened:
        tally = _Tally(opened, plan.runs, progress)
        if opened.missing():
            with _client(scheduler, min(workers or CPU_COUNT, opened.batches)) as client:
                try:
                    with _Crew(client, plan.job) as crew:
                        _run_missing(crew, opened, tally)
                except (CancelledError, CommClosedError, OSError, TimeoutError):
                    raise HitchError(
                        f"the scheduler is gone; {tally.done} of {plan.runs} runs are in {store}, and the same command "
                        "goes on from there"
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
def _client(scheduler: str | None, workers: int) -> Iterator[Client]:
    """Connected to `scheduler`, or to a cluster of our own that ends with the block."""
    with silence_logging_cmgr(logging.CRITICAL):  # what the user is to know, we say
        if scheduler is None:
            with _local_cluster(workers) as cluster, Client(cluster, set_as_default=False) as client:
                yield client
        else:
            with connected(scheduler) as client:
                yield client


@contextmanager
def _local_cluster(workers: int) -> Iterator[LocalCluster]:
    resource_tracker.ensure_running()  # where a process is made first, this would undo what _prepare does
    with (
        tempfile.TemporaryDirectory(prefix="hitch-sweep-", ignore_cleanup_errors=True) as folder,
        dask.config.set({"temporary-directory": folder, **SETTINGS}),
        LocalCluster(
            n_workers=0,
            threads_per_worker=1,
            host=LOOPBACK,
            dashboard_address=f"{LOOPBACK}:0",
            worker_dashboard_address=f"{LOOPBACK}:0",
            silence_logs=logging.CRITICAL,  # of the workers as well
        ) as cluster,
    ):
        cluster.sync(_prepare, cluster, workers)
        yield cluster


async def _prepare(cluster: LocalCluster, workers: int) -> None:
    """In the thread that makes worker processes."""
    # They inherit this, so Ctrl-C does not reach them: this process ends them.
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    cluster.scale(workers)
    # A worker that dies while it starts is given up by Dask, and missed here.
    keeper = PeriodicCallback(lambda: cluster.scale(workers), 1000.0)
    cluster.periodic_callbacks["keep the number of workers"] = keeper
    keeper.start()


def _run_missing(crew: _Crew, store: SweepStore, tally: _Tally) -> None:
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
            tally.write(number, _result(future))
        except KilledWorker:
            deadly.append(number)
        top_up()
    # One run at a time, with nothing else under way: so the one that dies is the one to blame.
    for number in deadly:
        tally.write(number, crew.one_by_one(store.batch(number)))


def _result(future: Future) -> Done:
    """What came of a batch. KilledWorker; HitchError for what else went wrong where it ran; errors of the network."""
    try:
        done: Done = future.result()
    except (HitchError, KilledWorker):
        raise
    except Exception as error:
        if future.status != "error":
            raise
        raise HitchError(f"a worker can't run its batch: {type(error).__name__}: {error}") from None
    return done


class _Crew:
    """The workers, equipped for one job."""

    def __init__(self, client: Client, job: Job) -> None:
        self._client, self._job = client, job
        self._name = f"hitch-sweep-{uuid.uuid4().hex}"

    def __enter__(self) -> _Crew:
        self._client.wait_for_workers(1, timeout=WORKERS_PATIENCE)
        self._client.register_plugin(Runners(self._job), name=self._name)
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

    def one_by_one(self, batch: Batch) -> Done:
        """The batch, with a message for each run in which a worker dies."""
        return Done.joined([self._one(batch.part(slice(run, run + 1))) for run in range(len(batch))])

    def _one(self, run: Batch) -> Done:
        try:
            return _result(self.submit(run))
        except KilledWorker:
            return Done.failed(self._job, WORKER_DIED)
