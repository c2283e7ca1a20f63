"""Every parameter of CarTrailer.fmu: default, range and effect, before and during a run."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave

from overrun_hitch.parameters import DATUM, Parameters

NAMES = list(Parameters.model_fields)
FIXED = {"V_0", "compression_start"}


class Unit:
    """One instance of the FMU, driven call by call."""

    def __init__(self, fmu: Path, folder: Path) -> None:
        self.description = fmpy.read_model_description(str(fmu))
        self.references = {v.name: v.valueReference for v in self.description.modelVariables}
        fmpy.extract(str(fmu), unzipdir=str(folder))
        self.slave = FMU2Slave(
            guid=self.description.guid,
            unzipDirectory=str(folder),
            modelIdentifier=self.description.coSimulation.modelIdentifier,
        )
        self.slave.instantiate()

    def set(self, values: Mapping[str, float]) -> None:
        self.slave.setReal([self.references[n] for n in values], list(values.values()))

    def start(self, values: Mapping[str, float]) -> None:
        self.slave.reset()
        self.set(values)
        self.slave.setupExperiment(startTime=0.0)
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()

    def outputs(self) -> np.ndarray:
        names = [v.valueReference for v in self.description.modelVariables if v.causality == "output"]
        return np.array(self.slave.getReal(names))

    def run(self, first: int, last: int) -> np.ndarray:
        """Outputs at the end of the steps of 10 ms from number ``first`` to number ``last``."""
        rows = []
        for step in range(first, last):
            self.slave.doStep(step * 0.01, 0.01)
            rows.append(self.outputs())
        return np.array(rows)


@pytest.fixture(scope="module")
def unit(car_trailer_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Unit]:
    unit = Unit(car_trailer_fmu, tmp_path_factory.mktemp("unpacked"))
    yield unit
    unit.slave.freeInstance()


# A run in which every parameter matters: into compression, back through the clearance, into tension.
LIVELY = {"brake_torque": 1000.0, "C": 20.0, "eps": 0.01}
CHANGED = {"eps": 0.02, "compression_start": 0.005}


def changed(name: str) -> dict[str, float]:
    return {name: CHANGED.get(name, 1.1 * LIVELY.get(name, getattr(DATUM, name)))}


def test_defaults_and_minima_are_those_of_the_python_parameters(unit: Unit) -> None:
    for variable in unit.description.modelVariables:
        if variable.causality == "parameter":
            field = Parameters.model_fields[variable.name]
            limits = [limit.ge for limit in field.metadata if hasattr(limit, "ge")]
            assert float(variable.start) == getattr(DATUM, variable.name)
            assert [float(variable.min)] == limits if variable.min is not None else limits == []
            assert variable.unit == Parameters.unit(variable.name)


@pytest.mark.parametrize("name", NAMES)
def test_setting_a_parameter_at_the_start_moves_the_outputs(unit: Unit, name: str) -> None:
    unit.start(LIVELY)
    before = unit.run(0, 200)
    unit.start({**LIVELY, **changed(name)})
    assert np.abs(unit.run(0, 200) - before).max() > 1e-3


@pytest.mark.parametrize("name", sorted(set(NAMES) - FIXED))
def test_a_tunable_parameter_takes_effect_at_the_next_step(unit: Unit, name: str) -> None:
    unit.start(LIVELY)
    unit.run(0, 100)
    undisturbed = unit.run(100, 200)
    unit.start(LIVELY)
    unit.run(0, 100)
    unit.set(changed(name))
    assert np.abs(unit.run(100, 200) - undisturbed).max() > 1e-3


@pytest.mark.parametrize("name", sorted(FIXED))
def test_a_fixed_parameter_is_refused_during_the_run(unit: Unit, name: str) -> None:
    unit.start(LIVELY)
    unit.run(0, 1)
    with pytest.raises(FMICallException):
        unit.set(changed(name))


@pytest.mark.parametrize("value", [float("nan"), float("inf"), -float("inf")])
@pytest.mark.parametrize("name", [*NAMES, "brake_torque"])
def test_a_value_that_is_not_finite_is_refused(unit: Unit, name: str, value: float) -> None:
    unit.slave.reset()
    with pytest.raises(FMICallException):
        unit.set({name: value})


@pytest.mark.parametrize("name", sorted({*NAMES, "brake_torque"} - {"compression_start"}))
def test_a_negative_value_is_refused(unit: Unit, name: str) -> None:
    unit.slave.reset()
    with pytest.raises(FMICallException):
        unit.set({name: -1e-6})
