"""The wheel of `make dist`, installed where there is nothing: no clone, no compiler, no FMU."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import time
import zipfile
from pathlib import Path

import fmpy.validation
import pytest

ROOT = Path(__file__).parents[2]
README = ROOT / "README.md"
LIBRARIES = ("linux64/{}.so", "aarch64-linux/{}.so", "win64/{}.dll", "darwin64/{}.dylib")

BUILD = """
import fmpy, fmu_build
fmu = fmu_build.build("model Decay Real x(start=1, fixed=true); equation der(x) = -x; end Decay;")
print(fmpy.simulate_fmu(str(fmu), stop_time=1, output=["x"])["x"][-1].round(4))
"""

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


def python(minor: int) -> str:
    """An interpreter of Python 3.minor on this machine, by its usual names; skips the test where there is none."""
    kept = Path.home().joinpath(".pyenv", "versions").glob(f"3.{minor}.*/bin/python")
    for command in (sys.executable, f"python3.{minor}", *map(str, kept)):
        asked = [command, "-c", "import sys; print(sys.version_info[1])"]
        if shutil.which(command) and subprocess.run(asked, capture_output=True, text=True).stdout.strip() == str(minor):
            return command
    pytest.skip(f"no Python 3.{minor} here")


def megabytes(folder: Path) -> float:
    """Without what Python has compiled since."""
    return sum(file.lstat().st_size for file in folder.rglob("*") if file.parent.name != "__pycache__") / 1e6


@pytest.mark.parametrize("minor", [10, 11, 12, 13])
def test_installed_in_an_empty_environment_it_runs(wheel: Path, minor: int, tmp_path: Path) -> None:
    """The core at once, where commands find neither a compiler nor anything else on their path; [build] with one.

    Prints sizes and times (pytest -s).
    """
    environment, work = tmp_path / "env", tmp_path / "work"
    work.mkdir()
    here = environment / "bin"
    uv = Path(sys.executable).with_name("uv")

    def ran(*command: str | Path, path: str = str(work)) -> str:
        done = subprocess.run(
            command, cwd=work, env={"PATH": path, "HOME": str(tmp_path)}, capture_output=True, text=True, check=False
        )
        assert (done.returncode, done.stderr) == (0, ""), done.stderr + done.stdout
        return done.stdout

    def installed(what: str) -> str:
        begin = time.perf_counter()
        install = [uv, "pip", "install", "--quiet", "--python", here / "python", what]
        subprocess.run(install, check=True)
        return f"{megabytes(environment):.0f} MB, installed in {time.perf_counter() - begin:.0f} s"

    subprocess.run([uv, "venv", "--quiet", "--python", python(minor), environment], check=True)
    core = installed(str(wheel))
    shown = README.read_text(encoding="utf-8").partition("$ make run\n")[2].partition("...\n")[0].splitlines()
    assert [line.rstrip() for line in ran(here / "hitch", "run").splitlines()][: len(shown)] == shown
    assert sorted(file.name for file in (work / "build" / "run").iterdir()) == [
        f"figure-8.{kind}" for kind in ("csv", "png", "svg")
    ]
    (work / "README.md").write_text(README.read_text(encoding="utf-8").replace("```", "\n"), encoding="utf-8")
    ran(here / "python", "-m", "doctest", "-o", "NORMALIZE_WHITESPACE", "README.md")
    build = installed(f"{wheel}[build]")
    assert ran(here / "python", "-c", BUILD, path=os.defpath) == "0.3679\n"
    print(f"\nPython 3.{minor}: core {core}; with [build] {build}")
