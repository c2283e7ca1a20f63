"""One file of parameters for all commands that take parameters; in a sweep what is varied goes before."""

from __future__ import annotations

from pathlib import Path

import pytest
import typer

from overrun_hitch import cli
from overrun_hitch.parameters import HitchError
from overrun_hitch.sweeps.plan import Plan

DEVICE = "[parameters]\nC = 300.0\nM_t = 750.0\n"
SPEC = """name = "two"
duration = 0.5
metrics = ["peak_jerk"]
grid = {C = [100.0, 200.0]}
parameters = {M_t = 400.0, k = 5e3}
"""


def test_who_takes_single_parameters_takes_a_file() -> None:
    commands = typer.main.get_command(cli.app).commands  # type: ignore[attr-defined]
    options = {name: {option for each in command.params for option in each.opts} for name, command in commands.items()}
    assert {name for name, taken in options.items() if "--set" in taken} == {
        name for name, taken in options.items() if "--parameters" in taken
    }
    assert all("--parameters" in options[name] for name in ("run", "sweep", "stability", "crosscheck"))


def test_in_a_sweep(car_trailer_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("device.toml").write_text(DEVICE, encoding="utf-8")
    Path("spec.toml").write_text(SPEC, encoding="utf-8")
    plans: list[Plan] = []

    def noted(plan: Plan, *_: object, **__: object) -> None:
        plans.append(plan)
        raise HitchError("as far as this goes")

    monkeypatch.setattr("overrun_hitch.sweeps.engine.run_plan", noted)
    command = ["sweep", "spec.toml", "--parameters", "device.toml", "--fmu", str(car_trailer_fmu), "--set", "V_0=30"]
    assert cli.main(command) == 2
    (plan,) = plans
    assert plan.columns["C"].tolist() == [100.0, 200.0]
    fixed = plan.job.fixed
    assert (fixed["M_t"], fixed["k"], fixed["V_0"], "C" in fixed) == (750.0, 5e3, 30.0, False)


def test_what_is_varied_is_not_set(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "spec.toml").write_text(SPEC, encoding="utf-8")
    assert cli.main(["sweep", str(tmp_path / "spec.toml"), "--set", "C=1"]) == 2
    assert "C stands in parameters or profiles and in grid.C; allowed: one of them" in capsys.readouterr().err
