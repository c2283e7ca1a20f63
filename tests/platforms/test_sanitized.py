"""The same drivers with the FMU's own sources compiled for AddressSanitizer and UndefinedBehaviorSanitizer."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from fmu_build.fmu.compile import OPTIONS, compiler
from tests.platforms.conftest import Program

SANITIZE = ("-fsanitize=address,undefined", "-fno-sanitize-recover=all", "-g", "-O1")


@pytest.fixture(scope="module")
def sanitized(
    car_trailer_fmu: Path, extracted: Callable[[Path], Path], tmp_path_factory: pytest.TempPathFactory
) -> Path:
    folder = tmp_path_factory.mktemp("sanitized")
    (folder / "probe.c").write_text("int main(void)\n{\n    return 0;\n}\n")
    probe = [*compiler(), *SANITIZE, str(folder / "probe.c"), "-o", str(folder / "probe")]
    if subprocess.run(probe, capture_output=True, check=False).returncode != 0:
        pytest.skip(f"{compiler()[0]} has no sanitizers")
    library = folder / "CarTrailer.so"
    sources = sorted((extracted(car_trailer_fmu) / "sources").glob("*.c"))
    options = [*OPTIONS, *SANITIZE, f"-I{sources[0].parent}"]
    subprocess.run([*compiler(), *options, *map(str, sources), "-o", str(library), "-lm"], check=True)
    return library


@pytest.mark.parametrize("driver", ["step_brake", "illegal", "threads", "life_cycles"])
def test_the_sanitizers_have_nothing_to_say(
    driver: str, sanitized: Path, car_trailer_fmu: Path, program: Callable[..., Program]
) -> None:
    result = program(driver, options=SANITIZE).run(sanitized, car_trailer_fmu)
    assert (result.returncode, result.stderr) == (0, "")
