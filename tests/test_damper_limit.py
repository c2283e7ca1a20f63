"""F_pull_max: with 0 a drawbar that is pushed in never pulls; by default the damper always acts, as in the paper."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import fmpy
import numpy as np
import pytest
import rumoca
from fmpy.fmi2 import FMU2Model

from overrun_hitch.parameters import DATUM, Scenario
from overrun_hitch.results import VARIABLES
from tests.runs import step_brake

EPS = 0.1
COMPRESSIONS = [-0.02, -1e-6, 0.0, 1e-6, 0.05, EPS, EPS + 1e-6, 0.12, 0.3]  # m
RATES = np.linspace(-3.0, 3.0, 61)  # m/s: where the damper outweighs the spring, and where it does not

HitchForce = Callable[[float, float], float]


@pytest.fixture
def hitch_force(car_trailer_fmu: Path, tmp_path: Path) -> Iterator[Callable[[float], HitchForce]]:
    """F_hitch of (compression, its rate) under a limit: states put into the Model Exchange unit, events settled."""
    description = fmpy.read_model_description(str(car_trailer_fmu))
    references = {v.name: v.valueReference for v in description.modelVariables}
    states = [d.variable.derivative.name for d in description.derivatives]
    unit = FMU2Model(
        guid=description.guid,
        unzipDirectory=fmpy.extract(str(car_trailer_fmu), unzipdir=str(tmp_path)),
        modelIdentifier=description.modelExchange.modelIdentifier,
    )
    unit.instantiate()
    unit.setupExperiment()
    unit.enterInitializationMode()
    unit.exitInitializationMode()

    def settle() -> None:
        while unit.newDiscreteStates()[0]:
            pass

    def force(compression: float, rate: float) -> float:
        settle()
        unit.enterContinuousTimeMode()
        rolling = dict.fromkeys(states, 0.0) | {"car.wheel.omega": 57.0, "trailer.wheel.omega": 57.0}
        moving = rolling | {"drawbar.compression": compression, "car.body.v": 20.0, "trailer.body.v": 20.0 + rate}
        values = np.array([moving[name] for name in states])
        unit.setContinuousStates(values.ctypes.data_as(fmpy.fmi2.POINTER(fmpy.fmi2.fmi2Real)), values.size)
        unit.enterEventMode()
        settle()
        return float(unit.getReal([references["F_hitch"]])[0])

    def limited(limit: float) -> HitchForce:
        unit.setReal([references["eps"], references["F_pull_max"]], [EPS, limit])
        return force

    yield limited
    unit.freeInstance()


def unlimited(compression: float, rate: float) -> float:
    """Minus the paper's F_h in its three regimes."""
    spring = DATUM.k * max(compression - EPS, 0.0) + DATUM.k_t * min(compression, 0.0)
    return DATUM.C * rate + spring


def test_by_default_the_damper_always_acts(hitch_force: Callable[[float], HitchForce]) -> None:
    force = hitch_force(DATUM.F_pull_max)
    for compression in COMPRESSIONS:
        expected = [unlimited(compression, rate) for rate in RATES]
        np.testing.assert_allclose([force(compression, rate) for rate in RATES], expected, rtol=1e-12, atol=1e-9)
        if compression > 0.0:
            assert min(expected) < 0.0  # it pulls the car back, although the drawbar is pushed in


@pytest.mark.parametrize("limit", [0.0, 100.0])
def test_a_limited_damper_never_pulls_beyond_it(hitch_force: Callable[[float], HitchForce], limit: float) -> None:
    force = hitch_force(limit)
    for compression in COMPRESSIONS:
        forces = np.array([force(compression, rate) for rate in RATES])
        lowest = -limit if compression >= 0.0 else -np.inf
        highest = limit if compression <= EPS else np.inf
        expected = np.clip([unlimited(compression, rate) for rate in RATES], lowest, highest)
        np.testing.assert_allclose(forces, expected, rtol=1e-12, atol=1e-9)
        if limit == 0.0:
            assert (
                (forces >= 0.0).all()
                if compression > EPS
                else (forces <= 0.0).all()
                if compression < 0.0
                else not forces.any()
            )


# Released from 0.2 m, the drawbar springs out through the clearance, back from its stop, and in again.
RELEASED = Scenario(
    name="released",
    parameters=DATUM.changed({"C": 2000.0, "eps": 0.02, "compression_start": 0.2, "F_pull_max": 0.0}),
    brake_torque=200.0,
    duration=4.0,
)


SAME_IN_MODELICA = """
model Released
  OverrunHitch.Examples.Figure8 example(tau_c=200,
    combination(C=2000, eps=0.02, compression_start=0.2, F_pull_max=0));
end Released;
"""


def test_a_run_with_the_limit_agrees_with_another_tool(car_trailer_fmu: Path, modelica_library: Path) -> None:
    ours = step_brake(RELEASED, fmu=car_trailer_fmu, relative_tolerance=1e-10)
    model = rumoca.Session(roots=[str(modelica_library)]).loads(SAME_IN_MODELICA, model="Released")
    config = rumoca.SimConfig(solver="rk-like", rtol=1e-11, atol=1e-11, max_wall_seconds=60)
    theirs = model.simulate(t=(0, RELEASED.duration), dt=0.01, config=config)
    rows = [int(np.abs(np.asarray(theirs.time) - t).argmin()) for t in ours.time.values]  # it adds rows at its events
    for name in VARIABLES:
        distance = np.abs(ours[name].values - np.asarray(theirs[f"example.combination.{name}"])[rows]).max()
        print(f"{name}: {distance:.1e}")
        assert distance < 1e-7 * np.ptp(ours[name].values)


def test_the_limit_is_what_keeps_the_drawbar_from_pulling(car_trailer_fmu: Path) -> None:
    def lowest(limit: float) -> float:
        parameters = RELEASED.parameters.changed({"F_pull_max": limit})
        run = step_brake(RELEASED.changed(parameters=parameters), fmu=car_trailer_fmu)
        return float(run.F_hitch.values[run.compression.values > parameters.eps].min())

    assert lowest(0.0) == 0.0
    assert lowest(DATUM.F_pull_max) < -100.0
