"""Small models with events, each built once for a run of the tests, and run in all four ways."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import fmpy
import numpy as np
import pytest

from tests.fmu_build.conftest import Build
from tests.sampling import sampled

WAYS = [(2, "CoSimulation"), (2, "ModelExchange"), (3, "CoSimulation"), (3, "ModelExchange")]


@dataclass
class Way:
    """One of the four ways to run a model."""

    built: Build
    fmi: int
    interface: str
    messages: list[str] = field(default_factory=list)

    def run(self, text: str, stop: float, step: float, outputs: list[str], **options: Any) -> np.ndarray:
        """The outputs every ``step``, at events those behind them.

        Options are ``tolerance`` (1e-10), ``start_values`` and others of FMPy's.
        """
        result = self.run_until_its_end(text, stop, step, outputs, **options)
        times = result["time"]
        rows = [np.flatnonzero(np.abs(times - time) < 1e-9)[-1] for time in np.arange(0.0, stop + step / 2, step)]
        return result[["time", *outputs]][rows]

    def run_until_its_end(self, text: str, stop: float, step: float, outputs: list[str], **options: Any) -> np.ndarray:
        """All rows that FMPy gives, up to where the model ends the simulation."""
        self.messages.clear()
        tolerance = options.pop("tolerance", 1e-10)
        return fmpy.simulate_fmu(
            str(self.built(text, self.fmi)),
            fmi_type=self.interface,
            stop_time=stop,
            output_interval=step,
            output=outputs,
            relative_tolerance=tolerance,
            debug_logging=True,
            logger=lambda *arguments: self.messages.append(_text(arguments[-1])),
            **options,
        )


def _text(message: bytes | str) -> str:
    return message.decode() if isinstance(message, bytes) else message


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Each model in all ways; `make test` runs every second test with FMI 2 alone, the others with FMI 3."""
    version = 2 + list(vars(metafunc.module)).index(metafunc.function.__name__) % 2
    if "way" in metafunc.fixturenames:
        ways = sampled(WAYS, [way for way in WAYS if way[0] == version])
        metafunc.parametrize("way", ways, ids=[f"fmi{fmi}-{interface}" for fmi, interface in WAYS], indirect=True)
    if "co_simulation" in metafunc.fixturenames:
        metafunc.parametrize("co_simulation", sampled([2, 3], [version]), ids=["fmi2", "fmi3"], indirect=True)


@pytest.fixture
def way(request: pytest.FixtureRequest, built: Build) -> Way:
    return Way(built, *request.param)


@pytest.fixture
def co_simulation(request: pytest.FixtureRequest, built: Build) -> Way:
    return Way(built, request.param, "CoSimulation")
