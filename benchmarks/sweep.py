"""What the engine of sweeps costs: runs a second by workers, overhead over the same runs in a bare loop, memory.

    python -m benchmarks.sweep FMU [--runs 10000] [--workers 1 2] [--metrics peak_jerk]

The runs are step brakes of six seconds with 100 output steps and parameters from a Latin hypercube. The bare loop makes
the same runs and metrics in one process, without batches, messages or a store. Times are taken from the first batch
that is done to the last, so that starting Python does not count; the CPU time of all processes is what others on the
machine disturb least.
"""

from __future__ import annotations

import argparse
import os
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import psutil
from threadpoolctl import threadpool_limits

from overrun_hitch.metrics import NEEDED, Traces, measured
from overrun_hitch.results import VARIABLES
from overrun_hitch.sweep_engine import run_plan
from overrun_hitch.sweep_plan import Plan, planned
from overrun_hitch.sweep_spec import SweepSpec
from overrun_hitch.unit import opened_unit

RANGES = {"C": {"min": 100.0, "max": 1000.0}, "V_0": {"min": 20.0, "max": 40.0}, "M_t": {"min": 300.0, "max": 700.0}}
AT_ONCE = 500  # runs whose metrics are computed together in the bare loop, as in a batch


def bare(plan: Plan, fmu: Path, runs: int) -> tuple[float, float]:
    """Wall and CPU time (s) of a run in a bare loop."""
    job = plan.job
    columns = [plan.columns[name].tolist() for name in job.varied]
    with opened_unit(fmu) as unit, threadpool_limits(limits=1):
        sampler = unit.sampler(list(VARIABLES), job.points)
        wall, cpu = time.perf_counter(), time.process_time()
        for first in range(0, runs, AT_ONCE):
            rows = []
            for run in range(first, first + AT_ONCE):
                values = {name: column[run] for name, column in zip(job.varied, columns, strict=True)}
                unit.start_with({**job.fixed, **values}, job.relative_tolerance)
                rows.append(sampler.run().copy())
            table = dict(zip(VARIABLES, np.array(rows).transpose(2, 0, 1), strict=True))
            measured(job.metrics, Traces(job.points, {name: table[name] for name in NEEDED}, np.zeros(AT_ONCE)))
        return (time.perf_counter() - wall) / runs, (time.process_time() - cpu) / runs


@dataclass
class Watch:
    """A progress that notes wall time, CPU time of all processes, and the largest memory of a worker."""

    done: list[int] = field(default_factory=list)
    wall: list[float] = field(default_factory=list)
    cpu: list[float] = field(default_factory=list)
    memory: list[float] = field(default_factory=list)

    def __call__(self, done: int, failed: int, runs: int) -> None:
        """Note where the sweep is."""
        workers = [one for one in psutil.Process().children(True) if "--multiprocessing-fork" in one.cmdline()]
        if workers:
            times = [one.cpu_times() for one in [psutil.Process(), *workers]]
            self.done.append(done)
            self.wall.append(time.perf_counter())
            self.cpu.append(sum(each.user + each.system for each in times))
            self.memory.append(max(one.memory_info().rss for one in workers) / 2**20)


def engine(plan: Plan, workers: int) -> tuple[float, float, float, float]:
    """Wall and CPU time (s) of a run, and the largest memory (MiB) of a worker, a quarter through and at the end."""
    watch = Watch()
    with tempfile.TemporaryDirectory() as folder:
        run_plan(plan, Path(folder) / "sweep.zarr", workers=workers, progress=watch)
    runs = watch.done[-1] - watch.done[0]
    quarter = watch.memory[len(watch.memory) // 4]
    wall, cpu = ((each[-1] - each[0]) / runs for each in (watch.wall, watch.cpu))
    return wall, cpu, quarter, watch.memory[-1]


def main() -> None:
    """Measure and print one table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("fmu", type=Path)
    parser.add_argument("--runs", type=int, default=10_000)
    parser.add_argument("--workers", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--metrics", nargs="+", help="all, if not given")
    parser.add_argument("--trajectories", nargs="+", default=[])
    asked = parser.parse_args()
    spec = SweepSpec(
        communication_step=0.06, metrics=asked.metrics, trajectories=asked.trajectories,
        sample={"method": "latin-hypercube", "count": asked.runs, "ranges": RANGES},
    )  # fmt: skip
    plan = planned(spec, [asked.fmu])
    print(f"{asked.runs} runs, {len(plan.job.metrics)} metrics, {len(plan.job.trajectories)} trajectories, "
          f"{os.cpu_count()} cores, load {os.getloadavg()[0]:.1f} before")  # fmt: skip
    few = min(asked.runs // AT_ONCE, 4) * AT_ONCE
    print("            runs/s  CPU ms/run  over bare (CPU)  worker MiB at 1/4, at end")
    for workers in asked.workers:
        before, found, after = bare(plan, asked.fmu, few), engine(plan, workers), bare(plan, asked.fmu, few)
        cpu = 0.5 * (before[1] + after[1])
        print(f"bare        {2.0 / (before[0] + after[0]):6.0f}  {1e3 * cpu:10.3f}")
        print(f"{workers} worker(s) {1.0 / found[0]:6.0f}  {1e3 * found[1]:10.3f}  {found[1] / cpu - 1.0:15.1%}  "
              f"{found[2]:10.0f} {found[3]:10.0f}")  # fmt: skip


if __name__ == "__main__":
    main()
