"""Equations that tie states to each other, and start values that follow from one another."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import fmpy
import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from fmu_build.errors import BuildError
from fmu_build.pipeline import build
from tests.fmu_build.cases import Case, Columns, check
from tests.fmu_build.conftest import Build, CompiledModel, Writer
from tests.sampling import spread

PENDULUM = """
model M "A pendulum in x and y"
  parameter Real m = 2, g = 9.81, L = 0.5;
  Real x(start=L), y(start=0), v_x, v_y;
  Real F "Force in the rod";
equation
  der(x) = v_x;
  der(y) = v_y;
  m*der(v_x) = -x/L*F;
  m*der(v_y) = -y/L*F - m*g;
  x^2 + y^2 = L^2;
end M;
"""


def swings(times: NDArray[np.float64]) -> Columns:
    """The same in its angle from the vertical."""
    solved = solve_ivp(
        lambda t, s: [s[1], -9.81 / 0.5 * np.sin(s[0])], (0, times[-1]), [np.pi / 2, 0], "Radau", times, rtol=1e-11
    )
    angle, rate = solved.y
    return {"x": 0.5 * np.sin(angle), "y": -0.5 * np.cos(angle), "F": 2 * (0.5 * rate**2 + 9.81 * np.cos(angle))}


CASES = {
    "pendulum in x and y": Case(PENDULUM, 3.0, swings, cvode=1e-10),
    "the same by a variable of its own": Case(
        PENDULUM.replace("x^2 + y^2 = L^2", "r_2 = x^2 + y^2;\n  r_2 = L^2").replace("Real F", "Real r_2, F"),
        3.0,
        swings,
        cvode=1e-10,
    ),
    "fixed start values that meet the constraint": Case(
        PENDULUM.replace("x(start=L), y(start=0)", "x(start=L, fixed=true), y(start=0, fixed=true)"),
        3.0,
        swings,
        cvode=1e-10,
    ),
    "a constraint in one state": Case(
        """
model M
  parameter Real a = 2;
  Real x(start=0.9, fixed=true), y(start=0);
equation
  (1 + 0.5*sin(y))*der(x) + der(y) = a*sin(time);
  x - y = exp(-0.9*x)*cos(y);
end M;""",
        2.0,
    ),
    "two rods": Case(
        """
model M
  parameter Real g = 9.81;
  Real x_1(start=1), y_1(start=0), u_1, v_1, F_1;
  Real x_2(start=2), y_2(start=0), u_2, v_2, F_2;
equation
  der(x_1) = u_1;
  der(y_1) = v_1;
  der(x_2) = u_2;
  der(y_2) = v_2;
  der(u_1) = -x_1*F_1 + (x_2 - x_1)*F_2;
  der(v_1) = -y_1*F_1 + (y_2 - y_1)*F_2 - g;
  der(u_2) = -(x_2 - x_1)*F_2;
  der(v_2) = -(y_2 - y_1)*F_2 - g;
  x_1^2 + y_1^2 = 1;
  (x_2 - x_1)^2 + (y_2 - y_1)^2 = 1;
end M;""",
        1.0,
        cvode=1e-10,
    ),
    "fixed start values of all that a constraint ties": Case(
        """
model M "A wheel that rolls"
  parameter Real r = 0.5;
  Real s(start=0, fixed=true), v(start=0, fixed=true), phi(start=0, fixed=true), w(start=0, fixed=true), F;
equation
  der(s) = v;
  der(phi) = w;
  s = r*phi;
  2*der(v) = 10*sin(time) - F;
  0.3*der(w) = F*r;
end M;""",
        2.0,
        lambda t: {"v": 10 / 3.2 * (1 - np.cos(t))},
    ),
    "a gear whose far side has the start value": Case(
        """
model M
  parameter Real ratio = 3;
  Real phi_1(stateSelect=StateSelect.prefer), w_1, tau, phi_2(start=0.1, fixed=true), w_2(start=0.2, fixed=true);
equation
  der(phi_1) = w_1;
  der(phi_2) = w_2;
  phi_1 = ratio*phi_2 + 1;
  der(w_1) = tau;
  4*der(w_2) = -ratio*tau - 52*phi_2;
end M;""",
        3.0,
        lambda t: {"phi_2": 0.1 * np.cos(2 * t) + 0.1 * np.sin(2 * t)},
    ),
    "the start value of an alias": Case(
        """
model M
  type Temperature = Real(unit="K", start=288);
  connector Port
    Temperature T;
    flow Real Q;
  end Port;
  model Body
    Port port;
    Temperature T(start=300);
  equation
    T = port.T;
    der(T) = port.Q;
  end Body;
  model Surroundings
    Port port;
  equation
    port.Q = 0.5*(port.T - 280);
  end Surroundings;
  Surroundings surroundings;
  Body body;
equation
  connect(surroundings.port, body.port);
end M;""",
        2.0,
        lambda t: {"body.port.T": 280 + 20 * np.exp(-t / 2)},
    ),
    "start values by a nonlinear equation": Case(
        """
model M
  Real x(start=10), y(start=10);
initial equation
  der(x) = 2*y;
  x/2 + y^2 = 5;
equation
  der(x) = x*(0.1 - 0.02*y);
  der(y) = y*(0.02*x - 0.4);
end M;""",
        1.0,
    ),
}


@pytest.mark.parametrize(("name", "fmi"), spread(CASES, [2, 3], every=3))
def test_a_model_against_an_independent_solution(name: str, fmi: int, built: Build) -> None:
    check(CASES[name], fmi, built)


@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
def test_the_rod_keeps_its_length(kind: str, built: Build) -> None:
    """Errors of the constraint fade: after a hundred seconds it is as good as after one."""
    result = fmpy.simulate_fmu(
        str(built(PENDULUM, 2)),
        fmi_type=kind,
        stop_time=100,
        output_interval=0.1,
        relative_tolerance=1e-7,
        output=["x", "y"],
    )
    error = np.abs(result["x"] ** 2 + result["y"] ** 2 - 0.25)
    early, late = error[result["time"] < 10].max(), error[result["time"] > 90].max()
    print(f"{kind}: off by {early:.1e} m2 in the first ten seconds, by {late:.1e} in the last")
    assert late < 3 * early < 1e-5


def test_fixed_start_values_that_contradict_a_constraint(modelica_file: Writer, tmp_path: Path) -> None:
    text = PENDULUM.replace("x(start=L), y(start=0)", "x(start=L, fixed=true), y(start=0.2, fixed=true)")
    with pytest.raises(BuildError, match=r"M\.mo:11: the fixed start values contradict this equation, by 0\.04"):
        build(modelica_file(text), "M", tmp_path / "M.fmu")


SINGULAR = """
model M "At the start values, zero, no slope tells where to look"
  Real x, y;
  Real z(start=1, fixed=true);
equation
  x^2 = 1 + y;
  x*y = 0.1*z;
  der(z) = -z;
end M;
"""


def test_a_search_that_begins_where_nothing_leads_on(compiled_model: Callable[[str], CompiledModel]) -> None:
    model = compiled_model(SINGULAR)
    model.outputs()
    x, y = model["x"], model["y"]
    assert (x**2 - 1 - y, x * y - 0.1) == pytest.approx((0, 0), abs=1e-12)
