"""The step brake on other processors and systems, by the same C driver as here."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from fmu_build.fmu.compile import PLATFORMS, host_platform
from tests.platforms.conftest import OUTPUTS, Program

pytestmark = pytest.mark.platforms


def library_in(folder: Path, fmi2_folder: str) -> Path:
    (library,) = (folder / "binaries" / fmi2_folder).iterdir()
    return library


@pytest.mark.parametrize("name", ["x86_64-linux", "aarch64-linux", "x86_64-windows"])
def test_the_step_brake_is_that_of_this_machine(
    name: str,
    everywhere_fmu: Path,
    car_trailer_fmu: Path,
    extracted: Callable[[Path], Path],
    program: Callable[..., Program],
) -> None:
    platform = PLATFORMS[name]
    there = program("step_brake", platform)
    result = there.run(library_in(extracted(everywhere_fmu), platform.fmi2_folder), everywhere_fmu)
    assert result.returncode == 0, result.stderr
    host = library_in(extracted(car_trailer_fmu), host_platform().fmi2_folder)
    expected = program("step_brake").run(host, car_trailer_fmu)
    assert expected.returncode == 0, expected.stderr
    here, other = (np.array([row.split() for row in r.stdout.splitlines()], float) for r in (expected, result))
    assert here.shape == (601, len(OUTPUTS))
    scale = np.abs(here).max(axis=0)
    worst = float((np.abs(other - here) / scale).max())
    print(f"{name}: {int((other == here).sum())} of {here.size} values bit-equal, largest difference {worst:.1e}")
    assert worst <= 1e-12
