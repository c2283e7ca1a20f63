"""What it costs that batches of a sweep outlast a power cut and are known to be whole.

    python -m benchmarks.store FMU

Of batches of 500 step brakes, best of three: the time to run one, to write one, to write one without waiting for the
disk, and to check a whole store as it is opened. The store is in the folder where this runs.
"""

from __future__ import annotations

import argparse
import os
import tempfile
import time
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from unittest import mock

import numpy as np

from benchmarks.sweep import plan_of
from overrun_hitch.results import VARIABLES
from overrun_hitch.sweeps.plan import Plan
from overrun_hitch.sweeps.store import opened_store
from overrun_hitch.sweeps.worker import Runner

RUNS = 8000
REPEATS = 3
WHAT = {"peak jerk": (["peak_jerk"], []), "all metrics": (None, []), "nine trajectories": ([], list(VARIABLES))}


def seconds(do: Callable[[], object]) -> float:
    """How long it takes."""
    began = time.perf_counter()
    do()
    return time.perf_counter() - began


def measured(plan: Plan) -> list[float]:
    """Seconds to run a batch, to write one, and to open the store with all of them; and its size in MiB."""
    runner = Runner(plan.job)
    with tempfile.TemporaryDirectory(dir=".") as folder:
        store = Path(folder) / "sweep.zarr"
        with opened_store(store, plan) as opened:
            done = runner.run(opened.batch(0))
            run = seconds(lambda: runner.run(opened.batch(0)))
            write = seconds(lambda: [opened.write(number, done) for number in range(opened.batches)]) / opened.batches
        with ExitStack() as stack:
            check = seconds(lambda: stack.enter_context(opened_store(store, plan)))
        size = sum(path.stat().st_size for path in store.rglob("*") if path.is_file()) / 2**20
    runner.close()
    return [run, write, check, size]


def main() -> None:
    """Measure and print the table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("fmu", type=Path)
    fmu = parser.parse_args().fmu
    print(f"{os.cpu_count()} cores, load {os.getloadavg()[0]:.1f} before")
    print("| 500 runs with | run | written | without fsync | size of 16 | checked |\n|---|---|---|---|---|---|")
    for name, (metrics, trajectories) in WHAT.items():
        plan = plan_of(fmu, RUNS, metrics, trajectories)
        run, write, check, size = np.min([measured(plan) for _ in range(REPEATS)], axis=0)
        with mock.patch("os.fsync"):
            _, unsynced, _, _ = np.min([measured(plan) for _ in range(REPEATS)], axis=0)
        print(
            f"| {name} | {1e3 * run:.0f} ms | {1e3 * write:.0f} ms | {1e3 * unsynced:.0f} ms | {size:.1f} MiB "
            f"| {check:.2f} s |"
        )


if __name__ == "__main__":
    main()
