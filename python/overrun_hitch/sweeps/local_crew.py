"""This machine's cores: threads that each wait for a guest. Nothing listens, so nobody else can come in."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from queue import SimpleQueue
from threading import local

from overrun_hitch.sweeps.guests import Guests
from overrun_hitch.sweeps.job import Batch, Done, Job


class LocalCrew:
    """So many workers, equipped for one job."""

    def __init__(self, job: Job, time_limit: float, workers: int) -> None:
        self._workers = workers
        self._own = local()
        self._guests: list[Guests] = []
        self._threads = ThreadPoolExecutor(workers, "sweep", self._equip, (job, time_limit))

    def __enter__(self) -> LocalCrew:
        return self

    def __exit__(self, *_: object) -> None:
        for guests in self._guests:  # so that threads need not wait for them
            guests.close()
        self._threads.shutdown(cancel_futures=True)

    def threads(self) -> int:
        """How many batches can run at once."""
        return self._workers

    def completions(self) -> Completions:
        """An iterator over futures as they are done, that takes more while it runs."""
        return Completions()

    def submit(self, batch: Batch) -> Future[Done]:
        """Run it in the next thread that is free."""
        return self._threads.submit(lambda: self._own.guests.run(batch))

    def result(self, future: Future[Done]) -> Done:
        """What came of a batch."""
        return future.result()

    def _equip(self, job: Job, time_limit: float) -> None:
        """In each thread, where it starts."""
        self._own.guests = Guests(job, time_limit)
        self._guests.append(self._own.guests)


class Completions:
    """As Dask's as_completed."""

    def __init__(self) -> None:
        self._done: SimpleQueue[Future[Done]] = SimpleQueue()
        self._under_way = 0

    def __iter__(self) -> Iterator[Future[Done]]:
        while self._under_way:
            self._under_way -= 1
            yield self._done.get()

    def add(self, future: Future[Done]) -> None:
        """One more to wait for."""
        self._under_way += 1
        future.add_done_callback(self._done.put)
