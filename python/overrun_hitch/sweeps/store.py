"""The results of a sweep on disk: a Zarr store that is filled batch by batch and may be left at any moment.

A batch is a chunk of every array. Its `status` is written last, so a batch counts only when all of it is there; what
was interrupted is run again and overwritten. Zarr puts each chunk in place whole, by renaming a file.
"""

from __future__ import annotations

import json
import math
import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import dask.array as da
import locket
import numpy as np
import xarray as xr
import zarr
from numpy.typing import NDArray

from overrun_hitch.decimals import decimals
from overrun_hitch.measure.metrics import METRICS
from overrun_hitch.parameters import HitchError
from overrun_hitch.results import VARIABLES
from overrun_hitch.sweeps.job import Batch, Done
from overrun_hitch.sweeps.plan import STEP_BRAKE, Plan, differing

MISSING, FINISHED, FAILED = range(3)  # status of a run
LONGEST_MESSAGE = 300  # characters
POINTS_A_BATCH = 50_500  # 4 MB of trajectories; 0.2 s of work with one cheap metric, 0.9 s with all
RUNS_A_BATCH = 500
WRITTEN = ["status", "message"]  # from the beginning
LEAST_BATCHES = 16  # so that several workers have something to do


class SweepStore:
    """A store that is open for the batches of one plan."""

    def __init__(self, folder: Path, plan: Plan) -> None:
        self._plan = plan
        self._group = zarr.open_group(str(folder), mode="r+")
        self._arrays = {str(name): self._group[name] for name in self._group}
        self._size = int(self._arrays["status"].chunks[0])

    @property
    def batches(self) -> int:
        """How many."""
        return math.ceil(self._plan.runs / self._size)

    def status(self) -> NDArray[np.int8]:
        """(runs,): MISSING, FINISHED or FAILED."""
        return np.asarray(self._arrays["status"][:], dtype=np.int8)

    def missing(self) -> list[int]:
        """The numbers of the batches that are not there yet."""
        status = self.status()
        return [number for number in range(self.batches) if (status[self._place(number)] == MISSING).any()]

    def batch(self, number: int) -> Batch:
        """What is to be run."""
        plan, place = self._plan, self._place(number)
        columns = [plan.columns[name][place] for name in plan.job.varied]
        length = len(plan.fmu[place])
        values = np.array(columns, dtype=np.float64).reshape(len(columns), length).T
        return Batch(plan.fmu[place], plan.profile[place], values)

    def write(self, number: int, done: Done) -> None:
        """Put what came of a batch in its place."""
        place = self._place(number)
        for name, values in {**done.metrics, **done.trajectories}.items():
            self._arrays[name][place] = values
        self._arrays["message"][place] = np.array([text[:LONGEST_MESSAGE] for text in done.messages], dtype="U")
        self._arrays["status"][place] = np.array([FAILED if text else FINISHED for text in done.messages], np.int8)

    def _place(self, number: int) -> slice:
        return slice(number * self._size, min((number + 1) * self._size, self._plan.runs))


@contextmanager
def opened_store(folder: Path, plan: Plan) -> Iterator[SweepStore]:
    """The store in `folder`, made if there is none, for this process alone.

    HitchError if the folder holds anything else or another sweep, can't be written, or another process is at it.
    """
    lock = folder.with_name(f".{folder.name}.lock")
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        with locket.lock_file(str(lock), timeout=0):
            if not folder.exists():
                _create(folder, plan)
            _check(folder, plan)
            try:
                yield SweepStore(folder, plan)
            finally:
                lock.unlink()
    except locket.LockError:
        raise HitchError(f"{folder} is being written by another sweep; allowed: one at a time") from None
    except OSError as error:
        raise HitchError(f"cannot write {folder}: {error.strerror or error}") from None


def read_sweep(folder: Path) -> xr.Dataset:
    """The sweep in `folder`, read as it is needed.

    Dimension `run`: the quantities that were varied, `fmu` and `profile` as coordinates; the metrics, `status`
    (MISSING, FINISHED, FAILED) and `message`; whole trajectories also over `time`. All with units and long_name.
    """
    stored: xr.Dataset = xr.open_zarr(str(folder), consolidated=False)
    whole: xr.Dataset = stored[[name for name in (*METRICS, *VARIABLES, "status", "message") if name in stored]]
    return whole


def _check(folder: Path, plan: Plan) -> None:
    try:
        attributes = dict(zarr.open_group(str(folder), mode="r").attrs)
        identity = json.loads(str(attributes["sweep"]))
    except (KeyError, ValueError, FileNotFoundError, NotADirectoryError):
        raise HitchError(f"{folder} is there and holds no sweep; allowed: a new place, or the same sweep's") from None
    names = differing(plan.identity, identity)
    if names:
        raise HitchError(
            f"{folder} holds another sweep, which differs in {', '.join(names)}; allowed: a new place, or the same spec"
        )


def _create(folder: Path, plan: Plan) -> None:
    """An empty store, at its place only when it is whole."""
    temporary = Path(tempfile.mkdtemp(dir=folder.parent, prefix=f".{folder.name}-"))
    try:
        size = max(1, min(RUNS_A_BATCH, POINTS_A_BATCH // len(plan.job.points), math.ceil(plan.runs / LEAST_BATCHES)))
        empty = _empty(plan, size)
        fresh = temporary / "new"
        _write(empty.drop_vars(WRITTEN), fresh, mode="w-", compute=False)
        # What is not written reads as NaN. Where that is no value, zarr gives anything at all: so it is written.
        _write(empty[WRITTEN].reset_coords(drop=True), fresh, mode="a", write_empty_chunks=True)
        os.replace(fresh, folder)
    finally:
        shutil.rmtree(temporary)


def _empty(plan: Plan, size: int) -> xr.Dataset:
    """The dataset without results; results are in chunks of `size` runs."""
    job, runs = plan.job, plan.runs
    data: dict[str, Any] = {
        name: ("run", da.full(runs, np.nan, chunks=size), _attributes(METRICS[name].unit, METRICS[name].description))
        for name in job.metrics
    }
    shape = (runs, len(job.points))
    for name in job.trajectories:
        whole = da.full(shape, np.nan, chunks=(size, shape[1]))
        data[name] = (("run", "time"), whole, _attributes(*VARIABLES[name]))
    meanings = {"flag_values": [MISSING, FINISHED, FAILED], "flag_meanings": "missing finished failed"}
    data["status"] = (
        "run",
        da.zeros(runs, chunks=size, dtype=np.int8),
        {"long_name": "what came of the run", **meanings},
    )
    text = da.full(runs, "", chunks=size, dtype=f"U{LONGEST_MESSAGE}")
    data["message"] = ("run", text, {"long_name": "why the run failed"})
    fmus = np.array([fmu.name for fmu in job.fmus])
    profiles = np.array([profile.name for profile in job.profiles])
    coordinates: dict[str, Any] = {
        name: ("run", column, _attributes(plan.quantities[name].unit, plan.quantities[name].description))
        for name, column in plan.columns.items()
    }
    coordinates["fmu"] = ("run", fmus[plan.fmu], {"long_name": "FMU that was run"})
    coordinates["profile"] = ("run", profiles[plan.profile], {"long_name": f"inputs over time, or {STEP_BRAKE}"})
    if job.trajectories:
        coordinates["time"] = ("time", np.array(decimals(job.points)), _attributes("s", "time"))
    attributes = {"title": plan.name, "sweep": json.dumps(plan.identity), **job.fixed}
    return xr.Dataset(data, coordinates, attributes)


def _write(part: xr.Dataset, folder: Path, **options: Any) -> None:
    fills = {str(name): np.nan if array.dtype.kind == "f" else None for name, array in part.data_vars.items()}
    encoding = {name: {"_FillValue": fill} for name, fill in fills.items()}
    # Format 2, which every version of zarr that we may meet reads and writes.
    part.to_zarr(str(folder), consolidated=False, zarr_format=2, encoding=encoding, **options)


def _attributes(unit: str, description: str) -> dict[str, str]:
    return {"units": unit, "long_name": description}
