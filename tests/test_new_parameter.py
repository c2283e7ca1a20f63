"""A new parameter takes the model and one line of parameters.py: in a copy of the project, every command knows it.

`g_new` multiplies the damper coefficient. Linear theory is told to hold at its default, 1, alone.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from overrun_hitch.parameters import Parameters

ROOT = Path(__file__).parents[1]
SYSTEMS = "modelica/OverrunHitch/Systems"
DECLARATIONS = "python/overrun_hitch/parameters.py"
MODELICA = '  parameter Real g_new(final unit="1", min=0) = 1 "Factor on the damper coefficient";\n'
PYTHON = '    g_new: float = quantity(1.0, "1", "factor on the damper coefficient", "trailer", "neutral", ge=0.0)\n'


def edited(file: Path, *changes: tuple[str, str]) -> None:
    """Make each change, pattern and replacement, where it fits exactly once."""
    text = file.read_text(encoding="utf-8")
    for pattern, replacement in changes:
        text, count = re.subn(pattern, replacement, text, flags=re.MULTILINE)
        assert count == 1, f"{pattern} fits {count} times in {file.name}"
    file.write_text(text, encoding="utf-8")


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of the project in which the parameter is declared: in the models that have it, and once in Python."""
    copy = tmp_path_factory.mktemp("project")
    ignored = shutil.ignore_patterns("__pycache__", "fmus")
    for folder in ("modelica", "fmu_build", "python"):
        shutil.copytree(ROOT / folder, copy / folder, ignore=ignored)
    for file in ("pyproject.toml", "LICENSE"):  # the generator packs the licence
        shutil.copy(ROOT / file, copy / file)
    for system in ("CarTrailer", "Trailer", "Hitch"):
        file = copy / SYSTEMS / f"{system}.mo"
        edited(file, (r"^(?=  parameter Units\.Length compression_start\b)", MODELICA), (r"\bC=C\b", "C=g_new*C"))
    edited(copy / DECLARATIONS, (r"^(?=    V_0: float = quantity\()", PYTHON))
    return copy


def hitch(project: Path, *arguments: str, status: int = 0) -> str:
    """What `hitch` of the copy prints, with a terminal wide enough for tables."""
    search = os.pathsep.join([str(project), str(project / "python")])
    done = subprocess.run(
        [sys.executable, "-m", "overrun_hitch", *arguments],
        cwd=project,
        env={**os.environ, "PYTHONPATH": search, "COLUMNS": "120", "CFLAGS": "-O0"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (status, ""), done.stderr
    return done.stdout


def compression(project: Path, stem: str) -> np.ndarray:
    return np.genfromtxt(project / "build" / "run" / f"{stem}.csv", delimiter=",", names=True)["compression_m"]


@pytest.mark.full
def test_a_run_at_the_default_agrees_with_theory(project: Path) -> None:
    said = hitch(project, "run")
    assert said.count("agrees") == 5 and "not judged" not in said


@pytest.mark.full
def test_a_run_off_the_default_is_not_judged(project: Path) -> None:
    said = hitch(project, "run", "--set", "g_new=0.2")
    assert said.count("not judged") == 6 and "not judged: g_new = 0.2 is beyond linear theory" in said
    hitch(project, "run", "--set", "C=100")
    assert compression(project, "figure-8-g_new=0.2") == pytest.approx(compression(project, "figure-8-C=100"), abs=1e-9)


def refusal(project: Path, *arguments: str) -> str:
    """What `hitch` says on stderr where it ends with status 2."""
    search = {**os.environ, "PYTHONPATH": f"{project}{os.pathsep}{project / 'python'}"}
    command = [sys.executable, "-m", "overrun_hitch", *arguments]
    done = subprocess.run(command, cwd=project, env=search, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    return done.stderr


@pytest.mark.full
def test_a_value_out_of_range_is_told_in_one_line(project: Path) -> None:
    said = refusal(project, "run", "--set", "g_new=-1")
    assert "g_new = -1 is not allowed: factor on the damper coefficient must be" in said


@pytest.mark.full
def test_a_sweep_goes_over_it(project: Path) -> None:
    (project / "spec.toml").write_text('name = "new"\nmetrics = ["growth_rate"]\ngrid = {g_new = [0.2, 1.0, 2.0]}\n')
    said = hitch(project, "sweep", "spec.toml", "--workers", "1")
    assert "new: 3 runs" in said and "failed" not in said
    least, median, greatest = (float(number) for number in re.findall(r"-\d\S+", said.partition("growth_rate")[2])[:3])
    assert least < median < greatest < 0.0


@pytest.mark.full
@pytest.mark.parametrize("command", ["stability", "optimise"])
def test_linear_theory_refuses_it_by_name(project: Path, command: str) -> None:
    assert refusal(project, command, "--set", "g_new=3") == "hitch: linear theory does not know g_new = 3; allowed: 1\n"


@pytest.mark.full
def test_the_pair_takes_it(project: Path) -> None:
    """Trailer and hitch damp as the model in one piece: with another value the growth rate would be 0.7 1/s off."""
    said = hitch(project, "couple", "--set", "g_new=0.5", "--set", "C=1000", "--H", "0.01")
    for scheme in ("jacobi-hold", "alone-hold"):
        (error,) = re.findall(rf"^{scheme} +(\S+) *$", said, re.MULTILINE)
        assert abs(float(error)) < 3e-3


def test_no_other_place_names_a_parameter_for_its_role() -> None:
    """Outside of parameters.py no tuple, list or set in the package lists three parameters or more by name."""
    lists = {
        str(path.relative_to(ROOT)): found
        for path in (ROOT / "python" / "overrun_hitch").rglob("*.py")
        if path != ROOT / DECLARATIONS
        for found in re.findall(r'[(\[{]\s*((?:"\w+",\s*){2,}"\w+")', path.read_text(encoding="utf-8"))
        if set(re.findall(r"\w+", found)) <= {*Parameters.model_fields}
    }
    assert lists == {}
