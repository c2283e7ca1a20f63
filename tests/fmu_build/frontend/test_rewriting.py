"""What rumoca refuses in other words: parts of expressions as variables, simpler when-clauses; no line moves."""

from __future__ import annotations

import fmpy
import numpy as np
import pytest

from fmu_build.frontend.rewriting.restated import restated
from tests.fmu_build.conftest import Build

BODIES = {
    "der(x*x) = 1;": (
        "protected Real 'M: x * x'(stateSelect = StateSelect.never) = x * x; public",
        "der('M: x * x') = 1;",
    ),
    "c*der(a.phi - phi) = F;": (
        "protected Real 'M: a.phi - phi'(stateSelect = StateSelect.never) = a . phi - phi; public",
        "c*der('M: a.phi - phi') = F;",
    ),
    "y = hold(2*s);": ("protected Real 'M: 2 * s' = 2 * s; public", "y = hold('M: 2 * s');"),
    "s = sample(u, Clock(0.1));": (
        "protected Clock 'M: Clock ( 0.1 )' = Clock ( 0.1 ); public",
        "s = sample(u, 'M: Clock ( 0.1 )');",
    ),
    "when sample(0, 1) then n = 1; elsewhen sample(0, 2) then n = 2; end when;": (
        "",
        "when (sample(0, 1) or false) then n = 1; elsewhen (sample(0, 2) or false) then n = 2; end when;",
    ),
    "when {b, sample(0, 1)} then\n  reinit(x, 2);\nend when;": (
        "",
        "when {b, (sample(0, 1) or false)} then\n  reinit(x, 2);\nend when;",
    ),
    "when b then\n  y[1] = u;\n  n = pre(n) + 1;\nend when;": (
        "",
        "y [ 1 ] = if edge(b) then u else pre(y [ 1 ]);\n when {b} then n = pre ( n ) + 1; end when;\n",
    ),
    "when Clock(0.1) then for i in 1:2 loop y[i] = previous(y[i]) + i; end for; n = 1; end when;": (
        "protected Clock 'M: Clock ( 0.1 )' = Clock ( 0.1 ); public",
        "when 'M: Clock ( 0.1 )' then y = {previous ( y[1] ) + 1, previous ( y[2] ) + 2}; n = 1; end when;",
    ),
    "when b then (s, n) = f(u); end when;": (
        "",
        "algorithm when {b} then ( s , n ) := f ( u ); end when; equation",
    ),
}
SAME = (
    "der(x) = 1; y = hold(a.s[1]);",
    "c = Clock(0.1);",
    "for i in 1:3 loop der(x[i] - 1) = 0; end for;",
    "y = sum(der(2*x[i]) for i in 1:2);",
    "when {b, c} then n = 1; elsewhen d then n = 2; end when;",
    "when b then if c then y[1] = 1; else y[1] = 2; end if; end when;",
    "when b then y[1] = 1; elsewhen c then y[1] = 2; end when;",
    'x = 1 "der(x*x)"; // der(x*x)',
)
AROUND = (
    "package P\n  model M\n    {extra}discrete Real y[2], s; Integer n;\n  equation\n    {body}\n  end M;\nend P;\n"
)


@pytest.mark.parametrize("body", BODIES)
def test_other_words(body: str) -> None:
    declared, expected = BODIES[body]
    text = AROUND.format(extra="", body=body)
    result = restated(text)
    assert result.count("\n") == text.count("\n")
    words = AROUND.format(extra=f"{declared} ", body=expected).replace(".", " . ").split()
    assert result.replace(".", " . ").split() == words


@pytest.mark.parametrize("body", SAME)
def test_what_stays(body: str) -> None:
    text = AROUND.format(extra="", body=body)
    assert restated(text) == text


def test_declarations_with_a_clock_become_equations() -> None:
    declared = 'Real s(start=1) = previous(s) + 1 "counts", t = 2*sample(u, c);'
    text = f'model M "it"\n  {declared}\n  Clock c = Clock(1);\nend M;\n'
    assert restated(text) == (
        'model M "it"\n  protected Real \'M: sample ( u , c )\' ; public Real s(start=1)  "counts",'
        " t = 2*'M: sample ( u , c )';\n  Clock c = Clock(1);"
        " equation 'M: sample ( u , c )' = sample ( u , c ); s = previous ( s ) + 1; \nend M;\n"
    )


def test_what_is_assigned_element_by_element_becomes_discrete() -> None:
    body = "when b then z[1] = u; end when;"
    text = AROUND.format(extra='"it" output Real z[3](each start=1) = x; ', body=body)
    assert '"it" discrete output Real z[3]' in restated(text)
    shared = AROUND.format(extra="Real x, z[3];", body=body)
    assert restated(shared) == shared


def test_derivatives_of_expressions(built: Build) -> None:
    text = (
        "model Derivatives\n  Real x(start=1, fixed=true), y(start=0, fixed=true), d;\nequation\n  der(x*x) = 1;\n"
        "  der(y) - 0.5*der(x*x - time) = x;\n  d = der(sin(time) + 2*y);\nend Derivatives;\n"
    )
    result = fmpy.simulate_fmu(str(built(text, 2)), stop_time=2.0, output=["x", "y", "d"], relative_tolerance=1e-9)
    x = np.sqrt(1 + result["time"])
    np.testing.assert_allclose(result["x"], x, rtol=1e-7)
    np.testing.assert_allclose(result["y"], 2 / 3 * (x**3 - 1), rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(result["d"], np.cos(result["time"]) + 2 * x, rtol=1e-6)
