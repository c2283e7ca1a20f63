"""The command line: exit status, one line for bad input, nothing half-written."""

from __future__ import annotations

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
import xarray as xr
from typer.testing import CliRunner

import overrun_hitch
from overrun_hitch import cli
from overrun_hitch.commands.options import assignments
from overrun_hitch.comparison import theory_table
from overrun_hitch.fmu import files as fmu
from overrun_hitch.measure.judged import Judged
from overrun_hitch.parameters import FIGURES, HitchError
from overrun_hitch.scenarios import asked_scenario

BAD = [
    (["--set", "Q=1"], "there is no parameter 'Q'; allowed: "),
    (["--set", "M_c=0"], "M_c = 0 kg is not allowed: mass of the car must be a finite number, at least 1 kg"),
    (["--set", "I_t=-1"], "I_t = "),
    (["--set", "R_c=0"], "R_c = "),
    (["--set", "V_0=0"], "V_0 = "),
    (["--set", "eps=-0.1"], "eps = "),
    (["--set", "k=-1"], "k = "),
    (["--set", "C=-1"], "C = "),
    (["--set", "C=nan"], "C = "),
    (["--set", "C=inf"], "C = "),
    (["--set", "C=two\nhundred"], "C = "),
    (["--set", "C"], "--set 'C' is not NAME=VALUE"),
    (["--figure", "12"], "there is no figure '12'; allowed: "),
    (["--case", "x"], "there is no case 'x'; did you mean ix? allowed: i, "),
    (["--figure", "8", "--case", "ii"], "figure and case exclude each other"),
    (["--profile", "a.csv", "--brake-torque", "5"], "profile and brake_torque exclude each other"),
    (["--duration", "0"], "duration = 0 s"),
    (["--duration", "inf"], "duration = inf s"),
    (["--duration", "soon"], "Invalid value for '--duration'"),
    (["--brake-torque", "-1"], "brake_torque = -1 N.m"),
    (["--tolerance", "0"], "relative_tolerance = 0 is not allowed"),
    (["--tolerance", "nan"], "relative_tolerance = nan is not allowed"),
    (["--step", "0"], "communication_step = 0 s"),
    (
        ["--step", "1e-6", "--duration", "100"],
        "communication_step = 1e-06 s is not allowed: a run of 100 s has steps from",
    ),
    (["--step", "10"], "communication_step = 10 s is not allowed: a run of 6 s has steps from 6e-06 to 6 s"),
    (
        ["--duration", "0.001"],
        "communication_step = 0.01 s is not allowed: a run of 0.001 s has steps from 1e-06 to 0.0",
    ),
    (["--nonsense"], "No such option"),
    (["surplus"], "unexpected extra argument"),
]


@pytest.mark.parametrize(("arguments", "message"), BAD)
def test_bad_input_is_one_line_and_status_2(
    arguments: list[str], message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    nothing = tmp_path / "none.fmu"
    status = cli.main(["run", "--fmu", str(nothing), "--output", str(tmp_path / "out"), *arguments])
    out, err = capsys.readouterr()
    assert status == 2
    assert out == ""
    assert err.count("\n") == 1
    assert message in err
    assert list(tmp_path.iterdir()) == []


def bad_fmus(folder: Path) -> dict[str, str]:
    """File: what the message must say."""
    (folder / "text.fmu").write_text("no archive")
    for name, entry in (("empty.fmu", "readme.txt"), ("broken.fmu", "modelDescription.xml")):
        with zipfile.ZipFile(folder / name, "w") as archive:
            archive.writestr(entry, "<nothing")
    return {
        "none.fmu": "is not there",
        "text.fmu": "an FMU is a zip archive",
        "empty.fmu": "it has no modelDescription.xml",
        "broken.fmu": "is broken: ",
    }


@pytest.mark.parametrize("name", ["none.fmu", "text.fmu", "empty.fmu", "broken.fmu"])
def test_a_bad_fmu_is_one_line_and_status_2(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    expected = bad_fmus(tmp_path)[name]
    status = cli.main(["run", "--fmu", str(tmp_path / name), "--output", str(tmp_path / "out")])
    err = capsys.readouterr().err
    assert status == 2
    assert err.count("\n") == 1
    assert name in err
    assert expected in err
    assert not (tmp_path / "out").exists()


def test_as_a_process_of_its_own(tmp_path: Path) -> None:
    source = str(Path(overrun_hitch.__file__).parents[1])
    done = subprocess.run(
        [sys.executable, "-m", "overrun_hitch", "run", "--set", "mass=1"],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": source},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.startswith("hitch: there is no parameter 'mass'; allowed: ")
    assert done.stderr.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_what_the_generator_says_is_passed_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A generator that stops as fmu_build does on Modelica that does not compile."""
    package = tmp_path / "fmu_build"
    package.mkdir()
    (package / "__init__.py").touch()
    (package / "__main__.py").write_text("import sys\nsys.exit('Tyre.mo:12: what is wrong')")
    monkeypatch.setattr(fmu, "ROOT", tmp_path)
    monkeypatch.setattr(fmu, "LIBRARY", tmp_path)
    with pytest.raises(HitchError, match=r"^Tyre\.mo:12: what is wrong$"):
        fmu.build(tmp_path / "CarTrailer.fmu")


def test_an_fmu_older_than_its_sources_is_not_current(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    unit, source = tmp_path / "unit.fmu", tmp_path / "modelica" / "Tyre.mo"
    source.parent.mkdir()
    source.touch()
    monkeypatch.setattr(fmu, "LIBRARY", source.parent)
    monkeypatch.setattr(fmu, "GENERATOR", source.parent)
    assert not fmu.is_current(unit)
    unit.touch()
    os.utime(source, (1.0, 1.0))
    assert fmu.is_current(unit)
    os.utime(unit, (0.5, 0.5))
    assert not fmu.is_current(unit)


def test_interrupted(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def interrupt(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("overrun_hitch.experiments.step_brake.brake", interrupt)
    assert cli.main(["run", "--fmu", "any.fmu", "--output", str(tmp_path / "out")]) == 130
    assert not (tmp_path / "out").exists()


def test_what_was_changed_is_in_the_name() -> None:
    assert asked_scenario(None, None, {}).name == "figure 8"
    changed = asked_scenario("6a", None, assignments(["C=200", " V_0 = 10 "]), duration=2.0, brake_torque=None)
    assert changed.name == "figure 6a, C=200, V_0=10, duration=2"
    assert changed.parameters == FIGURES["6a"].parameters.changed({"C": 200.0, "V_0": 10.0})


def test_version_and_help(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["--version"]) == 0
    assert capsys.readouterr().out.startswith("hitch")
    assert cli.main([]) == 0
    assert "run" in capsys.readouterr().out
    help_text = CliRunner().invoke(cli.app, ["run", "--help"])
    assert help_text.exit_code == 0
    for option in (
        "--figure",
        "--case",
        "--set",
        "--parameters",
        "--duration",
        "--brake-torque",
        "--tolerance",
        "--step",
        "--fmu",
        "--output",
    ):
        assert option in help_text.output


@pytest.mark.parametrize("width", ["40", "80"])
def test_piped_and_narrow_output_stays_readable(
    width: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:

    monkeypatch.setenv("COLUMNS", width)
    rows = [Judged("shunting frequency", "Hz", 1.63, 1.63, 1e-3), Judged("A / A_c", "1", 0.95, 0.9, 1e-3, "a reason")]
    result = xr.Dataset(coords={"time": [0.0, 6.0]}, attrs={"ended": "duration"})
    theory_table.show(FIGURES["8"], result, rows, [Path("build/run/" + "x" * 80)])
    out = capsys.readouterr().out
    assert "\x1b" not in out
    for words in ("shunting frequency", "agrees", "not judged: a reason", "wrote build/run/" + "x" * 80):
        assert words in out
