"""The engine: every run once, whatever dies meanwhile, and each the run that `hitch run` makes."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import Any

import numpy as np
import psutil
import pytest
import xarray as xr
import zarr

import overrun_hitch
from overrun_hitch import cli
from overrun_hitch.decimals import decimals
from overrun_hitch.measure.metrics import METRICS
from overrun_hitch.parameters import FIGURES, HitchError, Parameters
from overrun_hitch.results import VARIABLES
from overrun_hitch.sweeps.engine import WORKER_DIED
from overrun_hitch.sweeps.job import Batch, Done
from overrun_hitch.sweeps.layout import FAILED, FINISHED, MISSING
from overrun_hitch.sweeps.planner import planned
from overrun_hitch.sweeps.runner import Runner
from overrun_hitch.sweeps.spec import SweepSpec
from overrun_hitch.sweeps.store import opened_store, read_sweep
from overrun_hitch.sweeps.worker import run_batch
from tests.runs import step_brake

# Long enough to be interrupted in the middle: some seconds, in dozens of batches.
LONG: dict[str, Any] = {
    "name": "long",
    "metrics": ["peak_compression", "peak_jerk"],
    "trajectories": ["a_car"],
    "grid": {"C": {"min": 50.0, "max": 900.0, "count": 20}, "M_t": {"min": 300.0, "max": 700.0, "count": 30}},
}
LONG_TOML = """
name = "long"
metrics = ["peak_compression", "peak_jerk"]
trajectories = ["a_car"]
[grid]
C = { min = 50.0, max = 900.0, count = 20 }
M_t = { min = 300.0, max = 700.0, count = 30 }
"""


def alone(spec: SweepSpec, fmu: Path, store: Path) -> xr.Dataset:
    """The sweep without any cluster."""
    plan = planned(spec, [fmu])
    runner = Runner(plan.job, fmu)
    try:
        with opened_store(store, plan) as opened:
            for number in opened.missing():
                opened.write(number, runner.run(opened.batch(number)))
    finally:
        runner.close()
    return read_sweep(store).load()


@pytest.fixture(scope="module")
def undisturbed(car_trailer_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> xr.Dataset:
    return alone(SweepSpec(**LONG), car_trailer_fmu, tmp_path_factory.mktemp("alone") / "alone.zarr")


def workers() -> list[psutil.Process]:
    """The processes that run for this one."""
    found = [child for child in psutil.Process().children(recursive=True) if child.status() != psutil.STATUS_ZOMBIE]
    return [child for child in found if any("guest_process" in word for word in child.cmdline())]


class KillAWorker:
    """A progress that kills a worker as soon as more runs are done than before, but not all."""

    def __init__(self) -> None:
        self._first: int | None = None
        self.killed = False

    def __call__(self, done: int, failed: int, runs: int) -> None:
        first = self._first = done if self._first is None else self._first
        if not self.killed and first < done < runs:
            workers()[0].kill()
            self.killed = True


def hitch(tmp_path: Path, fmu: Path, *options: str) -> subprocess.Popen[str]:
    """`hitch sweep` on LONG in a process group of its own, with its temporary files in tmp_path/tmp."""
    spec, temporary = tmp_path / "long.toml", tmp_path / "tmp"
    spec.write_text(LONG_TOML)
    temporary.mkdir(exist_ok=True)
    command = [sys.executable, "-m", "overrun_hitch", "sweep", str(spec), "--fmu", str(fmu), "--output", str(tmp_path)]
    return subprocess.Popen(
        [*command, *options], start_new_session=True, stderr=subprocess.PIPE, text=True,
        env={**os.environ, "TMPDIR": str(temporary)},
    )  # fmt: skip


def wait_until_midway(store: Path, process: subprocess.Popen[str]) -> None:
    deadline = time.monotonic() + 120.0
    while time.monotonic() < deadline and process.poll() is None:
        if batches_done(store):
            return
        time.sleep(0.01)
    raise AssertionError(f"no batch is done: {process.stderr.read() if process.stderr else ''}")


def batches_done(store: Path) -> set[str]:
    """Their numbers: a batch counts when its checksums are there."""
    return {path.name for path in (store / "checksums").glob("[0-9]*")}


def check_midway(store: Path) -> None:
    status = read_sweep(store)["status"].values
    assert (status == FINISHED).any()
    assert (status == MISSING).any()


def wait_until_gone(group: int) -> None:
    """Until no process of the group runs any more."""
    deadline = time.monotonic() + 30.0
    while time.monotonic() < deadline:
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return
        time.sleep(0.05)
    raise AssertionError("processes are left")


@pytest.mark.full
def test_a_killed_sweep_goes_on_where_it_stopped(
    car_trailer_fmu: Path, tmp_path: Path, undisturbed: xr.Dataset
) -> None:
    """kill -9 of the sweep, and of a guest of the one that goes on."""
    store = tmp_path / "long.zarr"
    process = hitch(tmp_path, car_trailer_fmu)
    wait_until_midway(store, process)
    process.kill()
    process.communicate()
    wait_until_gone(process.pid)
    check_midway(store)
    before = {path: path.stat().st_mtime_ns for path in store.rglob("[0-9]*") if path.is_file()}
    done = batches_done(store)
    killer = KillAWorker()
    found = overrun_hitch.sweep(LONG, store, fmus=[car_trailer_fmu], workers=2, progress=killer)
    assert killer.killed
    xr.testing.assert_identical(found.load(), undisturbed)
    # What was done is not done again.
    kept = [path for path in before if path.name.split(".")[0] in done and path.parent.name in (*METRICS, "status")]
    assert kept
    assert all(path.stat().st_mtime_ns == before[path] for path in kept)
    assert not workers()
    assert {path.name for path in tmp_path.iterdir()} == {"long.zarr", "long.toml", "tmp"}


def test_ctrl_c_leaves_a_store_to_go_on_from_and_nothing_else(car_trailer_fmu: Path, tmp_path: Path) -> None:
    store = tmp_path / "long.zarr"
    process = hitch(tmp_path, car_trailer_fmu)
    wait_until_midway(store, process)
    os.killpg(process.pid, signal.SIGINT)
    _, err = process.communicate(timeout=60.0)
    assert process.returncode == 130
    wait_until_gone(process.pid)
    check_midway(store)
    done = int((read_sweep(store)["status"].values != MISSING).sum())
    said = re.fullmatch(r"interrupted, (\d+) of 600 runs are done; the same command goes on\n", err)
    size = int(zarr.open_group(str(store), mode="r")["status"].chunks[0])
    assert said and done - size <= int(said[1]) <= done  # the last batch may have been written and not yet told
    assert {path.name for path in tmp_path.iterdir()} == {"long.zarr", "long.toml", "tmp"}
    assert not list((tmp_path / "tmp").iterdir())


@contextmanager
def running_cluster(tmp_path: Path) -> Iterator[tuple[str, subprocess.Popen[bytes]]]:
    """Address and process of a Dask scheduler on the loopback, with two workers."""
    dask = [sys.executable, "-m", "dask"]
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    address_file = tmp_path / "scheduler.json"
    scheduler = subprocess.Popen(
        [*dask, "scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--dashboard-address",
         "127.0.0.1:0", "--scheduler-file", str(address_file)], **quiet,
    )  # fmt: skip
    worker = subprocess.Popen(
        [*dask, "worker", "--scheduler-file", str(address_file), "--nworkers", "2", "--nthreads", "1", "--no-dashboard",
         "--host", "127.0.0.1", "--local-directory", str(tmp_path / "work"), "--death-timeout", "20"],
        **quiet,
    )  # fmt: skip
    try:
        deadline = time.monotonic() + 60.0
        while not address_file.exists() and time.monotonic() < deadline:
            time.sleep(0.05)
        yield json.loads(address_file.read_text())["address"], scheduler
    finally:
        for process in (worker, scheduler):
            process.terminate()
        for process in (worker, scheduler):
            try:
                process.wait(10.0)
            except subprocess.TimeoutExpired:
                for child in psutil.Process(process.pid).children(recursive=True):
                    child.kill()
                process.kill()
                process.wait()


@pytest.mark.full
def test_a_running_cluster_whose_scheduler_is_killed(
    car_trailer_fmu: Path, tmp_path: Path, undisturbed: xr.Dataset
) -> None:
    store = tmp_path / "long.zarr"
    with running_cluster(tmp_path) as (address, scheduler):
        process = hitch(tmp_path, car_trailer_fmu, "--scheduler", address)
        wait_until_midway(store, process)
        scheduler.kill()
        _, err = process.communicate(timeout=90.0)
    assert process.returncode == 2
    hint, error = err.splitlines()
    assert hint.startswith("hint: whoever reaches")
    assert "the scheduler is gone; " in error
    check_midway(store)
    xr.testing.assert_identical(alone(SweepSpec(**LONG), car_trailer_fmu, store), undisturbed)


def test_a_run_is_that_of_hitch_run(car_trailer_fmu: Path, tmp_path: Path) -> None:
    """Bit for bit, whatever ran on the instance before."""
    values = {
        name: [getattr(figure.parameters, name) for figure in FIGURES.values()] for name in Parameters.model_fields
    }
    runs = {name: column for name, column in values.items() if len(set(column)) > 1}
    found = alone(SweepSpec(runs=runs, trajectories=list(VARIABLES)), car_trailer_fmu, tmp_path / "figures.zarr")
    for place, scenario in enumerate(FIGURES.values()):
        expected = step_brake(scenario, fmu=car_trailer_fmu)
        for name in VARIABLES:
            assert (found[name][place].values == expected[name].values).all()
    assert found["time"].values.tolist() == decimals(expected["time"].values)


def test_everything_has_its_unit(car_trailer_fmu: Path, tmp_path: Path) -> None:
    spec = SweepSpec(grid={"C": [100.0, 200.0], "grade": [0.0, 0.05]}, duration=1.0, trajectories=["v_car"])
    found = alone(spec, car_trailer_fmu, tmp_path / "units.zarr")
    assert {name: found[name].attrs["units"] for name in METRICS} == {name: m.unit for name, m in METRICS.items()}
    assert [found[name].attrs["units"] for name in ("C", "grade", "v_car", "time")] == ["N.s/m", "1", "m/s", "s"]
    assert all(found[name].attrs["long_name"] for name in found.variables)


def test_a_run_that_fails_is_recorded_and_stops_nothing(car_trailer_fmu: Path, tmp_path: Path) -> None:
    """The unit refuses, in its own words, what does not go together: a threshold that no frame holds."""
    runs = {"compression_start": [0.0, 0.0, 0.01], "F_0": [0.0, 100.0, 0.0], "k_t": [548e3, 0.0, 548e3]}
    spec = SweepSpec(runs=runs, trajectories=["a_car"])
    found = alone(spec, car_trailer_fmu, tmp_path / "failing.zarr")
    assert found["status"].values.tolist() == [FINISHED, FAILED, FINISHED]
    assert [bool(text) for text in found["message"].values] == [False, True, False]
    assert "CarTrailer.fmu: " in str(found["message"].values[1])
    assert np.isnan(found["a_car"].values[1]).all()
    good = alone(SweepSpec(grid={"compression_start": [0.01]}), car_trailer_fmu, tmp_path / "good.zarr")
    assert found["peak_compression"].values[2] == good["peak_compression"].values[0]


@pytest.mark.full
@pytest.mark.parametrize("forgiven", [0, 3])  # deaths; Dask's default is 3
def test_a_run_in_which_workers_of_a_cluster_die_is_recorded(
    forgiven: int, car_trailer_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = [str(Path(__file__).parents[3]), str(Path(__file__).parent), os.environ.get("PYTHONPATH", "")]
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(path))
    monkeypatch.setenv("DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES", str(forgiven))
    spec = {"metrics": ["peak_jerk"], "grid": {"C": [100.0, 666.0, 300.0]}, "communication_step": 0.1}
    monkeypatch.setattr("overrun_hitch.sweeps.engine.run_batch", deadly_batch)
    with running_cluster(tmp_path) as (address, _):
        found = overrun_hitch.sweep(spec, tmp_path / "deadly.zarr", fmus=[car_trailer_fmu], scheduler=address)
    assert found["status"].values.tolist() == [FINISHED, FAILED, FINISHED]
    assert str(found["message"].values[1]) == WORKER_DIED
    assert np.isfinite(found["peak_jerk"].values[[0, 2]]).all()


def deadly_batch(name: str, batch: Batch) -> Done:
    """What ends the process of a worker, whatever it is."""
    if 666.0 in batch.values:
        os.kill(os.getpid(), signal.SIGKILL)
    return run_batch(name, batch)


def test_profiles_and_slopes(car_trailer_fmu: Path, tmp_path: Path) -> None:
    """A jump is a step brake; a ramp in one piece and in two are the same; a hold at the end goes on."""
    spec = SweepSpec(
        duration=2.0,
        trajectories=["v_car"],
        metrics=[],
        grid={"C": [500.0]},
        profiles={
            "step": {"time": [0.0], "brake_torque": [1000.0]},
            "ramp": {"time": [0.0, 1.0], "brake_torque": [0.0, 1000.0]},
            "pieces": {"time": [0.0, 0.5, 1.0, 2.0], "brake_torque": [0.0, 500.0, 1000.0, 1000.0]},
            "jump": {"time": [0.0, 1.0, 1.0], "brake_torque": [0.0, 0.0, 1000.0]},
        },
    )
    found = alone(spec, car_trailer_fmu, tmp_path / "profiles.zarr")
    speed = {str(name): run.values for name, run in zip(found["profile"].values, found["v_car"], strict=True)}
    assert (speed["step"] == step_brake(FIGURES["8"], fmu=car_trailer_fmu)["v_car"].values[:201]).all()
    assert speed["pieces"] == pytest.approx(speed["ramp"], abs=1e-9)
    assert (speed["jump"][:101] == 40.0).all()
    assert speed["jump"][101:] == pytest.approx(speed["step"][1:101], abs=1e-5)
    # A ramp gives half the impulse while it lasts.
    assert 40.0 - speed["ramp"][100] == pytest.approx(0.5 * (40.0 - speed["step"][100]), rel=0.05)


def test_a_store_is_for_one_sweep(car_trailer_fmu: Path, tmp_path: Path) -> None:
    spec, store = SweepSpec(duration=1.0, grid={"C": [100.0, 200.0]}), tmp_path / "one.zarr"
    first = alone(spec, car_trailer_fmu, store)
    again = alone(spec, car_trailer_fmu, store)
    xr.testing.assert_identical(first, again)
    for changes, named in (
        ({"duration": 2.0}, "duration"),
        ({"grid": {"C": [100.0, 201.0]}}, "runs"),
        ({"parameters": {"k": 5000.0}}, "parameters"),
        ({"metrics": ["peak_jerk"]}, "metrics"),
    ):
        other = SweepSpec(**{**spec.model_dump(), **changes})
        with pytest.raises(HitchError, match=f"one.zarr holds another sweep, which differs in {named}"):
            alone(other, car_trailer_fmu, store)
    (tmp_path / "two.zarr").mkdir()
    with pytest.raises(HitchError, match=r"two\.zarr is there and holds no sweep"):
        alone(spec, car_trailer_fmu, tmp_path / "two.zarr")
    plan = planned(spec, [car_trailer_fmu])
    with opened_store(store, plan), pytest.raises(HitchError, match="is being written by another sweep"):
        alone(spec, car_trailer_fmu, store)


def test_a_place_that_cannot_be_written_is_told_before_the_first_run(
    car_trailer_fmu: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").write_text("")
    (tmp_path / "spec.toml").write_text("grid = {C = [1.0, 2.0]}")
    options = ["--fmu", str(car_trailer_fmu), "--output", str(tmp_path / "file" / "out")]
    assert cli.main(["sweep", str(tmp_path / "spec.toml"), *options]) == 2
    assert "cannot read or write" in capsys.readouterr().err


def test_no_scheduler_and_bad_workers(car_trailer_fmu: Path, tmp_path: Path) -> None:
    spec = {"grid": {"C": [1.0, 2.0]}}
    with pytest.raises(HitchError, match="workers = 0 is not allowed; allowed: 1 to 1000"):
        overrun_hitch.sweep(spec, tmp_path / "a.zarr", fmus=[car_trailer_fmu], workers=0)
    for address in ("nonsense://x:1", "127.0.0.1:8786", "tcp://127.0.0.1", "tls://:8786", "tcp://host:port", "tcp://["):
        with pytest.raises(
            HitchError, match=r"scheduler = .* is not allowed; allowed: tls://host:port or tcp://host:port"
        ):
            overrun_hitch.sweep(spec, tmp_path / "b.zarr", fmus=[car_trailer_fmu], scheduler=address)


@pytest.mark.full
def test_the_command_draws_and_tells_and_nothing_listens(
    car_trailer_fmu: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    heard: list[object] = []
    processes = 0

    def listen(*_: object) -> None:
        nonlocal processes
        family = [psutil.Process(), *workers()]
        processes = max(processes, len(family))
        for process in family:
            heard.extend(one for one in process.net_connections("all") if one.status == psutil.CONN_LISTEN)

    monkeypatch.setattr("overrun_hitch.show.terminal.counting", lambda _: nullcontext(listen))
    spec = tmp_path / "map.toml"
    spec.write_text("name = 'map'\ncommunication_step = 0.1\ngrid = {C = [100.0, 400.0, 900.0], V_0 = [20.0, 40.0]}")
    options = ["--fmu", str(car_trailer_fmu), "--output", str(tmp_path / "out"), "--workers", "1"]
    assert cli.main(["sweep", str(spec), "--map", "growth_rate", *options]) == 0
    out = capsys.readouterr().out
    assert "map: 6 runs" in out
    assert {path.name for path in (tmp_path / "out").iterdir()} == {
        "map.zarr", "map-growth_rate.png", "map-growth_rate.svg"
    }  # fmt: skip
    assert processes == 2
    assert heard == []
    assert cli.main(["sweep", str(spec), "--map", "speed", *options]) == 2
    assert "there is no metric 'speed'" in capsys.readouterr().err
