"""Runs made by the oracle instead of the FMU, in the package's own form."""

from __future__ import annotations

import pickle
import tempfile
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path

import pytest
import xarray as xr
from matplotlib.figure import Figure

from overrun_hitch.paper.figures.all import figures
from overrun_hitch.paper.study.study import Study, study
from overrun_hitch.parameters import Scenario
from overrun_hitch.results import VARIABLES, dataset, scenario_attributes
from tests.kept import ROOT, contents, digest, kept
from tests.oracles import radau

OracleRun = Callable[..., xr.Dataset]


@pytest.fixture(scope="session")
def oracle_run() -> OracleRun:
    """oracle_run(scenario, milliseconds=10): the result that a faultless FMU would give.

    By DOP853, which is five times as fast as Radau here and as good (test_oracle.py).
    """

    def run(scenario: Scenario, milliseconds: int = 10) -> xr.Dataset:
        solved = radau.trajectory(scenario.parameters, scenario.brake_torque, scenario.duration, "DOP853")
        columns = {name: getattr(solved, name)[::milliseconds] for name in VARIABLES}
        attributes = {**scenario_attributes(scenario), "ended": "duration"}
        return dataset(solved.time[::milliseconds], columns, attributes)

    return run


@pytest.fixture(scope="session")
def paper_study(car_trailer_fmu: Path) -> Study:
    """Everything recomputed: about ten seconds, once for all processes."""

    def make(folder: Path) -> None:
        (folder / "study").write_bytes(pickle.dumps(study(car_trailer_fmu)))

    code = digest(contents(ROOT / "python"))
    folder = kept(make, "study", digest([car_trailer_fmu.read_bytes()]), code, *map(version, ("pandas", "xarray")))
    return pickle.loads((folder / "study").read_bytes())


@pytest.fixture(scope="session")
def paper_figures(paper_study: Study) -> dict[str, Figure]:
    """The figures of that study, drawn once."""
    return figures(paper_study)


@pytest.fixture
def temporary(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where temporary folders are made, those of guests too."""
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    return folder
