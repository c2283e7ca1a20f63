"""Every way to give a start value, for everything that can have one: the value at the start, and in the XML."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

import fmpy
import pytest

from tests.fmu_build.conftest import Build

# Declarations, and the start value of each scalar. P is where a prefix goes, F where fixed does (G: of an array).
DECLARED = {
    "none": ("P Real x F;", {"x": 0.0}),
    "literal": ("P Real x(start=3 F);", {"x": 3.0}),
    "negative": ("P Real x(start=-1 F);", {"x": -1.0}),
    "product": ("P Real x(start=2*3.5 F);", {"x": 7.0}),
    "parameter": ("P Real x(start=p0 F);", {"x": 4.0}),
    "expression of parameters": ("P Real x(start=-p0/8 + c0 F);", {"x": 4.5}),
    "calculated parameter": ("P Real x(start=p1 F);", {"x": 12.0}),
    "final parameter": ("P Real x(start=p2 F);", {"x": 13.0}),
    "constant": ("P Real x(start=c0 F);", {"x": 5.0}),
    "function": ("P Real x(start=sqrt(p0) F);", {"x": 2.0}),
    "condition": ("P Real x(start=if p0 > 3 then 6 else 7 F);", {"x": 6.0}),
    "element of a parameter": ("P Real x(start=v0[2] F);", {"x": 9.0}),
    "array": ("P Real x[2](start={1, -6} G);", {"x[1]": 1.0, "x[2]": -6.0}),
    "array parameter": ("P Real x[2](start=v0 G);", {"x[1]": 8.0, "x[2]": 9.0}),
    "scaled array": ("P Real x[2](start=p0*v0 G);", {"x[1]": 32.0, "x[2]": 36.0}),
    "matrix": ("P Real x[2,1](start=[1; 2] G);", {"x[1,1]": 1.0, "x[2,1]": 2.0}),
    "fill": ("P Real x[2](start=fill(3, 2) G);", {"x[1]": 3.0, "x[2]": 3.0}),
    "each": ("P Real x[2](each start=-3 G);", {"x[1]": -3.0, "x[2]": -3.0}),
    "array before the name": ("P Real[2] x(start={1, 6} G);", {"x[1]": 1.0, "x[2]": 6.0}),
    "type": ("type T = Real(start=-7 F); P T x;", {"x": -7.0}),
    "type of a type": ("type S = Real(start=-7 F); type T = S; P T x;", {"x": -7.0}),
    "type that is modified": ("type T = Real(start=-7); P T x(start=2*4 F);", {"x": 8.0}),
}
INSIDE = {
    "component": ("model C P Real x(start=-1 F); end C; C c;", {"c.x": -1.0}),
    "modifier": ("model C P Real x(start=1); end C; C c(x(start=-2 F));", {"c.x": -2.0}),
    "modifier by a parameter": ("model C P Real x; end C; C c(x(start=p0 F));", {"c.x": 4.0}),
    "parameter of a block": (
        "model C parameter Real s=0; P Real x(start=s F); end C; C c(s=-9);",
        {"c.x": -9.0},
    ),
    "extends": ("model B P Real x; end B; model C extends B(x(start=-3 F)); end C; C c;", {"c.x": -3.0}),
    "short class": ("model B P Real x; end B; model C = B(x(start=-3 F)); C c;", {"c.x": -3.0}),
    "array of components": (
        "model C P Real x; end C; C c[2](x(start={1, -4} G));",
        {"c[1].x": 1.0, "c[2].x": -4.0},
    ),
    "each of components": ("model C P Real x; end C; C c[2](each x(start=-4 F));", {"c[1].x": -4.0, "c[2].x": -4.0}),
    "record": ("record R Real x; end R; R c(x(start=-5 F));", {"c.x": -5.0}),
    "inside a record": ("record R Real x(start=-5 F); end R; R c;", {"c.x": -5.0}),
    "two levels": (
        "model B P Real x; end B; model C B b; end C; C c(b(x(start=2*p0 F)));",
        {"c.b.x": 8.0},
    ),
}
# The prefix of what has a start value v, and the equations that determine it.
ROOTS = "({x} - ({v}))*({x} + ({v})/8 + 1e-3) = 0;"  # from another start value the search finds the other one
ROLES = {
    "state": ("", "der({x}) = 0;"),
    "output that is a state": ("output", "der({x}) = 0;"),
    "algebraic": ("", ROOTS),
    "output": ("output", ROOTS),
    "discrete": ("discrete", "when time > 1 then {w} = 2*pre({w}); end when;"),
    "input": ("input", ""),
    "alias": ("", "{x} = {a}; der({a}) = 0;"),
    "alias, the other way": ("", "{a} = {x}; der({a}) = 0;"),
}
MODEL = """model M
  parameter Real p0 = 4;
  parameter Real p1 = 3*p0;
  final parameter Real p2 = p1 + 1;
  parameter Real v0[2] = {{8, 9}};
  constant Real c0 = 5;
  parameter Integer n0 = 2;
  parameter Boolean b0 = true;
  type E = enumeration(one, two);
  {declarations}
equation
  {equations}
end M;
"""


@dataclass(frozen=True)
class Case:
    """What stands in the model for one way and one role, and the values of its scalars."""

    title: str
    declaration: str
    equations: str
    values: dict[str, float]


TYPED = (
    Case("Integer", "Integer i1(start=-n0);", "when time > 1 then i1 = 2*pre(i1); end when;", {"i1": -2.0}),
    Case("Boolean", "Boolean i2(start=not b0);", "when time > 1 then i2 = true; end when;", {"i2": 0.0}),
    Case("enumeration", "E i3(start=E.two);", "when time > 1 then i3 = E.one; end when;", {"i3": 2.0}),
    Case("Integer input", "input Integer i4(start=-2*n0);", "", {"i4": -4.0}),
    Case("Boolean input", "input Boolean i5(start=b0);", "", {"i5": 1.0}),
    Case("parameter without a binding", "parameter Real i6(start=-p0/8);", "", {"i6": -0.5}),
)


def cases() -> Iterator[Case]:
    """Every way with every role, fixed too where nothing else determines the value."""
    yield from TYPED
    number = 0
    for role, (prefix, law) in ROLES.items():
        ways = DECLARED if role in {"input", "discrete"} else DECLARED | INSIDE
        for is_fixed in (False, True) if "der" in law else (False,):
            for way, (text, values) in ways.items():
                number += 1
                names = {name: own(name, number) for name in values}
                aliases = {name: f"a{number}{index}" for index, name in enumerate(values)}
                laws = [
                    law.format(x=names[n], w=names[n].partition("[")[0], v=v, a=aliases[n]) for n, v in values.items()
                ]
                others = f"Real {', '.join(aliases.values())};" if "{a}" in law else ""
                yield Case(
                    title=f"{way} of {role}{', fixed' if is_fixed else ''}",
                    declaration=filled(own(text, number), prefix, is_fixed) + others,
                    equations="".join(dict.fromkeys(laws)),
                    values={names[name]: value for name, value in values.items()},
                )


def own(text: str, number: int) -> str:
    """The text with names of its own."""
    return re.sub(r"\b[xcsBCRST]\b", rf"\g<0>{number}", text)


def filled(text: str, prefix: str, is_fixed: bool) -> str:
    scalar, array = ("fixed=true", "each fixed=true") if is_fixed else ("", "")
    text = re.sub(r" F;", f"({scalar});" if is_fixed else ";", text)
    for mark, attribute in (("F", scalar), ("G", array)):
        text = text.replace(f" {mark})", f", {attribute})" if is_fixed else ")")
    return text.replace("P Real", f"{prefix} Real").replace("P T", f"{prefix} T")


@pytest.mark.parametrize("fmi", [2, pytest.param(3, marks=pytest.mark.full)])
def test_every_way_for_everything(fmi: int, built: Build) -> None:
    everything = list(cases())
    text = MODEL.format(
        declarations="\n  ".join(case.declaration for case in everything),
        equations="\n  ".join(case.equations for case in everything),
    )
    fmu = built(text, fmi)
    values = {name: value for case in everything for name, value in case.values.items()}
    titles = {name: case.title for case in everything for name in case.values}
    result = fmpy.simulate_fmu(str(fmu), stop_time=1e-3, output=list(values))[0]
    assert {titles[n]: (float(result[n]), v) for n, v in values.items() if abs(result[n] - v) > 1e-9} == {}
    starts = {v.name: number_of(v.start) for v in fmpy.read_model_description(str(fmu)).modelVariables if v.start}
    assert {titles[n]: (starts[n], v) for n, v in values.items() if n in starts and starts[n] != v} == {}
    assert {n for n, case in titles.items() if "input" in case} <= starts.keys()


def number_of(text: str) -> float:
    return {"false": 0.0, "true": 1.0}[text] if text in {"false", "true"} else float(text)
