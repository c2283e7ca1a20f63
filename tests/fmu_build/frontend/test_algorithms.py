"""Algorithm sections as equations: what becomes one says the same, what would not stays, and no line moves."""

from __future__ import annotations

import pytest

from fmu_build.errors import BuildError
from fmu_build.frontend.flatten import flatten
from fmu_build.frontend.rewriting.algorithms import as_equations
from tests.fmu_build.conftest import Writer

EQUATIONS = {
    "s := time; p := 2*s;": "s = time; p = 2 * s;",
    's := time "first := here"; // p := s;\n  p := 2*s; /* x := 3; */': "s = time; p = 2 * s;",
    "s := time; p := 2*s; s := s + 1;": "s = (time) + 1; p = 2 * (time);",
    "s := time; p := 2*u.s + a.p;": "s = time; p = 2 * u.s + a.p;",
    "if c then s := 1; p := s; elseif d then p := 2; s := 0; else s := 3; p := s; end if; q := p;": (
        "s = if c then 1 elseif d then 0 else 3; p = if c then s elseif d then 2 else s; q = p;"
    ),
    "s := 0; if c then s := s + 1; end if;": "s = if c then (0) + 1 else 0;",
    "s := 1; if c then p := s; else s := 2; p := 3; end if;": "s = if c then 1 else 2; p = if c then s else 3;",
    "s := 1; if c then p := s; else p := 3; s := p + 1; end if;": (
        "s = if c then 1 else (3) + 1; p = if c then (1) else 3;"
    ),
    "if c then n := n + 1; end if;": "n = if c then pre(n) + 1 else pre(n);",
    "s := f(x = 1, y = {1, 2}); p := s^2;": "s = f ( x = 1 , y = { 1 , 2 } ); p = s ^ 2;",
    "s := 0; for i in 1:3 loop s := s + i*u[i]; end for;": "s = (((0) + 1 * u[1]) + 2 * u[2]) + 3 * u[3];",
    "s := 0; for i in 3:-2:1 loop s := s - u[i - 1]; end for;": "s = ((0) - u[2]) - u[0];",
    "s := 0; for i in 1:N loop if u[i] > 1 then s := s + u[i]; end if; end for;": (
        "s = (0) + sum((if u[i] > 1 then (u[i]) else 0) for i in 1 : N);"
    ),
    "s := 1; for i in 1:N, j in 1:i loop s := s*j; end for;": (
        "s = (1) * product(product((j) for j in 1 : i) for i in 1 : N);"
    ),
    "p := 2; for i in 1:N loop x[i] := p*i; end for; s := sum(x);": (
        "for i in 1 : N loop x [ i ] = p * i; end for; p = 2; s = sum ( x );"
    ),
    "x[1] := 1; for i in 2:N loop x[i] := x[i - 1] + 1; end for;": (
        "for i in 2 : N loop x [ i ] = x[i - 1] + 1; end for; x[1] = 1;"
    ),
    "x[1] := 1; x[2] := 2*x[1];": "x[1] = 1; x[2] = 2 * (1);",
    "a.s := time; a.p := 2*a.s;": "a.s = time; a.p = 2 * a.s;",
    "(s, p) := f(time); q := s + p;": "( s , p ) = f ( time ); q = s + p;",
    's := 1; assert(s > 0, "no");': 'assert( s > 0 , "no" ); s = 1;',
    'if c then s := 1; assert(u > 0, "no"); else s := 2; end if;': (
        'assert(not ((c)) or u > 0 , "no" ); s = if c then 1 else 2;'
    ),
    "when c then n := pre(n) + 1; end when; s := n;": (
        "algorithm when c then n := pre(n) + 1; end when; equation s = n;"
    ),
}
OTHERS = (
    "p := 2*s; s := time;",
    "s := s + 1; p := 1;",
    "if c then s := 1; end if; p := s;",
    "if c then s := 1; else p := 2; end if;",
    "while s < 1 loop s := s + 1; end while;",
    "for i in 1:N loop s := i; end for; p := s;",
    "s := 0; for i in 1:N loop s := 2*s + i; end for;",
    "for i in 1:N loop x[i] := x[i + 1]; end for;",
    "for i in N:-1:2 loop x[i] := x[i - 1]; end for; x[1] := 0;",
    "for i in 2:N loop x[i] := x[i - 1]; end for; x[1] := 0;",
    "s := time; s := s + 1; a.p := a.q; p := a.p; a := b;",
    "(s, p) := f(time); s := 2;",
    "p := x[k[1]]; x := y;",
    "x := y; x[1] := 0;",
    "x[1] := 0; x := y;",
    "n[1] := 5; p := n[k]; n[1] := 6;",
    "x[k[1]] := 1; p := x[2]; x[2] := p;",
    "if c then (s, p) := f(time); else s := 1; p := 1; end if;",
    "p := edge(q); q := true; p := edge(q);",
    "p := 1; when c then n := p; end when; p := 2;",
    "s := time; p := s; " + "s := s*s; " * 14 + "p := s;",
)
AROUND = (
    "model M\n  Real s; Integer n;\n{section}\n  {body}\n{after}end M;\n",
    "package P\n  function f\n    output Real y;\n  algorithm\n    y := 1; y := 2*y;\n  end f;\n"
    "  block 'end'\n  Boolean n;\n{section}\n  {body}\n{after}  end 'end';\n  type E = enumeration(a, b);\nend P;\n",
)


@pytest.mark.parametrize(
    "after", ["", "equation\n  y = 1;\n", "protected\n  Real z;\n", 'annotation(Icon("s := 1"));\n']
)
@pytest.mark.parametrize("around", AROUND)
def test_sections_of_a_text(around: str, after: str) -> None:
    for body, expected in EQUATIONS.items():
        text = around.format(section="algorithm", body=body, after=after)
        result = as_equations(text)
        assert result.count("\n") == text.count("\n")
        before, _, section = result.partition(around.partition("{section}")[0] + "equation")
        assert before == "", body
        assert " ".join(section.split()).startswith(expected), body
    for body in OTHERS:
        text = around.format(section="algorithm", body=body, after=after)
        assert as_equations(text) == text, body


def test_initial_sections() -> None:
    text = AROUND[0].format(section="initial algorithm", body="s := 2; s := s + 1;", after="")
    assert "initial equation\n s = (2) + 1;\nend M;" in as_equations(text)
    for body in ("n := n + 1;", "if c then n := 1; end if;"):
        text = AROUND[0].format(section="initial algorithm", body=body, after="")
        assert as_equations(text) == text, body


def test_what_cannot_be_said_otherwise_is_refused_with_a_remedy(modelica_file: Writer) -> None:
    path = modelica_file(
        "model M\n  Real s, p;\nalgorithm\n  if time > 1 then\n    s := 1;\n  end if;\n  p := s;\nend M;\n"
    )
    with pytest.raises(BuildError, match=r"M.mo:3: .*in every branch"):
        flatten(path, "M")
