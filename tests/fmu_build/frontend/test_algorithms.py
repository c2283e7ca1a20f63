"""Algorithm sections as equations: what becomes one says the same, what would not stays, and no place moves."""

from __future__ import annotations

from collections.abc import Callable

import fmpy
import numpy as np
import pytest
from numpy.typing import NDArray

from fmu_build.errors import BuildError
from fmu_build.frontend.algorithms import as_equations
from fmu_build.frontend.flatten import flatten
from tests.fmu_build.conftest import Build, Writer
from tests.sampling import sampled

EQUATIONS = (
    "s := time; p := 2*s;",
    's := time "first := here"; // p := s;\n  p := 2*s; /* x := 3; */',
    "s := time; p := 2*u.s + a.p;",
    "if c then s := 1; p := s; elseif d then p := 2; s := 0; else s := 3; p := s; end if; q := p;",
    "s := if c then 1 else 2; p := s;",
    "if c then if d then s := 1; else s := 2; end if; p := s; else s := 3; p := if d then s else 4; end if;",
    "s := f(x = 1, y = {1, 2}); p := s^2;",
)
OTHERS = (
    "s := time; s := s + 1;",
    "p := 2*s; s := time;",
    "s := s + 1; p := 1;",
    "if c then s := 1; end if; p := s;",
    "if c then s := 1; else p := 2; end if;",
    "s := 1; if c then s := 2; else s := 3; end if;",
    "for i in 1:3 loop s := i; end for; p := s;",
    "when c then s := 1; end when; p := 2;",
    "(s, p) := f(time);",
    "x[1] := 1; x[2] := 2;",
    "a.s := time; p := 2*a.s;",
    's := 1; assert(s > 0, "no");',
)
AROUND = (
    "model M\n  Real s;\n{section}\n  {body}\n{after}end M;\n",
    "package P\n  function f\n    output Real y;\n  algorithm\n    y := 1; y := 2*y;\n  end f;\n"
    "  block 'end'\n{section}\n  {body}\n{after}  end 'end';\n  type E = enumeration(a, b);\nend P;\n",
)


@pytest.mark.parametrize(
    "after", ["", "equation\n  y = 1;\n", "protected\n  Real z;\n", 'annotation(Icon("s := 1"));\n']
)
@pytest.mark.parametrize("around", AROUND)
def test_sections_of_a_text(around: str, after: str) -> None:
    for body in (*EQUATIONS, *OTHERS):
        text = around.format(section="algorithm", body=body, after=after)
        result = as_equations(text)
        assert len(result) == len(text)
        if body in OTHERS:
            assert result == text, body
            continue
        code = "equation " + result.partition(f"{around.partition('{section}')[0]}equation ")[2]
        assert code.startswith("equation \n"), body
        restored = code[: len(body) + 12].replace(" =", ":=").split()
        assert restored == ["equation", *body.replace(" =", ":=").split()], body


@pytest.mark.parametrize("section", ["initial algorithm", "equation"])
def test_other_sections_stay(section: str) -> None:
    text = AROUND[0].format(section=section, body="s := time; p := 2*s;", after="")
    assert as_equations(text) == text


MODELS: dict[str, tuple[str, Callable[[NDArray[np.float64]], NDArray[np.float64]]]] = {
    "a chain": ("s := time;\n  p := 2*s;\n  q := p + s;", lambda t: 3 * t),
    "branches": (
        "if time < 0.5 then\n    s := 1;\n    p := s + time;\n  else\n    p := 4;\n    s := 2;\n  end if;\n  q := s*p;",
        lambda t: np.where(t < 0.5, 1 + t, 8),
    ),
    "an expression that chooses": (
        "s := time;\n  p := if s < 0.5 then 2*s else 3;\n  q := p;",
        lambda t: np.where(t < 0.5, 2 * t, 3),
    ),
}


@pytest.mark.parametrize("case", sampled(MODELS, {"branches"}))
def test_several_outputs(case: str, built: Build) -> None:
    body, exact = MODELS[case]
    declarations = "Real s, p, q;\n  Real x(start=0, fixed=true);"
    text = f"model M\n  {declarations}\nalgorithm\n  {body}\nequation\n  der(x) = 1;\nend M;"
    result = fmpy.simulate_fmu(str(built(text, 2)), stop_time=1.0, output_interval=0.0625, output=["q"])
    smooth = result["time"] != 0.5
    np.testing.assert_allclose(result["q"][smooth], exact(result["time"][smooth]), rtol=1e-12, atol=1e-12)


def test_what_is_assigned_twice_is_refused_with_a_remedy(modelica_file: Writer) -> None:
    path = modelica_file("model M\n  Real s, p;\nalgorithm\n  s := time;\n  s := 2*s;\n  p := s;\nend M;\n")
    with pytest.raises(BuildError, match=r"M.mo:3: .*needs two names; or write the section as a function"):
        flatten(path, "M")
