"""The worker's side of a sweep on Dask."""

from __future__ import annotations

import threading
from typing import Any

from distributed import WorkerPlugin, get_worker

from overrun_hitch.sweeps.guests import Guests
from overrun_hitch.sweeps.job import Batch, Done, Job


def run_batch(name: str, batch: Batch) -> Done:
    """The task: run `batch` on the worker that this is called on, which has Runners under `name`."""
    runners: Runners = get_worker().plugins[name]
    return runners.of_this_thread().run(batch)


class Runners(WorkerPlugin):  # type: ignore[misc]  # Dask has no types here
    """What a worker keeps from batch to batch: Guests for each of its threads."""

    def __init__(self, job: Job, time_limit: float) -> None:
        self._job = job
        self._time_limit = time_limit

    def setup(self, worker: Any) -> None:
        """Called by Dask where the worker starts."""
        self._guests: dict[int, Guests] = {}

    def teardown(self, worker: Any) -> None:
        """Called by Dask where the worker ends, or the job."""
        for guests in list(self._guests.values()):
            guests.close()

    def of_this_thread(self) -> Guests:
        """The calling thread's own."""
        return self._guests.setdefault(threading.get_ident(), Guests(self._job, self._time_limit))
