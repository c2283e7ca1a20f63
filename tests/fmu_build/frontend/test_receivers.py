"""A function's last outputs need no receiver (Modelica 3.6, section 12.4.3)."""

from __future__ import annotations

from pathlib import Path

import fmpy
import pytest

from fmu_build.errors import BuildError
from fmu_build.frontend.flatten import flatten
from fmu_build.frontend.receivers import with_all_receivers
from tests.fmu_build.conftest import Build

MODEL = """model Few
  function f
    input Real u;
    input Real v = 1;
    output Real a;
    output Real b;
    output Real c[2];
  algorithm
    a := u;
    b := 2*u + v;
    c := {{3*u, 4*u}};
  end f;
  function g
    input Real u[:];
    output Real s;
    output Real p;
    output Integer n;
  algorithm
    n := size(u, 1);
    s := sum(u);
    p := product(u);
  end g;
  Real a, b, q, s;
{equations}
end Few;
"""
EQUATION = "equation\n  (a, b) = f(time, max(0, 2));\n  (q, s) = g({{time, 2, 3}});"
ALGORITHM = EQUATION.replace("equation", "algorithm").replace(" = ", " := ")


@pytest.mark.parametrize("equations", [EQUATION, ALGORITHM])
def test_of_two_functions(equations: str, built: Build) -> None:
    fmu = built(MODEL.format(equations=equations.format()), 2)
    found = fmpy.simulate_fmu(str(fmu), stop_time=1.5, output=["a", "b", "q", "s"])[-1]
    assert list(found)[1:] == pytest.approx([1.5, 5.0, 6.5, 9.0], rel=1e-12)


def test_too_many_are_refused_where_they_are(tmp_path: Path) -> None:
    """And not in another file of the library that has a fault, which the class does not need."""
    (tmp_path / "package.mo").write_text("package Few\nend Few;\n", encoding="utf-8")
    (tmp_path / "Another.mo").write_text("within Few;\nmodel Another\n  Real x = ;\nend Another;\n", encoding="utf-8")
    text = MODEL.format(equations="equation\n  (a, b, , q) = f(time);\n  s = 1;").replace("Few", "Own")
    (tmp_path / "Own.mo").write_text(f"within Few;\n{text}", encoding="utf-8")
    said = r"Own\.mo:3: .*f` returns 3 values but the receiving tuple has 4 slots"
    with pytest.raises(BuildError, match=said):
        flatten(tmp_path / "package.mo", "Few.Own")


@pytest.mark.parametrize(
    ("text", "becomes"),
    [
        ("(x, y) = f(1);", "(x, y, ) = f(1);"),
        ("(x[size(y, 1)], z[1, 2]) := P.f(1);", "(x[size(y, 1)], z[1, 2], ) := P.f(1);"),
        ("(, y) = f (1);", "(, y, ) = f (1);"),
        ("(x) = f(1);", "(x) = f(1);"),  # one value, as in an expression, and not what was told
        ("(x, y) = ff(1); (x, y, z) = f(1); c = (a + b)*f(1);", ""),
    ],
)
def test_receivers_alone_are_added(text: str, becomes: str) -> None:
    said = "`P.f` returns 3 values but the receiving tuple has 2 slots"
    assert with_all_receivers(text, said) == (becomes or text)
