"""The results of a sweep on disk: a Zarr store that is filled batch by batch and may be left at any moment.

A batch is a chunk of every array. The list of its checksums is written last, so a batch counts only when all of it is
there and stays what it was; what was interrupted is run again and overwritten.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import locket
import numpy as np
import xarray as xr
import zarr
from numpy.typing import NDArray

from overrun_hitch.measure.metrics import METRICS
from overrun_hitch.parameters import HitchError
from overrun_hitch.results import VARIABLES
from overrun_hitch.sweeps import checksums, frame
from overrun_hitch.sweeps.job import Batch, Done
from overrun_hitch.sweeps.layout import FAILED, FINISHED, LONGEST_MESSAGE, MISSING, batch_files
from overrun_hitch.sweeps.plan import Plan


class SweepStore:
    """A store that is open for the batches of one plan, and whose frame is whole."""

    def __init__(self, folder: Path, plan: Plan, *, repair: bool) -> None:
        """HitchError if batches are damaged; `repair`: these count as missing. OSError."""
        self._folder, self._plan = folder, plan
        self._group = zarr.open_group(str(folder), mode="r+")
        self._arrays = {str(name): self._group[name] for name in self._group.array_keys()}
        self._size = int(self._arrays["status"].chunks[0])
        lost = checksums.damaged(folder, map(str, range(self.batches)))
        files = [file for damaged in lost.values() for file in damaged]
        if files and not repair:
            raise frame.damage(folder, files)
        for number, damaged in lost.items():
            if damaged:
                (folder / checksums.FOLDER / number).unlink()
        self._status: NDArray[np.int8] = self._status_of_whole()

    @property
    def batches(self) -> int:
        """How many."""
        return math.ceil(self._plan.runs / self._size)

    def status(self) -> NDArray[np.int8]:
        """(runs,): FINISHED or FAILED; MISSING for all runs of a batch that is not whole."""
        return self._status

    def missing(self) -> list[int]:
        """The numbers of the batches that are not there yet."""
        return [number for number in range(self.batches) if (self._status[self._place(number)] == MISSING).any()]

    def batch(self, number: int) -> Batch:
        """What is to be run."""
        plan, place = self._plan, self._place(number)
        columns = [plan.columns[name][place] for name in plan.job.varied]
        length = len(plan.fmu[place])
        values = np.array(columns, dtype=np.float64).reshape(len(columns), length).T
        return Batch(plan.fmu[place], plan.profile[place], values)

    def write(self, number: int, done: Done) -> None:
        """Put what came of a batch in its place, and on disk. HitchError if that is not possible."""
        place = self._place(number)
        status = np.array([FAILED if text else FINISHED for text in done.messages], np.int8)
        messages = np.array([text[:LONGEST_MESSAGE] for text in done.messages], dtype="U")
        files = batch_files(self._plan, number)
        try:
            for file in files:  # zarr may read what it is to overwrite, and what is there may be torn
                (self._folder / file).unlink(missing_ok=True)
            for name, values in {**done.metrics, **done.trajectories, "message": messages, "status": status}.items():
                self._arrays[name][place] = values
            checksums.seal(self._folder, str(number), [file for file in files if (self._folder / file).exists()])
        except OSError as error:
            count = int((self._status != MISSING).sum())
            raise HitchError(
                f"cannot write {self._folder}: {error.strerror or error}; {count} of {self._plan.runs} runs are in it, "
                "and the same command goes on from there"
            ) from None
        self._status[place] = status

    def _status_of_whole(self) -> NDArray[np.int8]:
        status = np.full(self._plan.runs, MISSING, dtype=np.int8)
        for number in range(self.batches):
            if (self._folder / checksums.FOLDER / str(number)).exists():
                status[self._place(number)] = self._arrays["status"][self._place(number)]
        return status

    def _place(self, number: int) -> slice:
        return slice(number * self._size, min((number + 1) * self._size, self._plan.runs))


@contextmanager
def opened_store(folder: Path, plan: Plan, *, repair: bool = False) -> Iterator[SweepStore]:
    """The store in `folder`, made if there is none, for this process alone; `repair`: what is damaged is missing.

    HitchError if the folder holds anything else or another sweep, is damaged, can't be read or written, or another
    process is at it.
    """
    with _locked(folder):
        with _told(folder):
            if not folder.exists():
                frame.create(folder, plan)
            frame.check(folder, plan, repair=repair)
            store = SweepStore(folder, plan, repair=repair)
        yield store


def read_sweep(folder: Path) -> xr.Dataset:
    """The sweep in `folder`, read as it is needed.

    Dimension `run`: the quantities that were varied, `fmu` and `profile` as coordinates; the metrics, `status`
    (MISSING, FINISHED, FAILED) and `message`; whole trajectories also over `time`. All with units and long_name.
    """
    stored: xr.Dataset = xr.open_zarr(str(folder), consolidated=False)
    whole: xr.Dataset = stored[[name for name in (*METRICS, *VARIABLES, "status", "message") if name in stored]]
    return whole


@contextmanager
def _locked(folder: Path) -> Iterator[None]:
    lock = folder.with_name(f".{folder.name}.lock")
    with _told(folder):
        folder.parent.mkdir(parents=True, exist_ok=True)
        held = locket.lock_file(str(lock), timeout=0)
        try:
            held.acquire()
        except locket.LockError:
            raise HitchError(f"{folder} is being written by another sweep; allowed: one at a time") from None
    try:
        yield
    finally:
        lock.unlink(missing_ok=True)
        held.release()


@contextmanager
def _told(folder: Path) -> Iterator[None]:
    """What the system refuses, as a HitchError."""
    try:
        yield
    except OSError as error:
        raise HitchError(f"cannot read or write {folder}: {error.strerror or error}") from None
