"""web/src/engine.ts, on the unit in WebAssembly, against this machine's library: the paper's figures."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from fmu_build.fmu.compile import zig_compiler
from fmu_build.pipeline import build
from overrun_hitch.parameters import FIGURES
from overrun_hitch.results import VARIABLES
from tests.runs import step_brake
from tests.web.conftest import WEB

pytestmark = pytest.mark.platforms


def test_figures_6_to_11(
    run_node: Callable[..., None], modelica_library: Path, car_trailer_fmu: Path, tmp_path: Path
) -> None:
    """Driven by FMI 3 in Node, by FMI 2 in `hitch run`."""
    if zig_compiler() is None:
        pytest.skip("the package ziglang is not installed")
    fmu = tmp_path / "CarTrailer.fmu"
    build(modelica_library, "OverrunHitch.Systems.CarTrailer", fmu, 3, ("wasm",), references=False)
    subprocess.run([sys.executable, WEB / "unit.py", fmu, tmp_path], check=True)
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
    run_node("engine", UNIT=str(tmp_path))
