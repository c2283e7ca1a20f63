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
from tests.kept import kept_fmus

SIMULATORS = {"mujoco_hitch": "mujoco"}  # example: module


@pytest.fixture(params=SIMULATORS)
def example(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """A copy of an example."""
    name = request.param
    if importlib.util.find_spec(SIMULATORS[name]) is None:
        pytest.skip(f"{SIMULATORS[name]} is not installed")
    for file in (ROOT / "examples").glob(f"{name}.*"):
        shutil.copy(file, tmp_path)
    return tmp_path / f"{name}.py"


def run(example: Path, car_trailer_fmu: Path) -> subprocess.CompletedProcess[str]:
    files = [kept_fmus("Systems.Hitch", fmi=2)["Hitch"], car_trailer_fmu]
    environment = {**os.environ, "MUJOCO_GL": "off"}  # a film takes longer than the rest
    done = subprocess.run(
        [sys.executable, example, *files],
        cwd=example.parent,
        env=environment,
        capture_output=True,
        text=True,
        timeout=120,
    )
    print(done.stdout)
    return done


def test_is_as_near_as_it_says(example: Path, car_trailer_fmu: Path) -> None:
    done = run(example, car_trailer_fmu)
    assert done.returncode == 0, done.stderr + done.stdout
    compression, frequency = map(float, re.findall(r"(\d+\.\d+)%", done.stdout))
    assert 0.0 < compression < 0.5 and 0.0 < frequency < 0.1
    assert len(list((example.parent / "build").glob("*/hitch.*"))) == 2


@pytest.mark.full
def test_sees_an_exchange_that_is_late(example: Path, car_trailer_fmu: Path) -> None:
    """What is not meant to be held is held for 5 ms."""
    text = example.read_text(encoding="utf-8")
    late = text.replace("_hold", "").replace("STEPS = (0.001, 0.005)", "STEPS = (0.005,)")
    assert text.count("_hold") == 2 and "(0.005,)" in late
    example.write_text(late, encoding="utf-8")
    assert run(example, car_trailer_fmu).returncode == 1
