"""What tests of both halves share: the FMU under test, built once for a run of the tests."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

# Matrices here are tiny, and the tests keep every core busy by themselves. Read when numpy is imported, below.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from fmu_build.pipeline import build
from overrun_hitch.fmu.messages import listening

ROOT = Path(__file__).parents[1]
LIBRARY = ROOT / "modelica" / "OverrunHitch"


@pytest.fixture(autouse=True)
def a_receiver_of_messages_that_stays() -> Iterator[None]:
    """fmpy.simulate_fmu(logger=...) leaves one that is gone, and the next message in this process would crash it."""
    yield
    listening()


@pytest.fixture(scope="session")
def modelica_library() -> Path:
    return LIBRARY


@pytest.fixture(scope="session")
def car_trailer_fmus(tmp_path_factory: pytest.TempPathFactory) -> dict[int, Path]:
    """CarTrailer.fmu by version of FMI."""
    folder = tmp_path_factory.mktemp("fmu")
    fmus = {version: folder / f"fmi{version}" / "CarTrailer.fmu" for version in (2, 3)}
    for version, output in fmus.items():
        build(LIBRARY, "OverrunHitch.Systems.CarTrailer", output, version)
    return fmus


@pytest.fixture(scope="session")
def car_trailer_fmu(car_trailer_fmus: dict[int, Path]) -> Path:
    return car_trailer_fmus[2]


@pytest.fixture(scope="session")
def pair_fmus(tmp_path_factory: pytest.TempPathFactory) -> dict[int, dict[str, Path]]:
    """Car.fmu and Trailer.fmu by version of FMI and name."""
    folder = tmp_path_factory.mktemp("pair")
    fmus = {
        version: {name: folder / f"fmi{version}" / f"{name}.fmu" for name in ("Car", "Trailer")} for version in (2, 3)
    }
    for version, units in fmus.items():
        for name, output in units.items():
            build(LIBRARY, f"OverrunHitch.Systems.{name}", output, version)
    return fmus
