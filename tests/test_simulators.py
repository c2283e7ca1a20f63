"""Hitch.fmu in simulators that others wrote: the examples run as they stand, and are as near as they say."""

from __future__ import annotations

import importlib.util
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.conftest import ROOT
from tests.sampling import sampled

SIMULATORS = {"mujoco_hitch": "mujoco", "exudyn_hitch": "exudyn"}  # example: module
Units = tuple[Path, Path]
AT_5_MS = {"STEPS = (0.001, 0.005)": "STEPS = (0.005,)"}
LATE = {"F_hitch_hold": "F_hitch", "trailer_brake_torque_hold": "trailer_brake_torque"}
IMPLICIT = {
    "settings.solution": "settings.timeIntegration.newton.numericalDifferentiation.forODE2Connectors = True\n"
    "    settings.solution",
    ", solverType=exu.DynamicSolverType.RK44": "",
}


@pytest.fixture(scope="module")
def units(hitch_fmu: Path, car_trailer_fmu: Path) -> Units:
    return hitch_fmu, car_trailer_fmu


def run(
    example: str, folder: Path, units: Units, changes: dict[str, str] | None = None
) -> subprocess.CompletedProcess[str]:
    """A copy of the example, with some of its text changed, on the units; skipped where the simulator is missing."""
    if importlib.util.find_spec(SIMULATORS[example]) is None:
        pytest.skip(f"{SIMULATORS[example]} is not installed: it has no wheel for this Python or machine")
    for file in (ROOT / "examples").glob(f"{example}.*"):
        shutil.copy(file, folder)
    script = folder / f"{example}.py"
    text = script.read_text(encoding="utf-8")
    for old, new in (changes or {}).items():
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    script.write_text(text, encoding="utf-8")
    command = [sys.executable, script, *units]
    without_film = {**os.environ, "MUJOCO_GL": "off"}  # it takes longer than the rest
    done = subprocess.run(command, cwd=folder, env=without_film, capture_output=True, text=True, timeout=120)
    print(done.stdout)
    return done


@pytest.mark.parametrize("example", sampled(SIMULATORS, ["mujoco_hitch"]))
def test_it_is_as_near_as_it_says(example: str, tmp_path: Path, units: Units) -> None:
    done = run(example, tmp_path, units)
    assert done.returncode == 0, done.stderr + done.stdout
    compression, frequency = map(float, re.findall(r"(\d+\.\d+)%", done.stdout))
    assert 0.0 < compression < 0.5 and 0.0 < frequency < 0.1
    figures = sorted(path.suffix for path in tmp_path.glob("build/*/hitch.*"))
    assert figures == ([".png", ".svg"] if example == "mujoco_hitch" else [])


@pytest.mark.full
@pytest.mark.parametrize("example", SIMULATORS)
def test_values_that_are_not_to_be_held_are_too_late(example: str, tmp_path: Path, units: Units) -> None:
    done = run(example, tmp_path, units, {**AT_5_MS, **LATE})
    assert done.returncode == 1 and "apart: " in done.stdout, done.stderr


@pytest.mark.full
def test_implicit_integration_is_too_late(tmp_path: Path, units: Units) -> None:
    done = run("exudyn_hitch", tmp_path, units, {**AT_5_MS, **IMPLICIT})
    assert done.returncode == 1 and "apart: " in done.stdout, done.stderr
