"""What tests of both halves share: the FMU under test, built once for a run of the tests."""

from __future__ import annotations

from pathlib import Path

import pytest

from fmu_build.pipeline import build

ROOT = Path(__file__).parents[1]
LIBRARY = ROOT / "modelica" / "OverrunHitch"


@pytest.fixture(scope="session")
def modelica_library() -> Path:
    return LIBRARY


@pytest.fixture(scope="session")
def car_trailer_fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    output = tmp_path_factory.mktemp("fmu") / "CarTrailer.fmu"
    build(LIBRARY, "OverrunHitch.Systems.CarTrailer", output)
    return output
