"""The generator as it comes with a wheel, away from the clone: whatever it packs has come with it."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from tests.conftest import ROOT

MODEL = "model Falling\n  Real h(start=10, fixed=true);\n  Real v;\nequation\n  der(h) = v;\n  v = -1;\nend Falling;\n"


@pytest.mark.full
def test_it_builds_a_model(tmp_path: Path) -> None:
    clone = tmp_path / "clone"
    ignored = shutil.ignore_patterns("__pycache__", "fmus", "*.egg-info")
    for folder in ("fmu_build", "python"):
        shutil.copytree(ROOT / folder, clone / folder, ignore=ignored)
    for file in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / file, clone)
    build = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(tmp_path)]
    subprocess.run(build, cwd=clone, check=True, capture_output=True)
    (wheel,) = tmp_path.glob("*.whl")
    installed, elsewhere = tmp_path / "installed", tmp_path / "elsewhere"
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(installed)
    shutil.rmtree(clone)
    elsewhere.mkdir()
    (elsewhere / "Falling.mo").write_text(MODEL, encoding="utf-8")
    for fmi in ("2", "3"):
        command = [sys.executable, "-m", "fmu_build", "Falling.mo", "Falling", "-o", f"{fmi}.fmu", "--fmi", fmi]
        environment = {**os.environ, "PYTHONPATH": str(installed), "CFLAGS": "-O0"}
        done = subprocess.run(command, cwd=elsewhere, env=environment, capture_output=True, text=True, check=False)
        assert (done.returncode, done.stderr) == (0, "")
        with zipfile.ZipFile(elsewhere / f"{fmi}.fmu") as unit:
            assert "documentation/licenses/runtime.txt" in unit.namelist()
