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


OTHERS = ["x86_64-linux", "aarch64-linux", "x86_64-windows"]
HITCH = ("a_trailer", "F_hitch", "F_hitch_hold", "trailer_brake_torque_hold", "compression", "coupling_energy")


def differences(
    name: str, everywhere: Path, here: Path, extracted: Callable[[Path], Path], program: Callable[..., Program],
    names: tuple[str, ...],
) -> float:  # fmt: skip
    """The largest of what the program prints there and here, over the largest value of its column."""
    platform = PLATFORMS[name]
    result = program("step_brake", platform).run(
        library_in(extracted(everywhere), platform.fmi2_folder), everywhere, names
    )
    assert result.returncode == 0, result.stderr
    expected = program("step_brake").run(library_in(extracted(here), host_platform().fmi2_folder), here, names)
    assert expected.returncode == 0, expected.stderr
    ours, other = (np.array([row.split() for row in r.stdout.splitlines()], float) for r in (expected, result))
    assert ours.shape == (601, len(names) - 1)
    scale = np.abs(ours).max(axis=0)
    worst = float((np.abs(other - ours) / scale).max())
    print(f"{name}: {int((other == ours).sum())} of {ours.size} values bit-equal, largest difference {worst:.1e}")
    return worst


@pytest.mark.parametrize("name", OTHERS)
def test_the_step_brake_is_that_of_this_machine(
    name: str,
    everywhere_fmu: Path,
    car_trailer_fmu: Path,
    extracted: Callable[[Path], Path],
    program: Callable[..., Program],
) -> None:
    names = ("brake_torque", *OUTPUTS)
    assert differences(name, everywhere_fmu, car_trailer_fmu, extracted, program, names) <= 1e-12


@pytest.mark.parametrize("name", OTHERS)
def test_the_hitch_alone_too(
    name: str,
    everywhere_hitch: Path,
    hitch_fmu: Path,
    extracted: Callable[[Path], Path],
    program: Callable[..., Program],
) -> None:
    """Its coupling at work: the trailer, told to accelerate, has the speed that it had after each step."""
    assert differences(name, everywhere_hitch, hitch_fmu, extracted, program, HITCH) == 0.0
