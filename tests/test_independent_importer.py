"""fmuloader drives the units: an importer that shares no code with FMPy. What comes out is the same to the bit."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest

fmi2 = pytest.importorskip("fmuloader.fmi2", reason="fmuloader needs Python 3.11")
fmi3 = pytest.importorskip("fmuloader.fmi3")

OUTPUTS = ["v_car", "v_trailer", "a_car", "compression", "F_hitch", "slip_trailer"]
STEP, STEPS = 0.01, 200
BRAKE_TORQUE = 1000.0


@pytest.fixture(params=[2, 3])
def fmu(request: pytest.FixtureRequest, car_trailer_fmus: dict[int, Path]) -> tuple[int, Path, Any]:
    path = car_trailer_fmus[request.param]
    return request.param, path, fmpy.read_model_description(str(path))


def references(description: Any, names: list[str]) -> list[int]:
    table = {v.name: v.valueReference for v in description.modelVariables}
    return [table[name] for name in names]


def started(version: int, path: Path, description: Any) -> Any:
    """A Co-Simulation instance with the brake applied; without callbacks for memory, which FMI 2 may leave out."""
    if version == 2:
        unit = fmi2.Fmi2Slave(path, model_identifier="CarTrailer")
        unit.instantiate(
            "car",
            fmi2.Fmi2Type.CO_SIMULATION,
            guid=description.guid,
            cannot_use_memory_management_functions=True,
        )
        unit.set_real(references(description, ["brake_torque"]), [BRAKE_TORQUE])
        unit.setup_experiment(start_time=0.0, tolerance=1e-6)
        unit.enter_initialization_mode()
    else:
        unit = fmi3.Fmi3Slave(path, model_identifier="CarTrailer")
        unit.instantiate_co_simulation("car", instantiation_token=description.guid)
        unit.set_float64(references(description, ["brake_torque"]), [BRAKE_TORQUE])
        unit.enter_initialization_mode(start_time=0.0, tolerance=1e-6)
    unit.exit_initialization_mode()
    return unit


def read(unit: Any, description: Any) -> list[float]:
    get = unit.get_real if hasattr(unit, "get_real") else unit.get_float64
    return list(get(references(description, OUTPUTS)))


def test_the_same_bits_as_by_fmpy(fmu: tuple[int, Path, Any]) -> None:
    version, path, description = fmu
    expected = fmpy.simulate_fmu(
        str(path),
        stop_time=STEP * STEPS,
        output_interval=STEP,
        relative_tolerance=1e-6,
        start_values={"brake_torque": BRAKE_TORQUE},
        output=OUTPUTS,
        set_stop_time=False,
    )
    unit = started(version, path, description)
    rows = [read(unit, description)]
    for time, then in pairwise(expected["time"].tolist()):
        unit.do_step(time, then - time)
        rows.append(read(unit, description))
    unit.terminate()
    unit.free_instance()
    for name, column in zip(OUTPUTS, np.array(rows).T, strict=True):
        np.testing.assert_array_equal(column, expected[name])


def test_a_saved_state_is_gone_back_to(fmu: tuple[int, Path, Any]) -> None:
    version, path, description = fmu
    unit = started(version, path, description)
    unit.do_step(0.0, 0.5)
    saved = unit.get_fmu_state()
    data = unit.serialize_fmu_state(saved)
    unit.do_step(0.5, 0.5)
    first = read(unit, description)
    for state in (saved, unit.deserialize_fmu_state(data)):
        unit.set_fmu_state(state)
        unit.do_step(0.5, 0.5)
        assert read(unit, description) == first
        unit.free_fmu_state(state)
    unit.free_instance()


def test_directional_derivatives_are_those_of_fmpy(fmu: tuple[int, Path, Any]) -> None:
    version, path, description = fmu
    rate, state = references(description, ["der(car.body.v)", "drawbar.compression"])
    unit = started(version, path, description)
    unit.do_step(0.0, 0.3)
    (found,) = unit.get_directional_derivative([rate], [state], [1.0])
    unit.free_instance()
    assert 0.9 * 5.48 < found < 1.1 * 5.48  # k / M_c, 1/s2
