"""What the longest step of a host in real time takes, told in right-hand sides, which depend on no machine.

Sixty seconds in steps of 1 ms, the torque set before each: ten times a pedal is pressed for 0.6 s, then to standstill.
The bounds are those that docs/integrate.md states; nothing in the unit enforces them.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.fmu_build.runtime.generated_models import generate
from tests.fmu_build.runtime.runtime_unit import OK, Library, Unit, compile_model

pytestmark = pytest.mark.full

DURATION, STEP = 60.0, 0.001  # s
MOST, MOST_OF_A_DEVICE = 80, 160  # right-hand sides of a step

DEVICES: dict[str, dict[str, float]] = {
    "ice": {"mu": 0.3, "F_f": 100.0},
    "lag": {"tau_b": 0.02, "F_f": 100.0, "mu": 0.8},
    "tyres that lag": {"sigma": 0.3, "mu": 0.8},
    "clearance": {"eps": 0.05},
    "as sold": {"eps": 0.01, "F_0": 100.0, "travel": 0.09, "rebound": 3.0, "F_f": 80.0, "tau_b": 0.03, "mu": 0.5},
}


@pytest.fixture(scope="module")
def car_trailer(modelica_library: Path) -> Library:
    return compile_model(generate(modelica_library, "OverrunHitch.Systems.CarTrailer"))  # type: ignore[arg-type]


def pedal(t: float) -> float:
    """N.m; it takes 0.1 s to press or release."""
    since, until = (t % 5.0, 0.6 - t % 5.0) if t < 50.0 else (t - 50.0, 1.0)
    return 1500.0 * max(0.0, min(1.0, 10.0 * min(since, until)))


def most_evaluations(library: Library, **parameters: float) -> int:
    """Of a step."""
    unit = Unit(library)
    try:
        assert unit.set(**parameters) == OK and unit.setup() == OK and unit.initialize() == OK
        most, before = 0, 0
        for i in range(round(DURATION / STEP)):
            assert unit.set(brake_torque=pedal(i * STEP)) == OK
            assert unit.step(STEP, i * STEP) == OK, unit.log
            evaluations = unit.counters().evaluations
            most, before = max(most, evaluations - before), evaluations
        print(f"{parameters}: {most} right-hand sides at most")
        return most
    finally:
        unit.free()


def test_a_step_is_bounded(car_trailer: Library) -> None:
    assert most_evaluations(car_trailer) <= MOST


@pytest.mark.parametrize("device", DEVICES)
def test_a_step_of_any_device_is_bounded(car_trailer: Library, device: str) -> None:
    assert most_evaluations(car_trailer, **DEVICES[device]) <= MOST_OF_A_DEVICE
