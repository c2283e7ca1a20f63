"""`python -m fmu_build --platforms`: progress, refusal, interruption."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from fmu_build.fmu.compile import zig_compiler

needs_zig = pytest.mark.skipif(zig_compiler() is None, reason="the package ziglang is not installed")


def start(library: Path, folder: Path, platforms: str) -> subprocess.Popen[str]:
    """The command, with temporary files in ``folder`` and its output in ``folder``/out."""
    (folder / "temporary").mkdir()
    command = [sys.executable, "-m", "fmu_build", str(library), "OverrunHitch.Systems.CarTrailer"]
    return subprocess.Popen(
        [*command, "-o", str(folder / "out" / "CarTrailer.fmu"), "--platforms", platforms],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "TMPDIR": str(folder / "temporary")},
    )


@pytest.mark.full
@needs_zig
@pytest.mark.skipif(os.name == "nt", reason="signals are sent otherwise on Windows")
def test_an_interrupted_build_leaves_nothing_behind(modelica_library: Path, tmp_path: Path) -> None:
    process = start(modelica_library, tmp_path, "x86_64-linux")
    assert process.stderr is not None
    assert process.stderr.readline() == "fmu_build: compiling for x86_64-linux\n"
    process.send_signal(signal.SIGINT)
    _, err = process.communicate()
    assert (process.returncode, err) == (130, "")
    assert list(tmp_path.iterdir()) == [tmp_path / "temporary"] and not list((tmp_path / "temporary").iterdir())


def test_an_unknown_platform_costs_one_line(modelica_library: Path, tmp_path: Path) -> None:
    process = start(modelica_library, tmp_path, "host,vax")
    out, err = process.communicate()
    assert (process.returncode, out, err.count("\n")) == (2, "", 1)
    assert "'vax'" in err and "x86_64-windows" in err and not (tmp_path / "out").exists()
