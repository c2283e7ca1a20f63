"""The same drivers with the FMU's own sources compiled for AddressSanitizer and UndefinedBehaviorSanitizer."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from fmu_build.fmu.compile import compile_library, host_platform
from tests.platforms.conftest import Program

SANITIZE = ("-fsanitize=address,undefined", "-fno-sanitize-recover=all", "-g", "-O1")


@pytest.fixture(scope="module")
def sanitized(
    sanitizers: None,
    car_trailer_fmu: Path,
    extracted: Callable[[Path], Path],
    tmp_path_factory: pytest.TempPathFactory,
) -> Path:
    library = tmp_path_factory.mktemp("sanitized") / "CarTrailer.so"
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("CFLAGS", " ".join(SANITIZE))
        compile_library(extracted(car_trailer_fmu) / "sources", library, host_platform())
    return library


@pytest.mark.full
@pytest.mark.parametrize("driver", ["step_brake", "illegal", "threads", "life_cycles"])
def test_the_sanitizers_have_nothing_to_say(
    driver: str, sanitized: Path, car_trailer_fmu: Path, program: Callable[..., Program]
) -> None:
    result = program(driver, options=SANITIZE).run(sanitized, car_trailer_fmu)
    assert (result.returncode, result.stderr) == (0, "")
