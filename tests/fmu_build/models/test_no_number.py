"""Expressions of constants that are no real number: NaN, which ends a run with the variable's name if it needs them."""

from __future__ import annotations

import math
from collections.abc import Callable

import fmpy
import pytest

from fmu_build.errors import BuildError
from fmu_build.frontend.flatten import flatten
from tests.fmu_build.conftest import Build, CompiledModel, Writer
from tests.sampling import sampled

BAD = "sqrt(-1) sqrt(-1.0) log(-1) log(0) log10(-2.0) acos(2) acos(2.0) asin(-3) (-1)^0.5 (-2.0)^(1/3) 1/0 0/0 0.0/0.0"
BAD += (
    " x/0 0^(-1) 0.0^(-0.5) 2*sqrt(c)*x sqrt(c)^2 exp(1e6) 1e308*10 1/z log(f) sqrt(f)*x {1,2}*{sqrt(c),0} abs(log(c))"
)
BAD += " sum({1/i_for_i_in_0:1}) floor(1/0)"
EXPRESSIONS = [text.replace("_", " ") for text in BAD.split()]


def model(values: str) -> str:
    lines = "".join(f"  Real y{i} = {values.replace('{}', e)};\n" for i, e in enumerate(EXPRESSIONS))
    return f"""model M
  constant Real c = -1, z = 0;
  final parameter Real f = -0.5;
  parameter Boolean b = false;
  Real x = time + 1;
{lines}end M;
"""


@pytest.mark.parametrize(("values", "is_number"), [("{}", False), ("if b then {} else 1", True)])
def test_it_is_nan_where_it_is_needed(
    values: str, is_number: bool, compiled_model: Callable[[str], CompiledModel]
) -> None:
    compiled = compiled_model(model(values))
    compiled.outputs()
    found = [compiled[f"y{i}"] for i in range(len(EXPRESSIONS))]
    assert [e for e, y in zip(EXPRESSIONS, found, strict=True) if math.isnan(y) == is_number] == []


@pytest.mark.parametrize("start", sampled(["1/p", "sqrt(p - 1)", "log(p)", "c"], {"1/p", "c"}))
def test_a_start_value_has_to_be_one(start: str, modelica_file: Writer) -> None:
    text = f"model M\n  parameter Real p = 0;\n  constant Real c;\n  input Real u(start={start});\nend M;\n"
    with pytest.raises(BuildError, match=r"M\.mo:4: (start of u|constant c)"):
        flatten(modelica_file(text), "M")


def test_a_run_ends_with_the_name(built: Build) -> None:
    text = "model M\n  constant Real c = -1;\n  Real x(start=1, fixed=true);\nequation\n  der(x) = x*sqrt(c);\nend M;\n"
    said: list[str] = []
    with pytest.raises(fmpy.fmi1.FMICallException):
        fmpy.simulate_fmu(str(built(text, 2)), logger=lambda *message: said.append(str(message[-1])))
    assert any("der(x) = NaN is not finite at t = 0 s" in line for line in said)
