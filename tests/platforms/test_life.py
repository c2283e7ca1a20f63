"""Many instances, one after another and side by side."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from fmu_build.fmu.compile import host_platform
from tests.platforms.conftest import Program

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the drivers are for Linux")


@pytest.fixture
def library(car_trailer_fmu: Path, extracted: Callable[[Path], Path]) -> Path:
    (library,) = (extracted(car_trailer_fmu) / "binaries" / host_platform().fmi2_folder).iterdir()
    return library


def test_memory_stays_flat_over_ten_thousand_life_cycles(
    library: Path, car_trailer_fmu: Path, program: Callable[..., Program]
) -> None:
    result = program("life_cycles").run(library, car_trailer_fmu)
    assert result.returncode == 0, result.stderr
    print(f"growth over 9000 life cycles: {int(result.stdout)} bytes")
    assert int(result.stdout) <= 65536  # one instance, leaked each time, would be some 10 MB


def test_eight_threads_give_what_one_gives(
    library: Path, car_trailer_fmu: Path, program: Callable[..., Program]
) -> None:
    result = program("threads").run(library, car_trailer_fmu)
    assert (result.returncode, result.stdout) == (0, "0 runs failed or differ\n"), result.stderr


def test_what_is_illegal_is_refused(library: Path, car_trailer_fmu: Path, program: Callable[..., Program]) -> None:
    result = program("illegal").run(library, car_trailer_fmu)
    assert result.returncode == 0, result.stderr
