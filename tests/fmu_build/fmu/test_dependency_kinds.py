"""dependenciesKind: what is said of each pair, and that factors which are said to stay do stay."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import fmpy
import numpy as np
import pytest

from fmu_build.equations.jacobian import differentiate
from fmu_build.fmu.dependency_kinds import dependency_kinds
from fmu_build.ir.models import SortedModel

TEXT = """
model M
  parameter Real p = 3;
  input Real u;
  Real x(start=1, fixed=true);
  Real y(start=1, fixed=true);
  Integer n(start=1, fixed=true);
  output Real doubled = 2*x;
  output Real through = doubled + u;
  output Real tuned = p*x - y;
  output Real bent = if x > 0 then x else 3*x;
  output Real counted = n*x;
  output Real product = x*y;
  output Real both = 2*x + x^2;
  output Real switched = if x > 0 then 1 else 2;
equation
  der(x) = -x;
  der(y) = u;
  when time > 1 then
    n = 2;
  end when;
end M;
"""
EXPECTED = {
    ("doubled", "x"): "constant",
    ("through", "x"): "constant",
    ("through", "u"): "constant",
    ("tuned", "x"): "tunable",
    ("tuned", "y"): "constant",
    ("bent", "x"): "discrete",
    ("counted", "x"): "discrete",
    ("product", "x"): "dependent",
    ("both", "x"): "dependent",
}


def test_what_is_said(sorted_model: Callable[[str], SortedModel]) -> None:
    model = sorted_model(TEXT)
    kinds = dependency_kinds(model, differentiate(model))
    assert {pair: kinds[pair[0]][pair[1]] for pair in EXPECTED} == EXPECTED
    assert "x" in model.sources["switched"] and "x" not in kinds["switched"]  # through a condition alone: dependent


@pytest.mark.full
@pytest.mark.parametrize("version", [2, 3])
def test_factors_of_the_unit_stay_where_it_says_so(
    car_trailer_fmus: dict[int, Path], version: int, tmp_path: Path
) -> None:
    """In compression, at two states far apart: factors called constant, tunable or discrete are the same."""
    fmu = str(car_trailer_fmus[version])
    description = fmpy.read_model_description(fmu)
    unit = fmpy.instantiate_fmu(fmpy.extract(fmu, str(tmp_path)), description, "ModelExchange")
    table = {v.name: v.valueReference for v in description.modelVariables}
    if version == 2:
        unit.setupExperiment()
    unit.enterInitializationMode()
    unit.exitInitializationMode()
    states = [d.variable.derivative.name for d in description.derivatives]

    def factors(speed: float, compression: float) -> dict[tuple[str, str], float]:
        values = dict.fromkeys(states, 0.0) | {"car.body.v": speed, "trailer.body.v": speed + 0.1}
        values |= {
            "car.wheel.omega": speed / 0.36,
            "trailer.wheel.omega": speed / 0.36,
            "drawbar.compression": compression,
        }
        x = np.array([values[name] for name in states])
        if version == 2:
            while unit.newDiscreteStates()[0]:
                pass
        unit.enterContinuousTimeMode()
        pointer = fmpy.fmi2.POINTER(fmpy.fmi2.fmi2Real) if version == 2 else fmpy.fmi3.POINTER(fmpy.fmi3.fmi3Float64)
        unit.setContinuousStates(x.ctypes.data_as(pointer), x.size)
        unit.enterEventMode()
        found = {}
        for unknown in (*description.outputs, *description.derivatives):
            kinds = unknown.dependenciesKind or ["dependent"] * len(unknown.dependencies)
            for known, kind in zip(unknown.dependencies, kinds, strict=True):
                if kind != "dependent" and known.name in states:
                    reference = [unknown.variable.valueReference]
                    (value,) = unit.getDirectionalDerivative(reference, [table[known.name]], [1.0])
                    found[unknown.variable.name, known.name] = value
        return found

    first, second = factors(30.0, 0.05), factors(7.0, 0.02)
    unit.freeInstance()
    assert len(first) >= 10 and first == second
