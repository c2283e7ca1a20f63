"""Six seconds of CarTrailer by any communication steps: errors, internal steps and events against the Radau oracle.

The generated C and the runtime, as in the FMU, with a window to the runtime's counters; the tolerance is the default.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from numpy.random import default_rng
from numpy.typing import NDArray

from overrun_hitch.parameters import FIGURES, Parameters
from tests.fmu_build.runtime.generated_models import generate
from tests.fmu_build.runtime.runtime_unit import OK, Counters, Library, Unit, compile_model
from tests.oracles import radau

Floats = NDArray[np.float64]

DURATION = 6.0
EQUAL_STEPS = {"0.1 ms": 60_000, "0.3 ms": 20_000, "1 ms": 6_000, "10 ms": 600, "1/60 s": 360, "100 ms": 60}
SEEDS = (1, 2, 3, 4)
NAMES = ("compression", "v_car", "v_trailer")

# A step's error in a state may be TOLERANCE * (its nominal value + its value), by the estimate of the step control.
TOLERANCE = 1e-6
NOMINAL = np.array([0.1, 1.0, 1.0])  # m, m/s, m/s; of the states drawbar.compression, car.body.v, trailer.body.v


@dataclass(frozen=True)
class Run:
    """What six seconds came to. `error` and `allowed`, in one step, are of compression (m) and of speed (m/s)."""

    name: str
    count: int  # of communication steps
    error: Floats
    allowed: Floats
    counters: Counters
    located: Floats  # s, when some relation changed, each instant once; not those at the start


def tries(counters: Counters) -> int:
    return counters.steps + counters.rejected + counters.repeated


def communication_points() -> Iterator[tuple[str, Floats]]:
    for name, count in EQUAL_STEPS.items():
        yield name, np.linspace(0.0, DURATION, count + 1)
    for seed in SEEDS:
        steps = np.exp(default_rng(seed).uniform(np.log(1e-4), np.log(1e-1), 5000))
        inner: Floats = np.cumsum(steps)
        yield f"random {seed}", np.concatenate([[0.0], inner[inner < DURATION], [DURATION]])


def looked_at(points: Floats) -> NDArray[np.intp]:
    """The first point in every millisecond: reading takes longer than a step."""
    return np.unique(np.floor(points * 1000.0 + 1e-6), return_index=True)[1]


@pytest.fixture(scope="module")
def car_trailer(modelica_library: Path) -> Library:
    """Not by the fixture `library`, which keeps libraries by name: a hand-written model has the same name."""
    model = generate(modelica_library, "OverrunHitch.Systems.CarTrailer")
    return compile_model(model)  # type: ignore[arg-type]


def drive(library: Library, parameters: Parameters, points: Floats) -> tuple[Floats, Counters, Floats]:
    """Rows of NAMES at the points looked at, the counters, and when relations changed."""
    unit = Unit(library, logging=True)
    try:
        assert unit.setup() == OK
        assert unit.set(brake_torque=1000.0, **parameters.model_dump()) == OK
        assert unit.initialize() == OK
        look = np.zeros(len(points), dtype=bool)
        look[looked_at(points)] = True
        rows = [unit.get(*NAMES)]
        for n in range(1, len(points)):
            assert unit.step(points[n] - points[n - 1], points[n - 1]) == OK, unit.log
            if look[n]:
                rows.append(unit.get(*NAMES))
        times = np.unique([time for _, time in unit.event_times()])
        return np.array(rows), unit.counters(), times[times > 0.0]
    finally:
        unit.free()


def compare(library: Library, figure: str) -> tuple[list[Run], radau.Trajectory]:
    parameters = FIGURES[figure].parameters
    cases = dict(communication_points())
    times = np.unique(np.concatenate([points[looked_at(points)] for points in cases.values()]))
    oracle = radau.solve(parameters, 1000.0, times)
    exact = np.column_stack([getattr(oracle, name) for name in NAMES])
    allowed = TOLERANCE * (NOMINAL + np.abs(exact).max(axis=0))
    runs = []
    for name, points in cases.items():
        rows, counters, located = drive(library, parameters, points)
        error = np.abs(rows - exact[np.searchsorted(times, points[looked_at(points)])]).max(axis=0)
        worst, limits = (np.array([of[0], of[1:].max()]) for of in (error, allowed))
        runs.append(Run(name, len(points) - 1, worst, limits, counters, located))
    return runs, oracle


def table(figure: str, runs: list[Run], free: Counters, oracle: radau.Trajectory) -> str:
    lines = [
        f"figure {figure}: {len(oracle.events)} events by the oracle; a step may err by {runs[0].allowed[0]:.1e} m "
        f"and {runs[0].allowed[1]:.1e} m/s; without communication points {free.steps} steps, {free.rejected} rejected",
        "H        | communication | internal | rejected | repeated | located | counted | m off   | m/s off",
    ]
    for run in runs:
        c = run.counters
        lines.append(
            f"{run.name:8} | {run.count:13} | {c.steps:8} | {c.rejected:8} | {c.repeated:8} | {len(run.located):7} | "
            f"{c.events:7} | {run.error[0]:.1e} | {run.error[1]:.1e}"
        )
    return "\n".join(lines)


@pytest.mark.full
@pytest.mark.parametrize("figure", ["6a", "8", "10"])
def test_error_steps_and_events_for_any_communication_steps(car_trailer: Library, figure: str) -> None:
    """Figures with many events, with none, and with clearance: the error is flat, and so is the number of steps.

    While nothing is set, communication points lie on the course of integrator steps and do not end them.
    """
    runs, oracle = compare(car_trailer, figure)
    _, free, _ = drive(car_trailer, FIGURES[figure].parameters, np.array([0.0, DURATION]))
    print(table(figure, runs, free, oracle))
    coarse = runs[list(EQUAL_STEPS).index("100 ms")]
    events = np.array(oracle.events)
    for run in runs:
        # The 100 to 250 steps that the control chooses freely add up to less than twenty times what one may err by,
        # even where the motion of figure 6a builds up: at most to ten times, for 80 sequences of steps of all sizes.
        assert np.all(run.error < 20.0 * run.allowed), run
        # No sequence is much better or worse than another.
        assert np.all(run.error < 2.0 * coarse.error) and np.all(run.error > 0.5 * coarse.error), run
        # What the oracle passes through is found, each once, and nothing else is. (An error in compression moves it.)
        assert len(run.located) == len(events), run
        np.testing.assert_allclose(run.located, events, rtol=0.0, atol=1e-5)
        # Counted are more: leaving a surface on which the run starts (no clearance), or on which an event has been
        # located to the last bit, is one more at the same instant.
        assert len(events) <= run.counters.events <= 2 * len(events) + 1, run
        # Communication points cost no steps, but for the first.
        assert abs(tries(run.counters) - tries(free)) <= 0.05 * tries(free) + 5, run
