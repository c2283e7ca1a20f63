"""Functions, run on symbols."""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable

import fmpy
import numpy as np
import pytest
import sympy

from fmu_build.errors import BuildError
from fmu_build.ir.equations import Assignment
from fmu_build.ir.models import SortedModel
from fmu_build.ir.symbols import symbol
from tests.fmu_build.conftest import Build

Sorted = Callable[[str], SortedModel]

TIME = symbol("time")


def test_defaults_may_read_what_is_declared_elsewhere(sorted_model: Sorted) -> None:
    """In all orders that rumoca takes: what is read before what reads it, if both are outputs, or both are not."""
    outputs, others = ("public output Real y = a;", "public output Real z = y;"), ("Real p = y + 1;", "Real q = 2*p;")
    declarations = (*outputs, *(f"protected {other}" for other in others))
    orders = [
        "\n".join(order)
        for order in itertools.permutations(declarations)
        if all(order.index(declarations[first]) < order.index(declarations[first + 1]) for first in (0, 2))
    ]
    functions = [
        f"function f{i}\ninput Real a;\n{order}\nalgorithm\nz := z + q;\nend f{i};\n" for i, order in enumerate(orders)
    ]
    components = [f"Real x{i}, w{i};\n" for i in range(len(orders))]
    equations = [f"(x{i}, w{i}) = f{i}(time);\n" for i in range(len(orders))]
    model = sorted_model(f"model M\n{''.join(functions + components)}equation\n{''.join(equations)}end M;\n")
    found = {a.target: sympy.expand(a.expression) for a in model.assignments if isinstance(a, Assignment)}
    expected = {f"x{i}": TIME for i in range(len(orders))} | {f"w{i}": 3 * TIME + 2 for i in range(len(orders))}
    assert found == expected
    assert len(orders) == 6


ASSERTING = """
function root
  input Real x, least;
  output Real y;
algorithm
  assert(x >= least, "no root of " + String(x));
  y := sqrt(x);
end root;
model M
  Real x(start=1, fixed=true);
  Real y;
equation
  der(x) = -1;
  y = {};
end M;
"""


def test_what_a_function_asserts_counts_at_any_time(built: Build) -> None:
    said: list[str] = []
    with pytest.raises(fmpy.fmi1.FMICallException):
        text = ASSERTING.replace("{}", "1 + root(x, 0.5)")
        fmpy.simulate_fmu(str(built(text, 2)), stop_time=1, logger=lambda *message: said.append(str(message[-1])))
    assert re.search(r"no root of 0\.\d+ \(t = 0\.5", said[-1])


@pytest.mark.parametrize("value", ["if x > 0.5 then root(x, 0.5) else 0", "if x > 0.5 then 0 else root(1 + x, 0.5)"])
def test_it_is_refused_where_it_does_not_count_at_any_time(value: str, sorted_model: Sorted) -> None:
    with pytest.raises(BuildError, match=r"M\.mo:14: an assertion in a function that is called under a condition"):
        sorted_model(ASSERTING.replace("{}", value))


def test_it_is_none_where_it_is_known_to_hold(sorted_model: Sorted) -> None:
    assert sorted_model(ASSERTING.replace("{}", "if x > 0.5 then root(2, 0.5) else 0")).schedule.checks == ()


TABLE = """
function interpolated "As textbooks have it: y gets a value in the one interval that has x"
  input Real x := 0.0;
  input Real points[:, 2];
  output Real y(unit="1") "Value";
protected
  Real p;
algorithm
  for i in 1:size(points, 1) - 1 loop
    if x >= points[i, 1] and x <= points[i + 1, 1] then
      p := (x - points[i, 1])/(points[i + 1, 1] - points[i, 1]);
      y := p*points[i + 1, 2] + (1 - p)*points[i, 2];
    end if;
  end for;
end interpolated;
model Interpolation
  parameter Real points[:, 2] = [0, 0; 2, 0; 4, 2; 6, 0; 8, 0];
  output Real y;
equation
  y = interpolated(time, points);
end Interpolation;
"""


@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
def test_an_output_that_only_branches_assign(kind: str, built: Build) -> None:
    result = fmpy.simulate_fmu(str(built(TABLE, 2)), stop_time=7, output_interval=0.133, fmi_type=kind)
    expected = np.interp(result["time"], [0, 2, 4, 6, 8], [0, 0, 2, 0, 0])
    assert result["y"] == pytest.approx(expected, abs=1e-12)


def test_where_no_branch_assigns_it_the_run_ends(built: Build) -> None:
    said: list[str] = []
    with pytest.raises(fmpy.fmi1.FMICallException):
        fmpy.simulate_fmu(str(built(TABLE, 2)), stop_time=9, logger=lambda *message: said.append(str(message[-1])))
    assert re.search(r"y = NaN is not finite at t = 8", " ".join(said))


@pytest.mark.parametrize(
    ("body", "remedy"),
    [
        (
            "y := 0; for i in 1:n loop y := y + x^i; if i >= 2 then break; end if; end for;",
            "write the loop without break",
        ),
        ("y := 0; i := 1; while i <= n loop y := y + x^i; i := i + 1; end while;", "in place of the while"),
    ],
)
def test_what_is_refused_says_what_to_write(body: str, remedy: str, sorted_model: Sorted) -> None:
    function = f"function f input Real x; input Integer n; output Real y; protected Integer i; algorithm {body} end f;"
    with pytest.raises(BuildError, match=rf"M\.mo:1: .*{remedy}"):
        sorted_model(f"{function}\nmodel M Real y = f(time, 3); end M;")
