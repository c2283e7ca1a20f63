"""Every parameter of CarTrailer.fmu: default, range and effect, before and during a run, and what the docs say."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from overrun_hitch.parameters import DATUM, Parameters
from tests.unit import Unit

NAMES = list(Parameters.model_fields)
FIXED = {"V_0", "compression_start"}
ROOT = Path(__file__).parents[1]


def rerun(unit: Unit, values: Mapping[str, float]) -> None:
    unit.slave.reset()
    unit.start(**values)


def run(unit: Unit, first: int, last: int) -> np.ndarray:
    """Outputs at the end of the steps of 10 ms from number ``first`` to number ``last``."""
    rows = []
    for step in range(first, last):
        unit.slave.doStep(step * 0.01, 0.01)
        rows.append(unit.outputs())
    return np.array(rows)


@pytest.fixture(scope="module")
def unit(car_trailer_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Unit]:
    unit = Unit(car_trailer_fmu, tmp_path_factory.mktemp("unpacked"))
    unit.slave.instantiate()
    yield unit
    unit.slave.freeInstance()


# A run in which every parameter matters: into the buffer, back through the clearance, into tension.
LIVELY = {
    "brake_torque": 1000.0, "C": 20.0, "eps": 0.01,
    "F_0": 100.0, "x_2": 0.01, "k_2": 8000.0, "x_3": 0.02, "k_3": 12e3, "travel": 0.035,
}  # fmt: skip
BACKWARD = {"reverse_braking"}  # what matters there alone
LOCKED = {"mu_slide"}  # and where wheels lock
BEYOND_REACH = 1e8


def changed(name: str) -> dict[str, float]:
    """A tenth more; the least that is allowed where more is not, or changes nothing."""
    value, (least, most) = LIVELY.get(name, getattr(DATUM, name)), Parameters.limits(name)
    if value == 0.0:
        return {name: 0.1}
    return {name: 1.1 * value if 1.1 * value <= min(most, BEYOND_REACH) else least}


def lively(name: str) -> dict[str, float]:
    if name in LOCKED:
        return {**LIVELY, "brake_torque": 4000.0, "mu": 0.3}
    return {**LIVELY, "V_0": -40.0, "compression_start": 0.1} if name in BACKWARD else LIVELY


def test_defaults_and_ranges_are_those_of_the_python_parameters(unit: Unit) -> None:
    for variable in unit.description.modelVariables:
        if variable.causality == "parameter":
            assert float(variable.start) == getattr(DATUM, variable.name)
            assert (float(variable.min), float(variable.max)) == Parameters.limits(variable.name)
            assert variable.unit == Parameters.unit(variable.name)


def test_names_in_the_order_in_which_they_are_declared(unit: Unit) -> None:
    assert [v.name for v in unit.description.modelVariables if v.causality == "parameter"] == NAMES


def test_units_and_defaults_in_the_docs() -> None:
    text = (ROOT / "docs" / "parameters.md").read_text(encoding="utf-8")
    rows = re.findall(
        r"^\| ((?:`\w+`, )+)[^|]* \| (\S+) \| ([^ ,|]+)[^|]* \| (.*?) \| (.*?) \|$",
        text.partition("These are constants")[0], re.M,
    )  # fmt: skip
    told = {name: row for names, *row in rows for name in re.findall(r"`(\w+)`", names)}
    assert told.keys() >= {*Parameters.having("theory", "neutral")}
    assert told.keys() == {name for name in NAMES if Parameters.typical(name)} - {"V_0"}
    for name, (unit, default, typical, source) in told.items():
        assert (unit, float(default)) == (Parameters.unit(name), getattr(DATUM, name))
        assert typical.replace("`", "") == Parameters.typical(name)
        assert source.startswith(Parameters.source(name)) and Parameters.source(name)


@pytest.mark.parametrize("name", NAMES)
def test_setting_a_parameter_at_the_start_moves_the_outputs(unit: Unit, name: str) -> None:
    rerun(unit, lively(name))
    before = run(unit, 0, 200)
    rerun(unit, {**lively(name), **changed(name)})
    assert np.abs(run(unit, 0, 200) - before).max() > 1e-3


@pytest.mark.parametrize("name", sorted(set(NAMES) - FIXED))
def test_a_tunable_parameter_takes_effect_at_the_next_step(unit: Unit, name: str) -> None:
    rerun(unit, lively(name))
    run(unit, 0, 100)
    undisturbed = run(unit, 100, 200)
    rerun(unit, lively(name))
    run(unit, 0, 100)
    unit.set(**changed(name))
    assert np.abs(run(unit, 100, 200) - undisturbed).max() > 1e-3


@pytest.mark.parametrize("name", sorted(FIXED))
def test_a_fixed_parameter_is_refused_during_the_run(unit: Unit, name: str) -> None:
    rerun(unit, LIVELY)
    run(unit, 0, 1)
    with pytest.raises(FMICallException):
        unit.set(**changed(name))


@pytest.mark.parametrize("value", [float("nan"), float("inf"), -float("inf")])
@pytest.mark.parametrize("name", [*NAMES, "brake_torque"])
def test_a_value_that_is_not_finite_is_refused(unit: Unit, name: str, value: float) -> None:
    unit.slave.reset()
    with pytest.raises(FMICallException):
        unit.set(**{name: value})


def test_a_negative_torque_is_none(unit: Unit) -> None:
    unit.slave.reset()
    unit.start(brake_torque=-1.0)
    assert unit.get("brake_torque").tolist() == [0.0]


@pytest.mark.parametrize("name", sorted({*NAMES} - {"compression_start", "V_0"}))
def test_a_negative_value_is_refused(unit: Unit, name: str) -> None:
    unit.slave.reset()
    with pytest.raises(FMICallException):
        unit.set(**{name: -1e-6})
