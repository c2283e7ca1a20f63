"""Algorithm sections that rumoca refuses, by closed forms."""

from __future__ import annotations

from math import floor

from tests.fmu_build.models.discrete.blocks import Case, check, ticks
from tests.fmu_build.models.discrete.conftest import Way

AROUND = """
  record R Real a; Real b; end R;
  function f input Real u; output Real a; output Real b; algorithm a := u; b := 2*u; end f;
  function g input Integer u; output Integer a; output Boolean b; algorithm a := u; b := u > 1; end g;
"""


def late(time: float) -> bool:
    return time > 0.52


def k(time: float) -> int:
    return floor(2 * time + 0.54)


X = "parameter Integer N = 3; Real x[3] = {time, 2*time, 3*time};"
CASES: dict[str, Case] = {
    "a value in between": (
        "output Real s, p;",
        "algorithm s := time; p := 2*s; s := s + 1;",
        {"s": lambda t: t + 1, "p": lambda t: 2 * t},
    ),
    "two values change places": (
        "output Real s, p; Real h;",
        "algorithm s := time; p := 2*time; h := s; s := p; p := h;",
        {"s": lambda t: 2 * t, "p": lambda t: t},
    ),
    "branches, an event": (
        "output Real s, p; output Boolean q;",
        "algorithm q := time > 0.52; if q then s := 1; else s := 2; end if; p := s;",
        {"q": late, "s": lambda t: 2 - late(t), "p": lambda t: 2 - late(t)},
    ),
    "no branch counts": (
        "output Real s, p;",
        "algorithm s := 0; p := 0; if time > 0.52 then s := 1; elseif time > 0.22 then p := 1; s := 2; end if;",
        {"s": lambda t: 1 if late(t) else 2 * (t > 0.22), "p": lambda t: not late(t) and t > 0.22},
    ),
    "each branch reads what the other one assigns": (
        "output Real s, p;",
        "algorithm s := 1; if time > 0.52 then s := s + 1; p := s; else p := s; s := p + 1; end if;",
        {"s": lambda _: 2, "p": lambda t: 1 + late(t)},
    ),
    "what is discrete keeps its value": (
        "output Integer n(start=2); output Boolean b(start=true);",
        "algorithm if time > 0.52 then n := 5; end if; b := n < 4;",
        {"n": lambda t: 5 if late(t) else 2, "b": lambda t: not late(t)},
    ),
    "sums": (
        f"{X} output Real s, p, q;",
        "algorithm s := 0; for i in 1:3 loop s := s + x[i]; end for; p := 1; for i in 1:N loop p := p*x[i]; end for;"
        " q := s/N;",
        {"s": lambda t: 6 * t, "p": lambda t: 6 * t**3, "q": lambda t: 2 * t},
    ),
    "a polynomial": (
        f"{X} output Real s;",
        "algorithm s := 0; for i in {3, 2, 1} loop s := s*time + x[i]; end for;",
        {"s": lambda t: t + 2 * t**2 + 3 * t**3},
    ),
    "the largest": (
        "Real x[3] = {time, 0.52, 2*time - 0.2}; output Real s, p;",
        "algorithm s := x[1]; for i in 2:3 loop if x[i] > s then s := x[i]; end if; end for; p := s;",
        {"p": lambda t: max(t, 0.52, 2 * t - 0.2)},
    ),
    "sums of sums": (
        f"{X} output Real s;",
        "algorithm s := 0; for i in 1:3, j in 1:N loop s := s + i*j*time; end for;",
        {"s": lambda t: 36 * t},
    ),
    "elements": (
        f"{X} output Real y[3], z[3], s;",
        "algorithm y[1] := time; for i in 2:N loop y[i] := y[i - 1] + time; end for;"
        " z[1] := 1; for i in 2:3 loop z[i] := z[i - 1]*time; end for; s := sum(y);",
        {"y[3]": lambda t: 3 * t, "z[3]": lambda t: t**2, "s": lambda t: 6 * t},
    ),
    "whole arrays": (
        f"{X} output Real y[3], s;",
        "algorithm y := x; s := y[2] + y[3];",
        {"s": lambda t: 5 * t},
    ),
    "several outputs": (
        "output Real s, p, q; Integer k = integer(2*time + 0.54); output Integer n; output Boolean b;",
        "algorithm (s, p) := f(time); q := s + p; algorithm (n, b) := g(k);",
        {"q": lambda t: 3 * t, "n": k, "b": lambda t: k(t) > 1},
    ),
    "a record": (
        "R r; output Real q;",
        "algorithm r.a := time; r.b := 2*r.a; q := r.a + r.b;",
        {"q": lambda t: 3 * t},
    ),
    "assertions": (
        "output Real s, p;",
        'algorithm s := time; assert(s < 10, "no");'
        ' if s > 20 then assert(false, "never"); p := 1; else p := s; end if;',
        {"p": lambda t: t},
    ),
    "when-clauses that assign the same": (
        "output Integer n(start=0), m(start=0);",
        "algorithm when time >= 0.36 then n := pre(n) + 1; m := 1; end when;"
        " when sample(0.1, 0.2) then m := m + 10*n + 1; n := n + 1; end when;",
        {"n": lambda t: ticks(t, 0.2, 0.1) + (t > 0.36)},
    ),
    "a when-clause among others": (
        "output Integer n(start=0); output Real s;",
        "algorithm when sample(0.1, 0.2) then n := pre(n) + 1; end when; s := n + time;",
        {"s": lambda t: ticks(t, 0.2, 0.1) + t},
    ),
    "loops at ticks": (
        f"{X} output Integer n(start=0); discrete output Real s(start=0);",
        "algorithm when sample(0.1, 0.1) then for i in 1:3 loop n := n + i; end for;"
        " s := 0; for i in 1:N loop s := s + x[i]; end for; end when;",
        {"n": lambda t: 6 * ticks(t, 0.1, 0.1), "s": lambda t: 0.6 * ticks(t, 0.1, 0.1)},
    ),
}


def test_algorithm_sections(way: Way) -> None:
    check(way, "Sections", CASES, AROUND)
