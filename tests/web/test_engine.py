"""web/src/engine.ts, on the unit in WebAssembly, against this machine's library: the paper's figures."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from overrun_hitch.parameters import FIGURES
from overrun_hitch.results import VARIABLES
from tests.runs import step_brake
from tests.web.conftest import NodeRunner

pytestmark = [pytest.mark.full, pytest.mark.platforms]


def test_figures_6_to_11(run_node: NodeRunner, unit_folder: Path, car_trailer_fmu: Path, tmp_path: Path) -> None:
    """Driven by FMI 3 in Node, by FMI 2 in `hitch run`."""
    runs = []
    for figure, scenario in FIGURES.items():
        result = step_brake(scenario, fmu=car_trailer_fmu)
        runs.append(
            {
                "figure": figure,
                "values": {**scenario.parameters.model_dump(), "brake_torque": scenario.brake_torque},
                "traces": {name: result[name].values.tolist() for name in VARIABLES},
            }
        )
    (tmp_path / "runs.json").write_text(json.dumps(runs), encoding="utf-8")
    run_node("engine", UNIT=str(unit_folder), RUNS=str(tmp_path / "runs.json"))
