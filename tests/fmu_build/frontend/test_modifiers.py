"""A parameter that hands its value down through modifiers keeps its effect: set it, and what is inside follows."""

from __future__ import annotations

import re
from collections.abc import Callable

import pytest

from tests.fmu_build.conftest import CompiledModel

LIBRARY = """
model Inner
  parameter Real k = 1;
  parameter Real j = 2;
  Real y;
equation
  y = k + j;
end Inner;
model Middle
  parameter Real k = 1;
  parameter Real l = 5;
  Inner a(k=k);
  Inner b(k=2*k, j=l);
  Inner c;
end Middle;
model Outer
  parameter Real m = 1;
  Middle middle(k=m, l=7);
end Outer;
model M
  constant Real fixed_number = 5;
  parameter Real p = 7;
{declarations}
end M;
"""

# What stands in M, the parameter that is set, what is looked at, and its value by that of the parameter.
CASES = {
    "literal": ("Middle x(k=3)", "x.k", "x.a.y", lambda v: v + 2),
    "negative": ("Middle x(k=-3)", "x.k", "x.a.y", lambda v: v + 2),
    "expression": ("Middle x(k=2*3)", "x.k", "x.a.y", lambda v: v + 2),
    "default": ("Middle x", "x.k", "x.a.y", lambda v: v + 2),
    "calculated": ("Middle x(k=3)", "x.k", "x.b.y", lambda v: 2 * v + 5),
    "other name": ("Middle x(l=9)", "x.l", "x.b.y", lambda v: 2 + v),
    "parameter": ("Middle x(k=p)", "p", "x.a.y", lambda v: v + 2),
    "two levels, the outer one": ("Outer x(m=4)", "x.m", "x.middle.a.y", lambda v: v + 2),
    "two levels, given in between": ("Outer x(m=4)", "x.middle.l", "x.middle.b.y", lambda v: 8 + v),
    "one of an array": ("Middle x[2](k={3, 4})", "x[2].k", "x[2].a.y", lambda v: v + 2),
    "each of an array": ("Middle x[2](each k=3)", "x[1].k", "x[1].a.y", lambda v: v + 2),
    "the next of an array": ("Middle x[2](each k=3)", "x[2].k", "x[1].a.y", lambda v: 3 + 2),
    "twice the same text": ("Outer x(m=4, middle(l=4))", "x.middle.l", "x.middle.b.y", lambda v: 8 + v),
    "not handed down": ("Middle x(k=3)", "x.k", "x.c.y", lambda v: 1 + 2),
}


def test_what_is_inside_follows(compiled_model: Callable[[str], CompiledModel]) -> None:
    """All cases in one model, the component of each with a number of its own."""

    def own(text: str, number: int) -> str:
        return re.sub(r"\bx\b", f"x{number}", text)

    lines = [
        f"  {own(component, number)}; output Real y{number} = {own(output, number)};"
        for number, (component, _, output, _) in enumerate(CASES.values())
    ]
    model = compiled_model(LIBRARY.format(declarations="\n".join(lines)))
    for number, (case, (_, parameter, _, expected)) in enumerate(CASES.items()):
        name = own(parameter, number)
        assert name in model.model.parameters, case
        before = model[name]
        for value in (before, 11.0):
            model[name] = value
            model.outputs()
            assert model[f"y{number}"] == pytest.approx(expected(value)), case
        model[name] = before
