"""A brake torque that is set to a new value before every communication step: errors, costs and events.

It is held over the step, as a master without slopes does. The reference is the same at a tolerance of 1e-11.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from random import Random

import numpy as np
import pytest
from numpy.typing import NDArray

from overrun_hitch.parameters import FIGURES
from tests.fmu_build.runtime.generated_models import generate
from tests.fmu_build.runtime.runtime_unit import OK, Counters, Library, Unit, compile_model
from tests.sampling import spread

Floats = NDArray[np.float64]

DURATION = 6.0  # s
RIPPLE = 3.0  # rad/s
NAMES = ("compression", "v_car", "v_trailer")


@dataclass(frozen=True)
class Run:
    """Rows of compression (m) and speeds (m/s) at the communication points, and when relations changed (s)."""

    rows: Floats
    counters: Counters
    located: Floats


@pytest.fixture(scope="module")
def car_trailer(modelica_library: Path) -> Library:
    return compile_model(generate(modelica_library, "OverrunHitch.Systems.CarTrailer"))  # type: ignore[arg-type]


def drive(
    library: Library, figure: str, amplitude: float, step: float, tolerance: float = 1e-6, **parameters: float
) -> Run:
    unit = Unit(library, logging=True)
    try:
        assert unit.setup(tolerance) == OK
        assert unit.set(brake_torque=1000.0, **FIGURES[figure].parameters.model_dump() | parameters) == OK
        assert unit.initialize() == OK
        rows = []
        for i in range(round(DURATION / step)):
            assert unit.set(brake_torque=1000.0 + amplitude * np.sin(RIPPLE * i * step)) == OK
            assert unit.step(step, i * step) == OK, unit.log
            rows.append(unit.get(*NAMES))
        times = np.unique([time for _, time in unit.event_times()])
        return Run(np.array(rows), unit.counters(), times[times > 0.0])
    finally:
        unit.free()


def off(one: Run, other: Run) -> Floats:
    """The largest distances of the compressions and of the speeds."""
    distances = np.abs(one.rows - other.rows).max(axis=0)
    return np.array([distances[0], distances[1:].max()])


@pytest.mark.parametrize(("amplitude", "step"), spread([3.0, 10.0, 200.0], [0.001, 0.003, 0.01, 0.03]))
def test_error_is_at_most_twice_that_of_a_constant_input(car_trailer: Library, amplitude: float, step: float) -> None:
    changing, constant = (
        off(*(drive(car_trailer, "8", ripple, step, tolerance) for tolerance in (1e-6, 1e-11)))
        for ripple in (amplitude, 0.0)
    )
    print(f"{amplitude} N.m, {1e3 * step} ms: {changing} m and m/s; constant: {constant}")
    assert np.all(changing < 2.0 * constant)


# The method for short steps looks last at 0.88 of a step. Here the trailer's wheel locks behind that: abs(omega), which
# is no relation and so no event, bends where neither a stage nor the estimate sees it.
UNSEEN = pytest.mark.xfail(strict=True, reason="a wheel that locks in the last eighth of a short step is seen late")


@pytest.mark.parametrize(
    ("amplitude", "step", "tolerance"),
    [
        (10.0, 0.001, 1e-6),
        pytest.param(200.0, 0.001, 1e-6, marks=pytest.mark.full),
        pytest.param(200.0, 0.003, 1e-6, marks=[pytest.mark.full, UNSEEN]),
        pytest.param(200.0, 0.003, 1e-8, marks=pytest.mark.full),
    ],
)
def test_error_where_the_jacobian_soon_changes(
    car_trailer: Library, amplitude: float, step: float, tolerance: float
) -> None:
    """Tyres that lag, near the limit of friction, brakes that lag: it shunts out of the drawbar's compression."""
    device = {"sigma": 0.2, "mu": 0.8, "tau_b": 0.02}
    changing, constant = (
        off(*(drive(car_trailer, "8", ripple, step, asked, **device) for asked in (tolerance, 1e-11)))
        for ripple in (amplitude, 0.0)
    )
    print(f"{amplitude} N.m: {changing} m and m/s; constant: {constant}")
    assert np.all(changing < 2.0 * constant)


@pytest.mark.parametrize("step", [0.001, 0.003, 0.01])
def test_right_hand_sides_of_a_step(car_trailer: Library, step: float) -> None:
    """Three are the brief method's. At the beginning it fails once or twice, and is tried again some 30 steps later."""
    counters = drive(car_trailer, "8", 3.0, step).counters
    print(counters)
    assert counters.evaluations < 3.0 * DURATION / step + 3 * 30 * 8
    assert step > 0.001 or counters.jacobians < counters.steps / 10  # one serves for up to sixteen


@pytest.mark.parametrize("step", [0.001, 0.01])
@pytest.mark.parametrize("figure", ["6a", "10"])
def test_events_are_those_of_the_reference(car_trailer: Library, figure: str, step: float) -> None:
    run, reference = (drive(car_trailer, figure, 30.0, step, tolerance) for tolerance in (1e-6, 1e-11))
    print(len(run.located), np.abs(run.located - reference.located).max(), run.counters)
    assert len(run.located) == len(reference.located) >= 5
    np.testing.assert_allclose(run.located, reference.located, rtol=0.0, atol=1e-5)


def test_reading_and_going_back_leave_no_trace(car_trailer: Library) -> None:
    """Of three units one is read wherever that may be done, and one makes each step twice, from its state as bytes."""
    units = [Unit(car_trailer) for _ in range(3)]
    plain, read, again = units
    random = Random(1)
    try:
        for unit in units:
            assert unit.set(**FIGURES["10"].parameters.model_dump()) == OK
            assert unit.setup() == OK and unit.initialize() == OK
        for i in range(400):
            values = {"brake_torque": random.uniform(900.0, 1100.0)} | ({"grade": 1e-4 * i} if i % 3 == 0 else {})
            for name, value in values.items():
                assert [unit.set(**{name: value}) for unit in units] == [OK, OK, OK]
                read.get(*random.sample(("a_car", "F_hitch", "brake_torque", "der(car.wheel.omega)"), 2))
            saved = again.save()
            status, loaded = again.deserialize(again.serialize(saved))
            assert status == OK and again.step(0.001, 0.001 * i) == OK and again.restore(loaded) == OK
            assert [unit.step(0.001, 0.001 * i) for unit in units] == [OK, OK, OK]
            again.drop(saved)
            again.drop(loaded)
            assert plain.state() == read.state() == again.state()
    finally:
        for unit in units:
            unit.free()
