"""Clocks that tick together and apart, against a simulator of events in exact rational numbers.

Every flow of data between two clocks is crossed with pairs of clocks: all when-clauses that are active at one instant
hold together, whatever their order in the text. Modelica 3.6, 8.3.5 and 8.6.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from math import ceil

import pytest
import sympy

from tests.fmu_build.models.discrete.blocks import Case, check
from tests.fmu_build.models.discrete.conftest import Way
from tests.sampling import sampled

State = dict[str, Fraction]
STOP = Fraction(3, 2)
CLOCKS = ("0, 0.1", "0, 0.3", "0.3, 0.1", "-0.3, 0.1", "0.05, 0.25", "0, 1/7", "-1/7, 3/7", "2 - 1.65, 0.35")
PAIRS = [(one, CLOCKS[(i + shift) % len(CLOCKS)]) for i, one in enumerate(CLOCKS) for shift in (0, 1, 3)]


@dataclass(frozen=True)
class Flow:
    """Equations over the clocks ``one`` and ``other``, and what they do at an instant at which some of the two tick.

    ``act`` gets the values before, the time, and whether each clock ticks; it gives the values behind.
    """

    declarations: str
    equations: str
    outputs: tuple[str, ...]
    act: Callable[[State, Fraction, bool, bool], State]


def _taken(before: State, time: Fraction, one: bool, other: bool) -> State:
    n = before["n"] + one
    return before | {"n": n} | ({"k": n, "q": before["n"], "h": time} if other else {})


def _both_ways(before: State, _: Fraction, one: bool, other: bool) -> State:
    a = (before["b"] + 1) % 97 if one else before["a"]
    b = (2 * a + before["b"]) % 89 if other else before["b"]
    return {"a": a, "b": b}


def _first_branch(before: State, _: Fraction, one: bool, other: bool) -> State:
    return {"m": before["m"] + (1 if one else 100 if other else 0)}


def _either(before: State, _: Fraction, one: bool, other: bool) -> State:
    return {"m": before["m"] + (one or other), "w": before["w"] + (1 if one and other else 0)}


def _chained(before: State, _: Fraction, one: bool, other: bool) -> State:
    odd = 1 - before["odd"] if one else before["odd"]
    n = before["n"] + (odd > before["odd"])
    m = before["m"] + (odd != before["odd"])
    return {"odd": odd, "n": n, "m": m, "c": 10 * n + m if other else before["c"]}


def _timer(before: State, time: Fraction, one: bool, other: bool) -> State:
    due = time >= before["next"]
    n = before["n"] + due
    return {"next": before["next"] + Fraction(1, 5) * due, "n": n, "c": n if one else before["c"], "d": before["d"]}


def _held(before: State, time: Fraction, one: bool, other: bool) -> State:
    x = before["x"] + before["u"] * (time - before["t"])
    u = time - x if one else before["u"]
    return {"t": time, "x": x, "u": u, "s": x + u if other else before["s"]}


FLOWS = {
    "the new and the old value": Flow(
        "output Integer n(start=0), k(start=0), q(start=0); discrete output Real h(start=0);",
        "when other then k = n; q = pre(n); h = time; end when; when one then n = pre(n) + 1; end when;",
        ("n", "k", "q", "h"),
        _taken,
    ),
    "values in both directions": Flow(
        "output Integer a(start=0), b(start=0);",
        "when other then b = mod(2*a + pre(b), 89); end when; when one then a = mod(pre(b) + 1, 97); end when;",
        ("a", "b"),
        _both_ways,
    ),
    "branches": Flow(
        "output Integer m(start=0);",
        "when one then m = pre(m) + 1; elsewhen other then m = pre(m) + 100; end when;",
        ("m",),
        _first_branch,
    ),
    "one of two": Flow(
        "output Integer m(start=0), w(start=0);",
        "when {one, other} then m = pre(m) + 1; end when; when one and other then w = pre(w) + 1; end when;",
        ("m", "w"),
        _either,
    ),
    "what a Boolean sets off": Flow(
        "output Boolean odd(start=false); output Integer n(start=0), m(start=0), c(start=0);",
        "when change(odd) then m = pre(m) + 1; end when; when odd then n = pre(n) + 1; end when;"
        " when one then odd = not pre(odd); end when; when other then c = 10*n + m; end when;",
        ("n", "m"),
        _chained,
    ),
    "a timer": Flow(
        "discrete output Real next(start=0.2, fixed=true); output Integer n(start=0), c(start=0);",
        "when one then c = n; end when; when time >= pre(next) then next = pre(next) + 0.2; n = pre(n) + 1; end when;",
        ("n", "c", "next"),
        _timer,
    ),
    "a state that is sampled and driven": Flow(
        "output Real x(start=0, fixed=true); discrete output Real u(start=0), s(start=0);",
        "der(x) = u; when other then s = x + u; end when; when one then u = time - x; end when;",
        ("x", "u", "s"),
        _held,
    ),
}


def _instants(clock: str) -> set[Fraction]:
    """When a clock ticks."""
    start, interval = (Fraction(float(sympy.sympify(part))).limit_denominator(10000) for part in clock.split(","))
    first = max(0, ceil(-start / interval))
    return {start + i * interval for i in range(first, int((STOP - start) / interval) + 1)}


def _exact(flow: Flow, one: str, other: str) -> Callable[[str], Callable[[float], float]]:
    """The outputs as functions of the time."""
    first, second = _instants(one), _instants(other)
    timers = {Fraction(i, 5) for i in range(1, 8)}
    grid = {Fraction(i, 20) for i in range(31)}
    state = dict.fromkeys(("n", "k", "q", "h", "a", "b", "m", "w", "odd", "c", "d", "x", "u", "s", "t"), Fraction(0))
    state["next"] = Fraction(1, 5)
    courses: dict[Fraction, State] = {}
    for time in sorted(first | second | timers | grid):
        state = state | flow.act(state, time, time in first, time in second)
        courses[time] = state
    return lambda output: lambda time: float(courses[Fraction(round(20 * time), 20)][output])


def _cases(flow: Flow) -> dict[str, Case]:
    found: dict[str, Case] = {}
    for one, other in PAIRS:
        exact = _exact(flow, one, other)
        equations = flow.equations.replace("one", f"sample({one})").replace("other", f"sample({other})")
        found[f"{one} and {other}"] = (
            flow.declarations,
            f"equation {equations}",
            {output: exact(output) for output in flow.outputs},
        )
    return found


@pytest.mark.parametrize("flow", sampled(FLOWS, {"the new and the old value"}))
def test_two_clocks(flow: str, way: Way) -> None:
    name = "".join(word.capitalize() for word in flow.split())
    check(way, name, _cases(FLOWS[flow]), stop=float(STOP))
