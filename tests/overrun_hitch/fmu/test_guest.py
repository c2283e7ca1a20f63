"""Guests: whatever an FMU does to its process, it does to that one; the command tells, and nothing is left."""

from __future__ import annotations

import inspect
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pytest

from overrun_hitch import cli
from overrun_hitch.comparison.crosscheck import crosscheck
from overrun_hitch.comparison.distances import Allowed
from overrun_hitch.comparison.sources import Manoeuvre, UnitSource
from overrun_hitch.experiments import step_brake as experiment
from overrun_hitch.fmu.guest_unit import guest_unit
from overrun_hitch.fmu.opening import opened_unit
from overrun_hitch.fmu.settings import Settings
from overrun_hitch.parameters import FIGURES, HitchError
from tests.overrun_hitch.fmu.strangers import ABORTS, ALLOCATES, EXITS, FAULTS, HANGS, stranger
from tests.runs import step_brake
from tests.sampling import sampled

ENDINGS = {
    "hangs": (HANGS, "did not finish within 1 s (--time-limit)"),
    "aborts": (ABORTS, "crashed: aborted"),
    "faults": (FAULTS, "crashed: segmentation fault"),
    "exits": (EXITS, "crashed: it ended its process, with exit status 3"),
    "allocates": (ALLOCATES, "crashed: segmentation fault"),
}
ONCE = "static int done; if (!done++) "


def guests() -> list[psutil.Process]:
    """Those of this process."""
    return [one for one in psutil.Process().children() if any("guest_process" in word for word in one.cmdline())]


@pytest.mark.parametrize("ending", sampled(ENDINGS, ["hangs", "aborts", "exits"]))
def test_an_fmu_that_ends_its_process_is_one_line_and_status_2(
    ending: str, car_trailer_fmu: Path, tmp_path: Path, temporary: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    code, words = ENDINGS[ending]
    limit = "1" if ending == "hangs" else "30"
    fmu = stranger(car_trailer_fmu, tmp_path / f"{ending}.fmu", do_step=f"if (C == 444.0 && time > 1.0) {{ {code} }}")
    options = ["--fmu", str(fmu), "--set", "C=444", "--time-limit", limit, "--output", str(tmp_path / "out")]
    assert cli.main(["run", *options]) == 2
    out, err = capfd.readouterr()
    assert out == ""
    assert err == f"hitch: {fmu}: {words}; the run was figure 8 with C=444\n"
    assert not (tmp_path / "out").exists()
    assert list(temporary.iterdir()) == []
    assert guests() == []


@pytest.mark.full
def test_one_of_a_pair_that_hangs(
    pair_fmus: dict[int, dict[str, Path]],
    hitch_fmu: Path,
    car_trailer_fmu: Path,
    tmp_path: Path,
    capfd: pytest.CaptureFixture[str],
) -> None:
    trailer = stranger(pair_fmus[2]["Trailer"], tmp_path / "hangs.fmu", do_step=f"if (time > 1.0) {{ {HANGS} }}")
    car = str(pair_fmus[2]["Car"])
    fmus = ["--car", car, "--trailer", str(trailer), "--hitch", str(hitch_fmu), "--whole", str(car_trailer_fmu)]
    command = ["couple", *fmus, "--H", "0.05", "--time-limit", "2"]
    assert cli.main([*command, "--output", str(tmp_path / "out")]) == 2
    words = "did not finish within 2 s (--time-limit); the run was 'jacobi' with H = 0.05 s"
    assert capfd.readouterr().err == f"hitch: {car} with {trailer}: {words}\n"


@pytest.mark.full
def test_the_next_run_gets_another_process(car_trailer_fmu: Path, tmp_path: Path) -> None:
    code = f"if (C == 1.0) {{ {FAULTS} }} if (C == 2.0) {{ {HANGS} }}"
    fmu = stranger(car_trailer_fmu, tmp_path / "spoilt.fmu", do_step=code)
    scenarios = [
        FIGURES["8"].changed(parameters=FIGURES["8"].parameters.changed({"C": C}), duration=0.1)
        for C in (500.0, 1.0, 2.0)
    ]
    with guest_unit(fmu, time_limit=1.0) as unit:
        before = experiment.brake(unit, scenarios[0], Settings()).dataset()
        for scenario, words in zip(scenarios[1:], ("segmentation fault", "did not finish"), strict=True):
            with pytest.raises(HitchError, match=words):
                experiment.brake(unit, scenario, Settings())
        assert experiment.brake(unit, scenarios[0], Settings()).dataset().identical(before)


@pytest.mark.parametrize("figure", ["8", "11"])
def test_a_run_in_a_guest_is_that_in_this_process(figure: str, car_trailer_fmu: Path) -> None:
    """Bit for bit."""
    expected = step_brake(FIGURES[figure], fmu=car_trailer_fmu)
    assert experiment.step_brake(FIGURES[figure], fmu=car_trailer_fmu).identical(expected)


def test_what_it_prints_is_not_shown(car_trailer_fmu: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    lines = 'for (int i = 0; i < 1000000; i++) { puts("{ 1, 2"); fputs("noise\\n", stderr); }'
    fmu = stranger(car_trailer_fmu, tmp_path / "prints.fmu", do_step=f"{ONCE} {{ {lines} }}")
    command = ["crosscheck", str(fmu), str(car_trailer_fmu), "--figure", "8", "--json", "--output", str(tmp_path)]
    assert cli.main(command) == 0
    out, err = capfd.readouterr()
    assert json.loads(out)["agrees"] is True
    assert err == ""


def test_what_is_no_number_differs(car_trailer_fmu: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    fmu = stranger(car_trailer_fmu, tmp_path / "nan.fmu", get="if (n > 8) values[6] = 0.0 / 0.0;")
    command = ["crosscheck", str(car_trailer_fmu), str(fmu), "--figure", "8", "--output", str(tmp_path)]
    assert cli.main(command) == 1
    assert "B differs from A in figure 8: slip_car\n" in capfd.readouterr().out


def test_two_fmus_that_share_what_a_process_has_one_of_still_differ(
    car_trailer_fmu: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    """As two by pythonfmu of modules of one name: the first to come decides for both. The second is 1 % stiffer."""
    fmus = [
        stranger(
            car_trailer_fmu, tmp_path / f"{factor}.fmu",
            set_k=f'setenv("STRANGERS_FACTOR", "{factor}", 0); k *= atof(getenv("STRANGERS_FACTOR"));',
        )
        for factor in (1.0, 1.01)
    ]  # fmt: skip
    command = ["crosscheck", *map(str, fmus), "--figure", "8", "--output", str(tmp_path)]
    assert cli.main(command) == 1
    assert "B differs from A in figure 8: " in capfd.readouterr().out
    with opened_unit(fmus[0]) as first, opened_unit(fmus[1]) as second:  # where they meet, one hides the other
        check = crosscheck(Manoeuvre(FIGURES["8"], Settings()), [UnitSource(first), UnitSource(second)], Allowed())
    assert check.comparisons[0].differing == []


@pytest.mark.full
def test_one_that_hangs_at_its_end_is_not_waited_for(car_trailer_fmu: Path, tmp_path: Path, temporary: Path) -> None:
    fmu = stranger(car_trailer_fmu, tmp_path / "stays.fmu", free=HANGS)
    with guest_unit(fmu) as unit:
        experiment.brake(unit, FIGURES["8"].changed(duration=0.1), Settings())
    assert guests() == []
    assert list(temporary.iterdir()) == []


@pytest.mark.parametrize(
    ("sent", "status"), [(signal.SIGINT, 130), pytest.param(signal.SIGKILL, -signal.SIGKILL, marks=pytest.mark.full)]
)
def test_a_command_that_is_ended_leaves_neither_processes_nor_folders(
    sent: signal.Signals, status: int, car_trailer_fmu: Path, tmp_path: Path, temporary: Path
) -> None:
    """Not even those that the FMU has made."""
    marker = tmp_path / "hangs"
    code = f'{ONCE} {{ if (!fork()) for (;;) pause(); fclose(fopen("{marker}", "w")); }} {HANGS}'
    fmu = stranger(car_trailer_fmu, tmp_path / "hangs.fmu", do_step=code)
    command = [sys.executable, "-m", "overrun_hitch", "run", "--fmu", str(fmu), "--output", str(tmp_path / "out")]
    process = subprocess.Popen(
        command, env={**os.environ, "TMPDIR": str(temporary)}, stderr=subprocess.PIPE, text=True, start_new_session=True
    )
    wait_until(marker.exists)
    family = psutil.Process(process.pid).children(recursive=True)
    assert len(family) == 2
    os.killpg(process.pid, sent)
    assert process.communicate(timeout=30.0)[1] == ""
    assert process.returncode == status
    wait_until(lambda: not any(one.is_running() and one.status() != psutil.STATUS_ZOMBIE for one in family))
    wait_until(lambda: not list(temporary.iterdir()))
    assert not (tmp_path / "out").exists()


def wait_until(holds: object) -> None:
    deadline = time.monotonic() + 30.0
    while not holds():  # type: ignore[operator]
        assert time.monotonic() < deadline
        time.sleep(0.05)


def test_every_command_that_runs_fmus_has_a_time_limit() -> None:
    options = {
        command.callback.__name__: inspect.signature(command.callback).parameters
        for command in cli.app.registered_commands
        if command.callback
    }
    with_fmus = {name for name, known in options.items() if {"fmu", "files_", "whole"} & known.keys()}
    assert with_fmus == {*"run crosscheck couple optimise sensitivity sweep paper reference report".split()}
    assert {name for name, known in options.items() if "time_limit" in known} == with_fmus


COMMANDS = [
    ["run"],
    ["crosscheck", "a.fmu", "b.fmu"],
    ["couple"],
    ["optimise"],
    ["sweep", "sweep.toml", "--fmu", "F"],
]


@pytest.mark.parametrize("command", COMMANDS, ids=lambda command: command[0])
def test_a_time_limit_that_is_none(
    command: list[str], car_trailer_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("overrun_hitch.fmu.files.is_current", lambda _: True)
    Path("sweep.toml").write_text("grid = {C = [1.0, 2.0]}")
    assert cli.main([*[str(car_trailer_fmu) if word == "F" else word for word in command], "--time-limit", "0"]) == 2
    err = capsys.readouterr().err
    assert err.startswith("hitch: time_limit = 0 s is not allowed: time that a run may take must be a finite number, ")
    assert [path.name for path in tmp_path.iterdir()] == ["sweep.toml"]
