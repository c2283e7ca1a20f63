"""What tests of both halves share: the FMUs under test."""

from __future__ import annotations

import os
import signal
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import settings

# Matrices here are tiny, and the tests keep every core busy by themselves. Read when numpy is imported, below.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# Commands and tests that build the same share it, as users' do; what users have built has no part in it.
os.environ["FMU_BUILD_CACHE"] = str(Path(__file__).parents[1] / "build" / "test-cache" / "fmu_build")

from fmu_build.fmu.compile import compiler
from overrun_hitch.fmu.messages import listening
from tests.kept import LIBRARY, kept_fmus, prune

# How long an example takes is the machine's affair.
settings.register_profile("without deadline", deadline=None)
settings.load_profile("without deadline")

ROOT = Path(__file__).parents[1]


def pytest_sessionstart(session: pytest.Session) -> None:
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:  # as in a shell's background, and inherited by all we start
        signal.signal(signal.SIGINT, signal.default_int_handler)
    if not hasattr(session.config, "workerinput"):  # that is: once, before there are other processes
        prune()


@pytest.fixture(autouse=True)
def a_receiver_of_messages_that_stays() -> Iterator[None]:
    """fmpy.simulate_fmu(logger=...) leaves one that is gone, and the next message in this process would crash it."""
    yield
    listening()


@pytest.fixture(scope="session")
def modelica_library() -> Path:
    return LIBRARY


@pytest.fixture(scope="session")
def car_trailer_fmus() -> dict[int, Path]:
    """CarTrailer.fmu by version of FMI."""
    return {version: kept_fmus("Systems.CarTrailer", fmi=version)["CarTrailer"] for version in (2, 3)}


@pytest.fixture(scope="session")
def car_trailer_fmu() -> Path:
    return kept_fmus("Systems.CarTrailer", fmi=2)["CarTrailer"]


@pytest.fixture(scope="session")
def pair_fmus() -> dict[int, dict[str, Path]]:
    """Car.fmu and Trailer.fmu by version of FMI and name."""
    return {version: kept_fmus("Systems.Car", "Systems.Trailer", fmi=version) for version in (2, 3)}


@pytest.fixture(scope="session")
def hitch_fmu() -> Path:
    return kept_fmus("Systems.Hitch", fmi=2)["Hitch"]


@pytest.fixture(scope="session")
def sanitizers(tmp_path_factory: pytest.TempPathFactory) -> None:
    """Skips a test where the compiler has none."""
    source = tmp_path_factory.mktemp("sanitizers") / "empty.c"
    source.write_text("int main(void)\n{\n    return 0;\n}\n")
    command = [*compiler(), "-fsanitize=address,undefined", str(source), "-o", str(source.with_suffix(""))]
    if subprocess.run(command, capture_output=True, check=False).returncode != 0:
        pytest.skip(f"{compiler()[0]} has no sanitizers")
