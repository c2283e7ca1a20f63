"""Many runs in memory: the whole grid at once, as an xarray Dataset over what was varied. A store is for more."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import closing
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from overrun_hitch.decimals import decimals
from overrun_hitch.measure.metrics import METRICS
from overrun_hitch.parameters import HitchError
from overrun_hitch.results import VARIABLES
from overrun_hitch.sweeps.job import Batch, Done, Progress
from overrun_hitch.sweeps.local_crew import LocalCrew
from overrun_hitch.sweeps.plan import Plan
from overrun_hitch.sweeps.runner import Runner

MOST_VALUES = 100_000_000  # in memory: 800 MB
RUNS_A_BATCH = 250
BATCHES_A_WORKER = 4  # so that they end at about the same time


def run_in_memory(plan: Plan, fmu: Path, time_limit: float, workers: int, progress: Progress) -> xr.Dataset:
    """All runs of the plan, whose one FMU is `fmu`, by `workers` processes; 0: here. `time_limit` in s, of a run there.

    Dimensions are the quantities varied, in their order, and time; a run that fails is NaN and has a `message`.
    HitchError for more values than fit into memory.
    """
    count = plan.runs * len(plan.job.points) * len(plan.job.trajectories)
    if count > MOST_VALUES:
        raise HitchError(f"{count} values are too many to hold; allowed: {MOST_VALUES}, and in a store any (sweep)")
    batches = _batches(plan, workers)
    done: dict[int, Done] = {}
    failed = 0
    progress(0, 0, plan.runs)
    for number, part in _here(plan, fmu, batches) if workers == 0 else _there(plan, batches, time_limit, workers):
        done[number] = part
        failed += sum(map(bool, part.messages))
        progress(sum(len(each.messages) for each in done.values()), failed, plan.runs)
    return _dataset(plan, Done.joined([done[number] for number in range(len(batches))]))


def _here(plan: Plan, fmu: Path, batches: Sequence[Batch]) -> Iterator[tuple[int, Done]]:
    with closing(Runner(plan.job, fmu)) as runner:
        for number, batch in enumerate(batches):
            yield number, runner.run(batch)


def _there(plan: Plan, batches: Sequence[Batch], time_limit: float, workers: int) -> Iterator[tuple[int, Done]]:
    with LocalCrew(plan.job, time_limit, min(workers, len(batches))) as crew:
        completions = crew.completions()
        numbers = {crew.submit(batch): number for number, batch in enumerate(batches)}
        for future in numbers:
            completions.add(future)
        for future in completions:
            yield numbers[future], crew.result(future)


def _batches(plan: Plan, workers: int) -> list[Batch]:
    values = np.array([plan.columns[name] for name in plan.job.varied]).reshape(-1, plan.runs).T
    whole = Batch(plan.fmu, plan.profile, values)
    size = min(RUNS_A_BATCH, math.ceil(plan.runs / (BATCHES_A_WORKER * max(1, workers))))
    return [whole.part(slice(first, first + size)) for first in range(0, plan.runs, size)]


def _dataset(plan: Plan, done: Done) -> xr.Dataset:
    job = plan.job
    axes = {name: np.unique(plan.columns[name], return_index=True) for name in job.varied}
    coordinates: dict[str, Any] = {
        name: (name, plan.columns[name][np.sort(first)], _attributes(plan.quantities[name]))
        for name, (_, first) in axes.items()
    }
    shape = tuple(len(first) for _, first in axes.values())
    data: dict[str, Any] = {
        name: (job.varied, values.reshape(shape), _attributes(METRICS[name])) for name, values in done.metrics.items()
    }
    for name, values in done.trajectories.items():
        unit, description = VARIABLES[name]
        whole = values.reshape(*shape, len(job.points))
        data[name] = ((*job.varied, "time"), whole, {"units": unit, "long_name": description})
    data["message"] = (
        job.varied,
        np.array(done.messages).reshape(shape),
        {"long_name": "why the run failed, or empty"},
    )
    if job.trajectories:
        coordinates["time"] = ("time", np.array(decimals(job.points)), {"units": "s", "long_name": "time"})
    return xr.Dataset(data, coordinates, {"title": plan.name, "fmu": job.fmus[0].name, **job.fixed})


def _attributes(quantity: Any) -> dict[str, str]:
    return {"units": quantity.unit, "long_name": quantity.description}
