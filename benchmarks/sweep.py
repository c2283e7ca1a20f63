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
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import psutil
from threadpoolctl import threadpool_limits

from overrun_hitch.fmu.opening import opened_unit
from overrun_hitch.measure.metrics import NEEDED, Traces, measured
from overrun_hitch.sweeps.engine import run_plan
from overrun_hitch.sweeps.plan import Plan
from overrun_hitch.sweeps.planner import planned
from overrun_hitch.sweeps.runner import read
from overrun_hitch.sweeps.spec import SweepSpec

RANGES = {"C": {"min": 100.0, "max": 1000.0}, "V_0": {"min": 20.0, "max": 40.0}, "M_t": {"min": 300.0, "max": 700.0}}
RUNS = 10_000
OVERHEAD = 0.2  # allowed
AT_ONCE = 500  # runs whose metrics are computed together in the bare loop, as in a batch


def bare(plan: Plan, fmu: Path, runs: int) -> tuple[float, float]:
    """Wall and CPU time (s) of a run in a bare loop."""
    job = plan.job
    columns = [plan.columns[name].tolist() for name in job.varied]
    with opened_unit(fmu) as unit, threadpool_limits(limits=1):
        names = read(job)
        sampler = unit.sampler(names, job.points)
        wall, cpu = time.perf_counter(), time.process_time()
        for first in range(0, runs, AT_ONCE):
            rows = []
            for run in range(first, first + AT_ONCE):
                values = {name: column[run] for name, column in zip(job.varied, columns, strict=True)}
                unit.start_with({**job.fixed, **values}, job.relative_tolerance)
                rows.append(sampler.run().copy())
            table = dict(zip(names, np.array(rows).transpose(2, 0, 1), strict=True))
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
        workers = psutil.Process().children(True)
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


@dataclass(frozen=True)
class Measured:
    """A sweep beside the same runs in a bare loop, before and after it."""

    workers: int
    wall: float  # s a run
    cpu: float  # s a run
    bare_wall: float
    bare_cpu: float
    memory: tuple[float, float]  # MiB of the largest worker, a quarter through and at the end

    @property
    def overhead(self) -> float:
        """What the engine takes over the bare runs, in CPU time (1)."""
        return self.cpu / self.bare_cpu - 1.0

    def row(self) -> str:
        """For the table below HEADER."""
        return (
            f"| {self.workers} | {1.0 / self.wall:.0f} | {1.0 / self.bare_wall:.0f} | {1e3 * self.cpu:.2f} ms "
            f"| {1e3 * self.bare_cpu:.2f} ms | {100.0 * self.overhead:.0f} % "
            f"| {self.memory[0]:.0f}, {self.memory[1]:.0f} MiB |"
        )


HEADER = (
    "| workers | runs/s | bare, one core | CPU a run | bare | over bare | memory of a worker at 1/4, at the end |\n"
    "|---|---|---|---|---|---|---|"
)


def measure(plan: Plan, fmu: Path, workers: int) -> Measured:
    """The sweep with so many workers."""
    few = min(plan.runs // AT_ONCE, 4) * AT_ONCE
    before, found, after = bare(plan, fmu, few), engine(plan, workers), bare(plan, fmu, few)
    wall, cpu = (0.5 * (one + other) for one, other in zip(before, after, strict=True))
    return Measured(workers, found[0], found[1], wall, cpu, found[2:])


def plan_of(fmu: Path, runs: int, metrics: list[str] | None = None, trajectories: Sequence[str] = ()) -> Plan:
    """Step brakes of 6 s with 100 output points."""
    spec = SweepSpec(
        communication_step=0.06, metrics=metrics, trajectories=list(trajectories),
        sample={"method": "latin-hypercube", "count": runs, "ranges": RANGES},
    )  # fmt: skip
    return planned(spec, [fmu])


def section(fmu: Path) -> tuple[str, bool]:
    """For results.md, and whether what is asked of sweeps is met."""
    plan = plan_of(fmu, RUNS)
    found = [measure(plan, fmu, workers) for workers in (1, 2)]
    cheap = is_cheap(found)
    text = f"""## Sweeps

`hitch sweep`'s engine: {RUNS} step brakes of 6 s with 100 output points and {len(plan.job.metrics)} metrics
each, beside the same runs in a bare loop; CPU time of all processes.

{HEADER}
{chr(10).join(one.row() for one in found)}

At most {100.0 * OVERHEAD:g} % over bare: {"met" if cheap else "NOT MET"}.
"""
    return text, cheap


def is_cheap(found: Sequence[Measured]) -> bool:
    """Whether the engine takes little more CPU time than the bare runs beside it; how fast both are is not judged."""
    return max(one.overhead for one in found) <= OVERHEAD


def main() -> None:
    """Measure and print one table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("fmu", type=Path)
    parser.add_argument("--runs", type=int, default=RUNS)
    parser.add_argument("--workers", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--metrics", nargs="+", help="all, if not given")
    parser.add_argument("--trajectories", nargs="+", default=[])
    asked = parser.parse_args()
    plan = plan_of(asked.fmu, asked.runs, asked.metrics, asked.trajectories)
    print(f"{asked.runs} runs, {len(plan.job.metrics)} metrics, {len(plan.job.trajectories)} trajectories, "
          f"{os.cpu_count()} cores, load {os.getloadavg()[0]:.1f} before\n{HEADER}")  # fmt: skip
    for workers in asked.workers:
        print(measure(plan, asked.fmu, workers).row())


if __name__ == "__main__":
    main()
