"""The FMI 3 unit built from its sources and buildDescription.xml alone, by somebody else's generator for CMake."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import fmpy
import numpy as np
import pytest

from fmu_build.fmu.compile import HEADERS

needs_cmake = pytest.mark.skipif(shutil.which("cmake") is None, reason="cmake is not installed")


@pytest.mark.full
@needs_cmake
def test_the_build_description_is_enough(car_trailer_fmus: dict[int, Path], tmp_path: Path) -> None:
    unpacked = Path(fmpy.extract(str(car_trailer_fmus[3]), unzipdir=str(tmp_path / "unit")))
    library = next(unpacked.glob("binaries/*/CarTrailer.*"))
    library.unlink()
    generator = [sys.executable, "-m", "fmi_bd2cmake.cli"]
    subprocess.run([*generator], cwd=unpacked, check=True, stdout=subprocess.DEVNULL)
    options = [
        f"-DFMI_HEADERS_DIR={HEADERS / 'fmi3'}",
        "-DCMAKE_BUILD_TYPE=Release",
        "-DCMAKE_C_FLAGS=-ffp-contract=off",
    ]
    subprocess.run(["cmake", "-B", "build", *options, "."], cwd=unpacked, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", "build"], cwd=unpacked, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--install", "build"], cwd=unpacked, check=True, stdout=subprocess.DEVNULL)
    assert library.exists()
    run = {"stop_time": 2.0, "output_interval": 0.01, "start_values": {"brake_torque": 1000.0}}
    first, second = (fmpy.simulate_fmu(str(place), **run) for place in (car_trailer_fmus[3], unpacked))
    for name in first.dtype.names:
        np.testing.assert_array_equal(first[name], second[name])
