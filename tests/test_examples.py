"""The examples run as they stand, and print what the direct coupling gives.

All step both units at once and hold the force, but `trailer_first`, which is Gauss-Seidel.
"""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from overrun_hitch.coupling.ssp import write_ssp
from tests.conftest import ROOT
from tests.test_container import toolbox_runs_here
from tests.test_container_pair import FORCES
from tests.test_simulators import SIMULATORS
from tests.unit import Unit

STEPS, H = 600, 0.01  # s; as the examples have it
PACKAGES = {"two_fmus": "fmpy", "ssp_package": "fmpy", "container": "fmpy", "ecos": "ecospy", "libcosim": "libcosimpy"}


@pytest.fixture(scope="module")
def ends(pair_fmus: dict[int, dict[str, Path]], tmp_path_factory: pytest.TempPathFactory) -> dict[bool, list[float]]:
    """v_car (m/s) and compression (m) after figure 8's brake, by Jacobi (False) and by Gauss-Seidel (True)."""
    found = {}
    for sequential, (output, applied) in FORCES.items():
        folder = tmp_path_factory.mktemp("direct")
        car, trailer = (Unit(pair_fmus[2][name], folder / name) for name in ("Car", "Trailer"))
        for unit in (car, trailer):
            unit.slave.instantiate()
        car.start(brake_torque=1000.0)
        trailer.start(applied_force=applied)
        for n in range(STEPS):
            force = trailer.get(output)[0]
            trailer.set(v_car=car.get("v_car")[0])
            trailer.slave.doStep(n * H, H)
            car.set(F_hitch=trailer.get(output)[0] if sequential else force)
            car.slave.doStep(n * H, H)
        found[sequential] = [car.get("v_car")[0], trailer.get("compression")[0]]
        for unit in (car, trailer):
            unit.slave.terminate()
            unit.slave.freeInstance()
    return found


def test_none_is_left_out() -> None:
    assert {path.stem for path in (ROOT / "examples").glob("*.py")} == {*PACKAGES, *SIMULATORS}


@pytest.mark.parametrize(
    "example", [pytest.param(name, marks=toolbox_runs_here if name == "container" else ()) for name in PACKAGES]
)
def test_example(
    pair_fmus: dict[int, dict[str, Path]], ends: dict[bool, list[float]], tmp_path: Path, example: str
) -> None:
    files = [pair_fmus[2]["Car"], pair_fmus[2]["Trailer"]]
    if example == "ssp_package":
        write_ssp(*files, tmp_path / "CarTrailer.ssp")
        files = [tmp_path / "CarTrailer.ssp"]
    command = [sys.executable, ROOT / "examples" / f"{example}.py", *files]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=120)
    package = PACKAGES[example]
    if done.returncode and re.search(rf"No module named '{package}'|lib\w+\.so[.\d]*: ", done.stderr):
        pytest.skip(f"{package} can't be used here: {done.stderr.strip().splitlines()[-1]}")
    assert done.returncode == 0, done.stderr
    assert "not connected" not in done.stdout + done.stderr
    lines = re.findall(r"^(\w+): v_car = (\S+) m/s, compression = (\S+) m$", done.stdout, re.MULTILINE)
    print(lines)
    assert len(lines) == (2 if example == "two_fmus" else 1)
    for name, *values in lines:
        expected = ends[name == "trailer_first"]
        assert [float(value) for value in values] == pytest.approx(expected, abs=1e-6), name
