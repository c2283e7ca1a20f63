"""hitch reference: two solvers agree, SciPy's on equations by hand too, and the set can be used without us."""

from __future__ import annotations

import csv
import json
import zipfile
from io import StringIO
from pathlib import Path

import fmpy
import numpy as np
import pytest
from lxml import etree

from overrun_hitch import cli
from overrun_hitch.foreign.mapping import OURS, read_mapping
from overrun_hitch.parameters import FIGURES, Parameters
from overrun_hitch.reference import table
from overrun_hitch.reference.cases import REFERENCES
from overrun_hitch.reference.layered_standard import FOLDER, MANIFEST, with_references
from overrun_hitch.reference.trajectories import Trajectory, trajectory
from overrun_hitch.results import VARIABLES
from overrun_hitch.toml_file import read_toml
from tests.oracles import radau

SOME = ("figure-10", "stop-with-locked-wheels")


@pytest.fixture(scope="module")
def some(car_trailer_fmu: Path) -> dict[str, Trajectory]:
    return {name: trajectory(car_trailer_fmu, REFERENCES[name]) for name in SOME}


def test_the_set_is_what_is_told() -> None:
    assert list(REFERENCES)[:7] == [f"figure-{figure}" for figure in FIGURES]
    assert sum(name.startswith("stop") for name in REFERENCES) == 4
    assert sum(one.parameters.tau_b > 0.0 for one in REFERENCES.values()) == 1
    assert sum(one.parameters.F_f > 0.0 for one in REFERENCES.values()) == 1


def test_two_solvers_agree_and_stops_come_to_rest(some: dict[str, Trajectory]) -> None:
    for one in some.values():
        assert one.differing == []
        assert 0.0 < one.accuracy["compression"] < 1e-7
    assert abs(some["stop-with-locked-wheels"].run["v_car"].values[-1]) < 1e-6
    assert some["stop-with-locked-wheels"].run["slip_car"].values[100] == pytest.approx(1.0, abs=1e-6)  # at 1 s


def check_with_oracle(one: Trajectory) -> None:
    """The accuracy that is stated is no smaller than the distance from SciPy's solution of equations by hand."""
    solved = radau.trajectory(one.scenario.parameters, method="DOP853")
    for variable in VARIABLES:
        far = np.abs(one.run[variable].values - getattr(solved, variable)[::10]).max()
        assert far <= one.accuracy[variable] + 1e-9 * np.abs(one.run[variable].values).max(), variable


def test_a_figure_is_the_oracles(some: dict[str, Trajectory]) -> None:
    check_with_oracle(some["figure-10"])


@pytest.mark.full
@pytest.mark.parametrize("figure", [figure for figure in FIGURES if figure != "10"])
def test_the_other_figures_are_the_oracles(figure: str, car_trailer_fmu: Path) -> None:
    check_with_oracle(trajectory(car_trailer_fmu, REFERENCES[f"figure-{figure}"]))


def test_a_case_can_be_repeated_from_inside_the_fmu(
    some: dict[str, Trajectory], car_trailer_fmus: dict[int, Path], tmp_path: Path
) -> None:
    """By FMPy, with what the FMU brings and nothing of ours; what was there before is still there."""
    for version, fmu in car_trailer_fmus.items():
        content, made = with_references(fmu, some), tmp_path / f"{version}.fmu"
        assert content == with_references(fmu, some)
        made.write_bytes(content)
        with zipfile.ZipFile(made) as new, zipfile.ZipFile(fmu) as old:
            assert set(old.namelist()) < set(new.namelist()) and new.testzip() is None
            related = etree.fromstring(new.read(MANIFEST)).findall("Related")
            assert {FOLDER + one.get("source") for one in related} <= set(new.namelist())
            settings = etree.fromstring(new.read(f"{FOLDER}{SOME[0]}.ssv")).iter("{*}Parameter")
            values = {one.get("name"): float(one[0].get("value")) for one in settings}
            inputs, expected = (
                np.genfromtxt(StringIO(new.read(f"{FOLDER}{SOME[0]}_{what}.csv").decode()), delimiter=",", names=True)
                for what in ("in", "ref")
            )
        found = fmpy.simulate_fmu(
            str(made), start_values=values, input=inputs, stop_time=6.0, output_interval=0.01, relative_tolerance=1e-8
        )
        for name in VARIABLES:
            np.testing.assert_allclose(found[name], expected[name], atol=1e-6 * np.ptp(expected[name]))


def test_parameters_and_names_can_be_read_back(some: dict[str, Trajectory], tmp_path: Path) -> None:
    for name, one in some.items():
        (tmp_path / f"{name}.toml").write_bytes(table.parameters(one))
        assert Parameters(**read_toml(tmp_path / f"{name}.toml")) == one.scenario.parameters
    (tmp_path / "names.toml").write_bytes(table.mapping())
    mapping = read_mapping(tmp_path / "names.toml")
    assert {name: (theirs.name, theirs.unit, theirs.sign) for name, theirs in mapping.items()} == {
        name: (name, unit, 1.0) for name, unit in OURS.items()
    }


@pytest.mark.full
def test_the_command_writes_a_set_that_agrees_with_us(
    car_trailer_fmu: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    output = tmp_path / "set"
    assert cli.main(["reference", "--fmu", str(car_trailer_fmu), "--output", str(output)]) == 0
    out = capsys.readouterr().out
    index = json.loads((output / "reference.json").read_text(encoding="utf-8"))
    assert index["agrees"] and [case["case"] for case in index["cases"]] == list(REFERENCES)
    assert all(f"wrote {path}\n" in out and Path(path).is_file() for path in index["files"])
    for case in index["cases"]:
        trace, parameters = (output / f"{case['case']}.{suffix}" for suffix in ("csv", "toml"))
        with trace.open(encoding="utf-8", newline="") as file:
            assert next(csv.reader(file))[0] == "time [s]"
        torque = ["--brake-torque", str(case["brake_torque"]), "--output", str(tmp_path / "out")]
        command = ["crosscheck", str(car_trailer_fmu), str(trace), "--figure", "8", "--parameters", str(parameters)]
        assert cli.main([*command, *torque]) == 0
