"""Small models with events, each built once for a run of the tests, and run in all four ways."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import fmpy
import numpy as np
import pytest

from tests.fmu_build.conftest import Build

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


@pytest.fixture(params=WAYS, ids=[f"fmi{fmi}-{interface}" for fmi, interface in WAYS])
def way(request: pytest.FixtureRequest, built: Build) -> Way:
    return Way(built, *request.param)


@pytest.fixture(params=[2, 3], ids=["fmi2", "fmi3"])
def co_simulation(request: pytest.FixtureRequest, built: Build) -> Way:
    return Way(built, request.param, "CoSimulation")
