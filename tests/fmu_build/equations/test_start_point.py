"""Start values as a point: parameters that follow from each other, however deep, and in whatever order."""

from __future__ import annotations

import random
from collections.abc import Callable

import pytest
import sympy

from fmu_build.equations.start_point import starts_fit, value_at_start
from fmu_build.ir.equations import Equation, Variable
from fmu_build.ir.symbols import symbol
from tests.fmu_build.conftest import CompiledModel


def chain(depth: int) -> list[Variable]:
    """``p0 = 0``, and each of the others 1 more than twice the one before it if that is below 1000, else 1 less: by a
    condition and in both branches it depends on it, so that putting them into each other would take 3^depth terms."""
    variables = [Variable("p0", variability="parameter", binding=sympy.Integer(0))]
    for i in range(depth):
        before = symbol(f"p{i}")
        value = sympy.Piecewise((2 * before + 1, before < 1000), (before - 1, True), evaluate=False)
        variables.append(Variable(f"p{i + 1}", variability="parameter", binding=value))
    return variables


def value(depth: int) -> int:
    p = 0
    for _ in range(depth):
        p = 2 * p + 1 if p < 1000 else p - 1
    return p


@pytest.mark.parametrize(
    "depth", [0, 1, 9, 60, pytest.param(2000, marks=pytest.mark.full)]
)  # deeper than Python's calls may be nested
def test_parameters_that_follow_from_each_other(depth: int) -> None:
    variables = chain(depth)
    random.Random(depth).shuffle(variables)
    assert value_at_start(symbol(f"p{depth}"), variables) == value(depth)
    table = {v.name: v for v in variables} | {"x": Variable("x", start=sympy.Integer(1), guess=1.0)}
    for off in (0, 1):
        equation = Equation(symbol("x") + symbol(f"p{depth}") - (value(depth) + 1 + off), "here")
        assert starts_fit([equation], ["x"], table) == (off == 0)


def test_what_depends_on_itself_has_no_value() -> None:
    """And does not keep others from having theirs."""
    names = ["a", "b"]
    circle = [
        Variable(name, variability="parameter", binding=symbol(other) + 1)
        for name, other in zip(names, reversed(names), strict=True)
    ]
    variables = [*circle, *chain(3)]
    assert value_at_start(symbol("a") + symbol("p3"), variables) is None
    assert value_at_start(symbol("p3"), variables) == value(3)


@pytest.mark.parametrize("first", ["= 0.3", "(start=0.3)"])  # a value, or one that may still be set
def test_a_model_with_many_conditional_parameters(first: str, compiled_model: Callable[[str], CompiledModel]) -> None:
    """The state's start value comes through thirty of them, and it ties another one."""
    depth = 30
    lines = [f"  parameter Real p{i} = if p{i - 1} > 1 then p{i - 1}/2 else 3*p{i - 1};" for i in range(1, depth + 1)]
    model = compiled_model(
        f"model M\n  parameter Real p0{first};\n"
        + "\n".join(lines)
        + f"\n  Real x(start=p{depth}, fixed=true), y, z;\n"
        f"equation\n  der(x) = -x;\n  der(y) = z;\n  y = p{depth}*x;\nend M;"
    )
    p = 0.3
    for _ in range(depth):
        p = p / 2 if p > 1 else 3 * p
    model.outputs()
    assert model["x"] == pytest.approx(p, rel=1e-12)
    assert model["y"] == pytest.approx(p**2, rel=1e-12)
