"""What FMPy's simulation does not do: states saved and restored, event mode step by step, inputs that are no Reals."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Model, FMU2Slave
from fmpy.fmi3 import FMU3Model, FMU3Slave

from tests.fmu_build.models.discrete.conftest import Build, Way
from tests.fmu_build.models.discrete.test_closed_forms import BALL, SAMPLED_PI, bounce_times

CLASSES: dict[tuple[int, str], Any] = {
    (2, "CoSimulation"): FMU2Slave,
    (2, "ModelExchange"): FMU2Model,
    (3, "CoSimulation"): FMU3Slave,
    (3, "ModelExchange"): FMU3Model,
}


@contextmanager
def instance(fmu: Path, fmi: int, interface: str, **options: Any) -> Iterator[tuple[Any, dict[str, int]]]:
    """A unit, instantiated, and the value references by name."""
    description = fmpy.read_model_description(str(fmu))
    folder = fmpy.extract(str(fmu))
    part = description.coSimulation if interface == "CoSimulation" else description.modelExchange
    unit = CLASSES[fmi, interface](
        guid=description.guid, unzipDirectory=folder, modelIdentifier=part.modelIdentifier, instanceName="unit"
    )
    unit.instantiate(**options)
    try:
        yield unit, {v.name: v.valueReference for v in description.modelVariables}
    finally:
        unit.freeInstance()
        shutil.rmtree(folder)


def start(unit: Any, fmi: int) -> None:
    if fmi == 2:
        unit.setupExperiment(startTime=0.0)
    unit.enterInitializationMode()
    unit.exitInitializationMode()


def real(unit: Any, references: list[int]) -> list[float]:
    get = unit.getReal if hasattr(unit, "getReal") else unit.getFloat64
    return list(get(references))


@pytest.mark.parametrize("text", [BALL, SAMPLED_PI], ids=["ball", "sampled"])
def test_a_restored_state_goes_on_bit_by_bit(built: Build, co_simulation: Way, text: str) -> None:
    names = {BALL: ["h", "v", "last"], SAMPLED_PI: ["x", "u"]}[text]
    fmi = co_simulation.fmi

    def go_on(unit: Any, at: dict[str, int]) -> list[list[float]]:
        rows = []
        for i in range(5, 40):
            unit.doStep(currentCommunicationPoint=i * 0.07, communicationStepSize=0.07)
            rows.append(real(unit, [at[name] for name in names]))
        return rows

    save, load = ("getFMUstate", "setFMUstate") if fmi == 2 else ("getFMUState", "setFMUState")
    write, read = (
        ("serializeFMUstate", "deSerializeFMUstate") if fmi == 2 else ("serializeFMUState", "deserializeFMUState")
    )
    with instance(built(text, fmi), fmi, "CoSimulation") as (unit, at):
        start(unit, fmi)
        for i in range(5):
            unit.doStep(currentCommunicationPoint=i * 0.07, communicationStepSize=0.07)
        state = getattr(unit, save)()
        bytes_ = getattr(unit, write)(state)
        first = go_on(unit, at)
        getattr(unit, load)(state)
        assert go_on(unit, at) == first
    with instance(built(text, fmi), fmi, "CoSimulation") as (unit, at):
        getattr(unit, load)(getattr(unit, read)(bytes_))
        assert go_on(unit, at) == first


def test_co_simulation_with_event_mode_agrees(built: Build) -> None:
    names = ["x", "u"]
    fmu = str(built(SAMPLED_PI, 3))
    options = {"output": names, "stop_time": 1.0, "output_interval": 0.02, "relative_tolerance": 1e-10}
    plain = fmpy.simulate_fmu(fmu, **options)
    by_hand = fmpy.simulate_fmu(fmu, use_event_mode=True, early_return_allowed=True, **options)
    for row in plain:
        same = by_hand[np.flatnonzero(np.abs(by_hand["time"] - row["time"]) < 1e-9)[-1]]
        assert [same[name] for name in names] == pytest.approx([row[name] for name in names], abs=1e-9)


def test_an_event_is_handled_when_the_caller_says_so(built: Build) -> None:
    options = {"eventModeUsed": True, "earlyReturnAllowed": True}
    with instance(built(BALL, 3), 3, "CoSimulation", **options) as (unit, at):
        start(unit, 3)
        unit.updateDiscreteStates()
        unit.enterStepMode()
        event, _, early, time = unit.doStep(currentCommunicationPoint=0.0, communicationStepSize=1.0)
        assert event and early and time == pytest.approx(bounce_times(1)[0], abs=1e-7)
        speed = real(unit, [at["v"]])[0]
        assert speed == pytest.approx(-9.81 * time, rel=1e-7) and unit.getInt32([at["bounces"]]) == [0]
        unit.enterEventMode()
        assert unit.getInt32([at["bounces"]]) == [1]  # what it will be, with the values before as they are
        assert real(unit, [at["v"]])[0] == speed
        more, ends, _, states_changed, _, _ = unit.updateDiscreteStates()
        assert (more, ends, states_changed) == (False, False, True)
        assert real(unit, [at["v"]])[0] == -0.8 * speed
        unit.enterStepMode()


@pytest.mark.parametrize("fmi", [2, 3])
def test_times_of_ticks_are_announced_in_model_exchange(built: Build, fmi: int) -> None:
    with instance(built(SAMPLED_PI, fmi), fmi, "ModelExchange") as (unit, at):
        start(unit, fmi)
        for tick in range(1, 30):
            next_time = announced(unit, fmi)
            assert next_time == tick * 0.05
            unit.enterContinuousTimeMode()
            unit.setTime(next_time)
            unit.enterEventMode()
        assert real(unit, [at["u"]])[0] != 0.0


def announced(unit: Any, fmi: int) -> float:
    if fmi == 2:
        more, _, _, _, is_defined, time = unit.newDiscreteStates()
    else:
        more, _, _, _, is_defined, time = unit.updateDiscreteStates()
    assert is_defined and not more
    return float(time)


GATE = """
model Gate "Inputs and parameters of all types"
  type Kind = enumeration(none, small, large);
  input Boolean open(start=false);
  input Integer level(start=2);
  input Kind kind(start=Kind.small);
  parameter Boolean inverse = false;
  parameter Integer offset(min=0, max=9) = 1;
  output Boolean through;
  output Integer sum;
  output Integer rises(start=0, fixed=true);
  output Real x(start=0, fixed=true);
equation
  through = open <> inverse;
  sum = (if through then level else 0) + offset;
  when open then
    rises = pre(rises) + 1;
  end when;
  der(x) = if kind == Kind.large then sum else 0;
end Gate;
"""


@pytest.mark.parametrize("fmi", [2, 3])
def test_inputs_of_all_types(built: Build, fmi: int) -> None:
    with instance(built(GATE, fmi), fmi, "CoSimulation") as (unit, at):

        def get(name: str) -> int:
            if name == "through":
                return int(unit.getBoolean([at[name]])[0])
            return int((unit.getInteger if fmi == 2 else unit.getInt32)([at[name]])[0])

        set_kind = unit.setInteger if fmi == 2 else unit.setInt64
        set_integer = unit.setInteger if fmi == 2 else unit.setInt32
        start(unit, fmi)
        assert [get(name) for name in ("through", "sum", "rises")] == [0, 1, 0]
        unit.setBoolean([at["open"]], [True])
        assert [get(name) for name in ("through", "sum", "rises")] == [1, 3, 1]
        set_kind([at["kind"]], [3])
        set_integer([at["level"]], [5])
        unit.doStep(currentCommunicationPoint=0.0, communicationStepSize=0.5)
        assert real(unit, [at["x"]]) == pytest.approx([3.0], abs=1e-12)
        unit.setBoolean([at["open"]], [False])
        unit.setBoolean([at["inverse"]], [True])
        assert [get(name) for name in ("through", "sum", "rises")] == [1, 6, 1]
        with pytest.raises(FMICallException):
            set_integer([at["offset"]], [10])
        with pytest.raises(FMICallException):
            real(unit, [at["sum"]])


def test_types_in_the_description(built: Build) -> None:
    expected = {
        2: {"open": "Boolean", "level": "Integer", "kind": "Enumeration", "sum": "Integer", "x": "Real"},
        3: {"open": "Boolean", "level": "Int32", "kind": "Enumeration", "sum": "Int32", "x": "Float64"},
    }
    for fmi, types in expected.items():
        variables = {v.name: v for v in fmpy.read_model_description(str(built(GATE, fmi))).modelVariables}
        assert {name: variables[name].type for name in types} == types
        assert variables["kind"].declaredType.name == "Kind"
        assert [item.name for item in variables["kind"].declaredType.items] == ["none", "small", "large"]
        assert (variables["sum"].variability, variables["x"].variability) == ("discrete", "continuous")
        assert not {"when{1}", "pre(rises)", "fires{1}"} & variables.keys()
