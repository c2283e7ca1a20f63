"""The wheel of `make dist`, installed where there is nothing: no clone, no compiler, no FMU."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy.validation
import pytest

ROOT = Path(__file__).parents[2]
LIBRARIES = ("linux64/{}.so", "aarch64-linux/{}.so", "win64/{}.dll", "darwin64/{}.dylib")

pytestmark = pytest.mark.platforms


@pytest.fixture(scope="module")
def wheel() -> Path:
    subprocess.run(["make", "dist", f"PYTHON={sys.executable}"], cwd=ROOT, check=True, capture_output=True)
    (wheel,) = (ROOT / "dist").glob("*.whl")
    return wheel


def test_it_brings_the_fmus_for_all_systems(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        for name in ("CarTrailer", "Car", "Trailer", "Hitch", "Bench"):
            assert f"overrun_hitch/fmus/fmi3/{name}.fmu" in archive.namelist()
            with archive.open(f"overrun_hitch/fmus/fmi2/{name}.fmu") as fmu, zipfile.ZipFile(fmu) as unit:
                assert {f"binaries/{file.format(name)}" for file in LIBRARIES} <= set(unit.namelist())


def test_fmpy_finds_nothing_in_the_fmus(wheel: Path, tmp_path: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tmp_path)
    fmus = sorted(tmp_path.rglob("*.fmu"))
    assert len(fmus) == 10
    assert {str(fmu): found for fmu in fmus if (found := fmpy.validation.validate_fmu(str(fmu)))} == {}


def test_installed_in_an_empty_environment_it_runs(wheel: Path, tmp_path: Path) -> None:
    """At once: the commands find neither a compiler nor anything else on their path."""
    subprocess.run([sys.executable, "-m", "venv", "env"], cwd=tmp_path, check=True)
    binaries = tmp_path / "env" / "bin"
    subprocess.run([binaries / "pip", "install", "--quiet", wheel], cwd=tmp_path, check=True)
    done = subprocess.run(
        [binaries / "hitch", "run"],
        cwd=tmp_path,
        env={"PATH": str(tmp_path), "HOME": str(tmp_path)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.count(" agrees") == 5
    assert sorted(file.name for file in (tmp_path / "build" / "run").iterdir()) == [
        f"figure-8.{kind}" for kind in ("csv", "png", "svg")
    ]
