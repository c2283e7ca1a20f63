"""A store without results, as Zarr files: its arrays, coordinates, units and attributes."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import dask.array as da
import numpy as np
import xarray as xr

from overrun_hitch.decimals import decimals
from overrun_hitch.measure.metrics import METRICS
from overrun_hitch.results import VARIABLES
from overrun_hitch.sweeps.plan import STEP_BRAKE, Plan

LAYOUT = 1  # to be raised with whatever changes below: a store goes on with the layout that it has
MISSING, FINISHED, FAILED = range(3)  # status of a run
LONGEST_MESSAGE = 300  # characters
POINTS_A_BATCH = 50_500  # 4 MB of trajectories; 0.2 s of work with one cheap metric, 0.9 s with all
RUNS_A_BATCH = 500
WRITTEN = ["status", "message"]  # from the beginning
LEAST_BATCHES = 16  # so that several workers have something to do


def write_empty(plan: Plan, folder: Path) -> None:
    """Write the store of `plan` in `folder`, which is not there yet. OSError."""
    size = max(1, min(RUNS_A_BATCH, POINTS_A_BATCH // len(plan.job.points), math.ceil(plan.runs / LEAST_BATCHES)))
    empty = _empty(plan, size)
    _write(empty.drop_vars(WRITTEN), folder, mode="w-", compute=False)
    # What is not written reads as NaN. Where that is no value, zarr gives anything at all: so it is written.
    _write(empty[WRITTEN].reset_coords(drop=True), folder, mode="a", write_empty_chunks=True)


def batch_files(plan: Plan, number: int) -> list[str]:
    """The chunks of a batch, as paths in the store; one that is full of NaN is no file."""
    flat = [f"{name}/{number}" for name in (*plan.job.metrics, *WRITTEN)]
    return [*flat, *(f"{name}/{number}.0" for name in plan.job.trajectories)]


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
    attributes = {"title": plan.name, "layout": LAYOUT, "sweep": json.dumps(plan.identity), **job.fixed}
    return xr.Dataset(data, coordinates, attributes)


def _write(part: xr.Dataset, folder: Path, **options: Any) -> None:
    fills = {str(name): np.nan if array.dtype.kind == "f" else None for name, array in part.data_vars.items()}
    encoding = {name: {"_FillValue": fill} for name, fill in fills.items()}
    # Format 2, which every version of zarr that we may meet reads and writes.
    part.to_zarr(str(folder), consolidated=False, zarr_format=2, encoding=encoding, **options)


def _attributes(unit: str, description: str) -> dict[str, str]:
    return {"units": unit, "long_name": description}
