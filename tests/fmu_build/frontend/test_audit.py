"""Modifiers reach what they are for, or the class is refused: rumoca loses some."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator

import pytest

from fmu_build.errors import BuildError
from fmu_build.frontend.flatten import flatten
from tests.fmu_build.conftest import Writer

BASES = """
model Base parameter Real k = 1; end Base;
model Line extends Base; end Line;
model Curve extends Base; end Curve;
"""
MODIFIERS = ("declaration", "constraint", "component", "redeclaration", "outside")
NUMBERS = dict(zip(MODIFIERS, (2, 3, 4, 5, 6), strict=True))


def places(kind: str, written: frozenset[str], is_redeclared: bool) -> str:
    """Class M with modifiers of k at some places."""

    def k(place: str, text: str = "({})") -> str:
        return text.format(f"k={NUMBERS[place]}") if place in written else ""

    constraint = f" constrainedby Base{k('constraint')}"
    if kind == "class":
        inside = f"replaceable model Bar = Line{k('declaration')}{constraint}; Bar bar{k('component')};"
        redeclared = f"redeclare model Bar = Curve{k('redeclaration')}"
    else:
        inside = f"replaceable Line bar{k('declaration')}{constraint};"
        redeclared = f"redeclare Curve bar{k('redeclaration')}"
    outside = [redeclared] * is_redeclared + [k("outside", "bar({})")] * ("outside" in written)
    return f"{BASES}model C {inside} end C;\nmodel M C c({', '.join(outside)}); end M;"


def right_value(written: frozenset[str], is_redeclared: bool) -> int:
    """Outer before inner; a redeclaration takes the place of the declaration, under the same constraint."""
    order = ["outside", "component", "redeclaration" if is_redeclared else "declaration", "constraint"]
    return next((NUMBERS[place] for place in order if place in written), 1)


def crossing() -> Iterator[tuple[str, frozenset[str], bool]]:
    for kind, is_redeclared in itertools.product(("class", "component"), (False, True)):
        absent = {"component"} if kind == "component" else set()
        absent |= {"outside"} if kind == "component" and is_redeclared else set()  # it would modify bar twice
        absent |= set() if is_redeclared else {"redeclaration"}
        possible = [place for place in MODIFIERS if place not in absent]
        for count in range(len(possible) + 1):
            for written in itertools.combinations(possible, count):
                yield kind, frozenset(written), is_redeclared


@pytest.mark.full
def test_a_modifier_counts_or_is_refused(modelica_file: Writer) -> None:
    accepted = 0
    for kind, written, is_redeclared in crossing():
        text = places(kind, written, is_redeclared)
        try:
            model = flatten(modelica_file(text), "M")
        except BuildError as error:
            assert re.match(r"M\.mo:[56]: c\.bar\.k (would keep its default|is redeclared)", str(error)), text
            continue
        accepted += 1
        found = {v.name: v.binding for v in model.variables}["c.bar.k"]
        assert found == right_value(written, is_redeclared), text
    assert accepted >= 40


LIBRARY = """
model Held replaceable A a; end Held;
model A parameter Real x = 1; parameter Real y = 2; end A;
model Holder replaceable model B = A; B b; end Holder;
model Part replaceable parameter Real u = 1; end Part;
record Pair Real a = 1; Real b = 2; end Pair;
model Paired replaceable Pair r = Pair(3, 4); end Paired;
model Nested model B parameter Real x = 1; end B; B b; end Nested;
model Elements A a[2]; end Elements;
package P constant Real c = 1; end P;
package Q = P(c=2);
model Packed replaceable package Z = P; parameter Real y = Z.c; end Packed;
model Constrained replaceable package Z = P constrainedby P(c=3); parameter Real y = Z.c; end Constrained;
"""
# Class M, the variable that is looked at, and its value as an expression of the names in M.
RIGHT = {
    "short class": ("parameter Real x = 10; model B = A(y=x); B b;", "b.y", "x"),
    "short class, in an expression": ("parameter Real x = 10; model B = A(y=2*x); B b;", "b.y", "2*x"),
    "short class, an array of it": ("parameter Real x = 10; model B = A(y=x); B b[2];", "b[2].y", "x"),
    "short class, another name": ("parameter Real z = 10; model B = A(y=z); B b;", "b.y", "z"),
    "short class, a constant": ("constant Real x = 10; model B = A(y=x); B b;", "b.y", "10"),
    "short class, replaceable": ("parameter Real x = 10; replaceable model B = A(y=x); B b;", "b.y", "x"),
    "short class, inside is changed": ("parameter Real x = 10; model B = A(y=x); B b(x=4);", "b.y", "x"),
    "short class of a component": (
        "model H parameter Real x = 7; model B = A(y=x); B b; end H; H h;",
        "h.b.y",
        "h.x",
    ),
    "long class": ("parameter Real x = 10; model B extends A(y=x); end B; B b;", "b.y", "b.x"),
    "component": ("parameter Real x = 10; A b(y=x);", "b.y", "x"),
    "component in a redeclared one": ("Holder h(redeclare model B = A, b(y=7));", "h.b.y", "7"),
    "class of its own": ("model C extends A(y=7); end C; Holder h(redeclare model B = C);", "h.b.y", "7"),
    "value of a part": ("Part p(u=5);", "p.u", "5"),
    "redeclared in the class": ("extends Part; redeclare parameter Real u = 5;", "u", "5"),
    "redeclared without a value": ("Part p(redeclare parameter Real u);", "p.u", "1"),
    "record": ("Pair r = Pair(7, 8);", "r.a", "7"),
    "field of a redeclared record": ("Paired p(redeclare Pair r(a=7));", "p.r.a", "7"),
    "type of another T": (
        "type Kelvin = Real(start=288); record R Kelvin T; end R; model C parameter Real T[2] = {1, 2}; end C;"
        " C c; R r(T(start=5)=7);",
        "c.T[2]",
        "2",
    ),
    "package": ("Packed p(redeclare package Z = P(c=5));", "p.y", "5"),
    "package by its name": ("Packed p(redeclare package Z = Q);", "p.y", "2"),
    "function": (
        "function f input Real u; input Real k = 2; output Real y; algorithm y := k*u; end f;"
        " function g = f(k=3); parameter Real y = g(2);",
        "y",
        "6",
    ),
}
# Class M, and the variable that a modifier in it does not reach.
LOST = {
    "redeclared class": ("parameter Real x = 10; Holder h(redeclare model B = A(y=x));", "h.b.y"),
    "redeclared class of a base": ("parameter Real z = 10; extends Holder(redeclare model B = A(y=z));", "b.y"),
    "redeclared value": ("Part p(redeclare parameter Real u = 5);", "p.u"),
    "redeclared value of a base": ("extends Part(redeclare parameter Real u = 5);", "u"),
    "redeclared record": ("Paired p(redeclare Pair r = Pair(7, 8));", "p.r.a"),
    "modified class": ("Nested n(B(x=5));", "n.b.x"),
    "modified class of a base": ("extends Nested(B(x=5));", "b.x"),
    "array below a component": ("Elements e[2](each a.x=5);", "e[1].a[1].x"),
    "constraint of a package": ("Constrained p;", "Z.c"),
    "also redeclared in the class": ("extends Held(a(y=3)); redeclare A a(x=4);", "a.y"),
}


@pytest.mark.parametrize("case", RIGHT)
def test_a_modifier_that_counts(case: str, modelica_file: Writer) -> None:
    body, name, expression = RIGHT[case]
    model = flatten(modelica_file(f"{LIBRARY}model M {body} end M;"), "M")
    assert str({v.name: v.binding for v in model.variables}[name]) == expression


@pytest.mark.parametrize("case", LOST)
def test_a_modifier_that_is_lost(case: str, modelica_file: Writer) -> None:
    body, name = LOST[case]
    with pytest.raises(BuildError, match=rf"^M\.mo:\d+: {re.escape(name)} would keep its default instead of"):
        flatten(modelica_file(f"{LIBRARY}model M {body} end M;"), "M")
