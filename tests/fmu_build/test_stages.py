"""From equations to C: what is sorted, solved and printed computes what the Modelica says."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from fmu_build.equations.derive import derive
from fmu_build.equations.sort import sort
from fmu_build.frontend.flatten import flatten
from fmu_build.ir.models import SortedModel
from fmu_build.ir.symbols import relation_of
from tests.fmu_build.conftest import CompiledModel
from tests.sampling import spread

Compile = Callable[[str], CompiledModel]

TWO_MASSES = """
model M
  parameter Real m(unit="kg") = 2;
  parameter Real c(unit="N/m") = 3;
  parameter Real gap(unit="m") = 0.1;
  Real x(unit="m", start=gap/2, fixed=true);
  Real y(unit="m", start=0, fixed=true);
  Real v(unit="m/s", start=1, fixed=true);
  Real w(unit="m/s", start=0, fixed=true);
  Real s_rel(unit="m");
  Real v_rel(unit="m/s");
  Real f(unit="N");
  Real minus_f(unit="N");
equation
  v = der(x);
  w = der(y);
  s_rel = y - x;
  v_rel = der(s_rel);
  f = -minus_f;
  f = if s_rel >= gap then c*(s_rel - gap)*exp(s_rel)
      elseif s_rel < -gap then 2*c*(s_rel + gap) + v_rel^3
      else sin(time)*v;
  m*der(v) = f;
  m*der(w) = minus_f + x*y/(1 + v*v);
end M;
"""


def test_a_variable_tied_to_states_is_no_state(sorted_model: Callable[[str], SortedModel]) -> None:
    model = sorted_model(TWO_MASSES)
    assert set(model.states) == {"x", "y", "v", "w"}
    assert model.variables["der(s_rel)"].unit == "m/s"


def test_every_assignment_uses_only_what_is_known_before(sorted_model: Callable[[str], SortedModel]) -> None:
    model = sorted_model(TWO_MASSES)
    known = {"time", *model.states, *model.parameters, *model.inputs}
    for assignment in model.assignments:
        used = {s.name for s in assignment.expression.free_symbols if relation_of(s) is None}
        assert used <= known
        known.add(assignment.target)


@pytest.mark.parametrize("s_rel", [0.5, 0.02, -0.6])
def test_jacobian_against_central_differences(compiled_model: Compile, s_rel: float) -> None:
    model = compiled_model(TWO_MASSES)
    values = {"time": 0.7, "x": 0.3, "y": 0.3 + s_rel, "v": 0.8, "w": -0.4}
    for name, value in values.items():
        model[name] = value
    exact = model.jacobian()
    step = 1e-6
    for column, name in enumerate((*model.model.states, "time")):
        model[name] = values[name] + step
        above = model.derivatives()
        model[name] = values[name] - step
        below = model.derivatives()
        model[name] = values[name]
        np.testing.assert_allclose(exact[:, column], (above - below) / (2 * step), rtol=1e-7, atol=1e-8)


def test_all_regimes_and_start_values(compiled_model: Compile) -> None:
    model = compiled_model(TWO_MASSES)
    assert model["x"] == 0.05 and model["y"] == 0.0
    for s_rel, force in [(0.1, 0.0), (0.6, 3 * 0.5 * np.exp(0.6)), (-0.3, 2 * 3 * -0.2 + (-1.5) ** 3), (0.0, 0.0)]:
        model["time"], model["x"], model["y"], model["v"], model["w"] = 0.0, 1.0, 1.0 + s_rel, 1.0, -0.5
        if s_rel == 0.1:  # the condition is >=, and 1.1 - 1 is a little more than 0.1
            force = 3 * (1.1 - 1.0 - 0.1) * np.exp(0.1)
        model.outputs()
        assert model["f"] == pytest.approx(force, rel=1e-12, abs=1e-15)
        assert model["minus_f"] == -model["f"]
        assert model["v_rel"] == pytest.approx(-1.5)


def test_greater_or_equal_holds_at_equality(compiled_model: Compile) -> None:
    text = "model M\n  Real x(start=0, fixed=true);\nequation\n  der(x) = if x >= 1 then 5 else 7;\nend M;"
    model = compiled_model(text)
    for x, rate in [(0.5, 7.0), (1.0, 5.0), (1.5, 5.0)]:
        model["x"] = x
        assert model.derivatives()[0] == rate


def test_a_linear_loop_is_solved_together(compiled_model: Compile) -> None:
    text = """
model M
  parameter Real a = 2;
  Real x(start=1, fixed=true);
  Real p;
  Real q;
equation
  der(x) = p + q;
  a*p + q = 3*x;
  p - q = if x > 0 then x else -x;
end M;"""
    model = compiled_model(text)
    model.outputs()
    np.testing.assert_allclose([2 * model["p"] + model["q"], model["p"] - model["q"]], [3.0, 1.0], rtol=1e-15)
    np.testing.assert_allclose(model.jacobian()[0, 0], 4 / 3 + 1 / 3, rtol=1e-14)


def test_calculated_parameters_follow_their_order(compiled_model: Compile) -> None:
    text = """
model M
  parameter Real area = side^2;
  parameter Real side = 1/density;
  parameter Real density = 0.25;
  final parameter Real fixed_one = 10;
  Real x(start=area + fixed_one, fixed=true);
equation
  der(x) = -x;
end M;"""
    model = compiled_model(text)
    assert model.model.parameters == ("density",)
    assert (model["side"], model["area"], model["x"]) == (4.0, 16.0, 26.0)


def test_relations_of_equal_residual_are_one(modelica_library: Path) -> None:
    model = sort(derive(flatten(modelica_library, "OverrunHitch.Systems.CarTrailer")))
    assert [r.text for r in model.relations] == [
        "compression < 0",
        "compression <= eps",
        "compression <= s_1",
        "compression <= s_2",
        "compression <= s_3",
        "compression <= s_4",
        "sense*v_rel < 0",
        "F_free < -F_pull_max",
        "F_free > F_pull_max",
    ]
    assert len(model.states) == 12


def test_names_that_c_forbids_or_confuses(compiled_model: Compile) -> None:
    text = """
model A
  Real b_c = 3;
end A;
model M
  A a;
  Real a_b_c = 5;
  Real double(start=1, fixed=true);
equation
  der(double) = a.b_c*a_b_c;
end M;"""
    assert compiled_model(text).derivatives()[0] == 15.0


def test_partial_derivatives_of_names_that_c_confuses(compiled_model: Compile) -> None:
    text = """
model A
  Real b;
end A;
model M
  A a;
  Real a_b;
  Real x(start=1, fixed=true);
equation
  a_b = x*sin(x);
  a.b = x*cos(x);
  der(x) = sin(a_b) + 2*cos(a.b);
end M;"""
    model = compiled_model(text)
    one, other = np.sin(1.0), np.cos(1.0)
    slope = np.cos(one) * (one + other) - 2 * np.sin(other) * (other - one)
    assert model.jacobian()[0, 0] == pytest.approx(slope, rel=1e-14)


@pytest.mark.parametrize(
    "loop",
    ["w = x*u + p", "w + sin(w) = x*u + p + time", "w + 2*z = u; z - w*p = x; y = z", "w = if time > p then u else x"],
)
def test_tangent_by_inputs_is_the_tangent_of_the_derivatives(compiled_model: Compile, loop: str) -> None:
    more = "Real z; Real y;" if "z" in loop else ""
    model = compiled_model(
        f"""model M
  parameter Real p = 0.3;
  input Real u(start=0.7);
  input Real unused;
  Real x(start=1, fixed=true); Real v(start=2, fixed=true); Real w; Real q; {more}
equation
  {loop};
  der(x) = w*v + p;
  der(v) = cos(w)*u - time*x;
  q = u*w*p;
end M;"""
    )
    model["time"] = 0.4
    model.outputs()
    for name in ("time", *model.model.inputs):
        whole, brief = model.tangent({name: 1.0}, at_start=False), model.input_tangent({name: 1.0})
        derivatives = model.model.derivatives
        np.testing.assert_array_equal([brief[d] for d in derivatives], [whole[d] for d in derivatives])


@pytest.mark.parametrize(("s_rel", "at_start"), spread([0.5, 0.02, -0.6], [False, True]))
def test_tangent_against_differences_and_adjoint_against_tangent(
    compiled_model: Compile, s_rel: float, at_start: bool
) -> None:
    model = compiled_model(TWO_MASSES)
    known = ["time", *model.model.states, *model.model.parameters]
    if at_start:
        known.remove("x")  # it follows from the parameter gap
    for name, value in {"time": 0.7, "x": 0.05, "y": 0.05 + s_rel, "v": 0.8, "w": -0.4}.items():
        model[name] = value
    model.outputs()
    computed = [a.target for a in model.model.assignments]
    tangents = np.array([[model.tangent({name: 1.0}, at_start)[c] for c in computed] for name in known])
    adjoints = np.array([[model.adjoint({c: 1.0}, at_start)[name] for c in computed] for name in known])
    np.testing.assert_allclose(adjoints, tangents, rtol=1e-14, atol=1e-14)
    step = 1e-6
    for row, name in enumerate(known):
        values = []
        for sign in (1, -1):
            before = model[name]
            model[name] = before + sign * step
            if at_start and name == "gap":
                model["x"] = model["gap"] / 2
            model.outputs()
            values.append([model[c] for c in computed])
            model[name] = before
            if at_start and name == "gap":
                model["x"] = before / 2
        difference = (np.array(values[0]) - np.array(values[1])) / (2 * step)
        np.testing.assert_allclose(tangents[row], difference, rtol=1e-7, atol=1e-8)


def test_outputs_of_a_function_that_are_left_out(compiled_model: Compile) -> None:
    text = """
model M
  function f
    input Real u;
    output Real a = 2*u;
    output Real b = 3*u;
    output Real c = 4*u;
  algorithm
  end f;
  Real x;
  Real z;
  Real w(start=1, fixed=true);
equation
  der(w) = -w;
  (x, , z) = f(w);
end M;"""
    model = compiled_model(text)
    model.outputs()
    assert (model["x"], model["z"]) == (2.0, 4.0)


def test_derivatives_by_an_input_are_the_derivatives(compiled_model: Compile) -> None:
    """To the bit; y, which none of them needs, keeps its value."""
    text = """
model M
  input Real u;
  input Real w;
  Real x(start=0.3, fixed=true);
  Real z(start=0.7, fixed=true);
  Real p;
  Real y;
equation
  p = sin(x) + u*x;
  y = w + p;
  der(x) = -x*p + z;
  der(z) = -cos(z);
end M;"""
    model = compiled_model(text)
    for u in (0.1, 2.7, -0.3):
        model.outputs()
        model["u"] = u
        y = model["y"]
        by = model.derivatives_by("u")
        assert model["y"] == y
        np.testing.assert_array_equal(by, model.derivatives())
