"""Algebraic loops: what is found, derivatives through them, and what is said where there is no solution."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import fmpy
import numpy as np
import pytest

from fmu_build.ir.equations import Loop
from fmu_build.ir.models import SortedModel
from fmu_build.ir.symbols import Kind, kind_of
from tests.fmu_build.conftest import Build, CompiledModel
from tests.unit import Unit

Compile = Callable[[str], CompiledModel]

NONLINEAR = """
model M
  parameter Real k = 2;
  Real x(start=0.5, fixed=true);
  Real y(start=1, fixed=true);
  Real a, b, c, f;
equation
  der(x) = a - x*b;
  der(y) = f + sin(time);
  k*a + exp(b) = 3 + x;
  b = c*y - a;
  c = time + a^3/5;
  f = if c > 0 then a*b else -a*b;
end M;"""

LINEAR = """
model M
  parameter Real k[3] = {1, 0, 2};
  Real x(start=0.5, fixed=true);
  Real p[3];
  Real q;
equation
  der(x) = p[1] - 2*p[3];
  k[1]*p[1] - x*p[2] = q;
  k[2]*p[2] + p[3]*(1 + x) + p[1] = time;
  k[3]*p[3] - p[1] = sin(x);
  q = if x > 0 then p[1] + 2*p[2] else p[3];
end M;"""


def test_a_nonlinear_loop_is_solved_and_torn(
    sorted_model: Callable[[str], SortedModel], compiled_model: Compile
) -> None:
    (loop,) = [block for block in sorted_model(NONLINEAR).assignments if isinstance(block, Loop)]
    assert not loop.is_linear and len(loop.iterated) < len(loop.unknowns) == 3
    model = compiled_model(NONLINEAR)
    model["x"], model["y"], model["time"] = 0.3, 0.8, 0.2
    model.outputs()
    a, b, c = (model[name] for name in "abc")
    np.testing.assert_allclose([2 * a + np.exp(b), b, c], [3.3, 0.8 * c - a, 0.2 + a**3 / 5], rtol=1e-14)


@pytest.mark.parametrize("text", [NONLINEAR, LINEAR])
def test_derivatives_through_a_loop(text: str, compiled_model: Compile) -> None:
    model = compiled_model(text)
    known = ["time", *model.model.states, *model.model.parameters]
    model["time"] = 0.4
    model.outputs()
    computed = [name for b in model.model.assignments for name in b.targets if kind_of(name) is not Kind.GUESS]
    tangents = np.array([[model.tangent({name: 1.0}, False)[c] for c in computed] for name in known])
    adjoints = np.array([[model.adjoint({c: 1.0}, False)[name] for c in computed] for name in known])
    np.testing.assert_allclose(adjoints, tangents, rtol=1e-12, atol=1e-12)
    step = 1e-6
    for row, name in enumerate(known):
        values = []
        before = model[name]
        for sign in (1, -1):
            model[name] = before + sign * step
            model.outputs()
            values.append(np.array([model[c] for c in computed]))
        model[name] = before
        model.outputs()
        np.testing.assert_allclose(tangents[row], (values[0] - values[1]) / (2 * step), rtol=2e-7, atol=1e-8)
    rows = [computed.index(name) for name in model.model.derivatives]
    by_states = tangents[[*range(1, 1 + len(rows)), 0]][:, rows].T
    np.testing.assert_allclose(model.jacobian(), by_states, rtol=1e-13, atol=1e-13)


def test_a_loop_of_a_hundred_unknowns(compiled_model: Compile) -> None:
    text = """
model M
  parameter Integer n = 100;
  Real x(start=1, fixed=true);
  Real u[n];
equation
  der(x) = -u[50];
  u[1] = x;
  for i in 2:n - 1 loop
    u[i - 1] - 2.01*u[i] + u[i + 1] = 0;
  end for;
  u[n] = u[n - 1]/2;
end M;"""
    model = compiled_model(text)
    model.outputs()
    matrix = np.diag(np.full(100, -2.01)) + np.diag(np.ones(99), 1) + np.diag(np.ones(99), -1)
    matrix[0, :2], matrix[-1, -2:] = (1, 0), (-0.5, 1)
    u = np.linalg.solve(matrix, [1.0, *[0.0] * 99])
    np.testing.assert_allclose([model[f"u[{i + 1}]"] for i in range(100)], u, rtol=1e-12, atol=1e-16)
    assert model.jacobian()[0, 0] == pytest.approx(-u[49], rel=1e-12)


def test_where_there_is_no_solution_the_unknowns_are_named(built: Build) -> None:
    text = (
        "model M\n  Real x(start=0, fixed=true);\n  Real y(start=1);\nequation\n  der(x) = 1;\n  y^2 + x = 1;\nend M;"
    )
    fmu = str(built(text, 2))
    messages: list[str] = []

    def log(environment: object, instance: bytes, status: int, category: bytes, message: bytes) -> None:
        messages.append(message.decode())

    result = fmpy.simulate_fmu(fmu, stop_time=0.75, output=["y"], logger=log)
    assert result["y"][-1] == pytest.approx(0.5, rel=1e-9)
    with pytest.raises(fmpy.fmi1.FMICallException, match="fmi2DoStep"):
        fmpy.simulate_fmu(fmu, stop_time=1.5, logger=log)
    assert any("no solution was found of the nonlinear equations of y (M.mo:6)" in text for text in messages)


def test_a_rollback_is_bit_equal(built: Build, tmp_path: Path) -> None:
    unit = Unit(built(NONLINEAR, 2), tmp_path)
    unit.slave.instantiate()
    unit.start(k=2.0)
    unit.slave.doStep(0.0, 0.3)
    kept = unit.slave.getFMUState()
    unit.slave.doStep(0.3, 0.3)
    first = unit.get("x", "y", "a", "b", "c").tobytes()
    unit.slave.setFMUState(kept)
    unit.slave.doStep(0.3, 0.3)
    assert unit.get("x", "y", "a", "b", "c").tobytes() == first
    unit.slave.freeFMUState(kept)
