"""A small model, how long it runs, and what should come out: run in all four ways."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import fmpy
import numpy as np
import rumoca
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from tests.fmu_build.conftest import Build

Columns = Mapping[str, NDArray[np.float64]]


@dataclass(frozen=True)
class Case:
    """The last class of a text, how long it runs, and what should come out; None: what rumoca's simulation says."""

    text: str
    stop: float
    expected: Callable[[NDArray[np.float64]], Columns] | None = None
    tolerance: float = 1e-6  # relative to the largest value
    cvode: float = 1e-9  # relative tolerance of fmpy's CVode, which makes at most 500 steps in one
    cvode_error: float = 0.0  # what that leaves, if it is more than the tolerance


def solution(names: str, rates: Callable[..., list[float]], start: list[float]) -> Callable[..., Columns]:
    """SciPy's solution of an initial value problem."""

    def at(times: NDArray[np.float64]) -> Columns:
        solved = solve_ivp(rates, (0, times[-1]), start, "Radau", times, rtol=1e-10, atol=1e-12)
        return dict(zip(names.split(), solved.y, strict=False))  # the first states suffice

    return at


def simulated_by_rumoca(path: Path, times: NDArray[np.float64]) -> Columns:
    model = rumoca.Session().load(str(path), model=path.stem)
    config = rumoca.SimConfig(solver="rk-like", rtol=1e-9, atol=1e-9, max_wall_seconds=60)
    result = model.simulate(t=(0.0, times[-1]), dt=times[1], config=config)
    rows = np.abs(np.asarray(result.time)[:, None] - times).argmin(axis=0)
    return {name: np.asarray(result[name])[rows] for name in result.names if not name.startswith("$")}


def check(case: Case, fmi: int, built: Build) -> None:
    """Build the model and compare, in Co-Simulation and in Model Exchange."""
    fmu = built(case.text, fmi)
    times = np.linspace(0, case.stop, 21)
    expected = case.expected(times) if case.expected else simulated_by_rumoca(fmu.with_suffix(".mo"), times)
    ways = (("CoSimulation", 1e-9, 0.0), ("ModelExchange", case.cvode, case.cvode_error))
    for kind, tolerance, error in ways:
        result = fmpy.simulate_fmu(
            str(fmu),
            stop_time=case.stop,
            output_interval=times[1] / 20,
            relative_tolerance=tolerance,
            fmi_type=kind,
            output=list(expected),
            record_events=False,
        )
        rows = np.abs(result["time"][:, None] - times).argmin(axis=0)
        for variable, values in expected.items():
            allowed = max(case.tolerance, error) * np.abs(values).max() + 1e-12
            np.testing.assert_allclose(result[variable][rows], values, rtol=0, atol=allowed, err_msg=variable)
