"""Small models, each over one construct, as FMI 2 and 3, Co-Simulation and Model Exchange, against independent results.

What they are compared with is a closed form, SciPy's solution of the same equations written by hand, or rumoca's own
simulation.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.linalg import expm

from tests.fmu_build.cases import Case, Columns, check, solution
from tests.fmu_build.conftest import Build
from tests.sampling import spread


def rod(times: NDArray[np.float64]) -> Columns:
    """Ten cells between insulated ends: T(t) = exp(A t) T(0)."""
    n = 10
    a = 2.0 * (np.diag(np.full(n - 1, 1.0), 1) + np.diag(np.full(n - 1, 1.0), -1) - 2 * np.eye(n))
    a[0, 0] = a[-1, -1] = -2.0
    start = np.linspace(300, 400, n)
    profiles = np.array([expm(a * t) @ start for t in times])
    return {f"T[{i + 1}]": profiles[:, i] for i in range(n)}


def kepler(times: NDArray[np.float64]) -> Columns:
    """Kepler's equation by bisection."""
    low, high = 2 * times - 1, 2 * times + 1
    for _ in range(60):
        middle = (low + high) / 2
        is_low = middle - 0.6 * np.sin(middle) < 2 * times
        low, high = np.where(is_low, middle, low), np.where(is_low, high, middle)
    return {"E": low}


CASES = {
    "rod by for": Case(
        """
model M
  parameter Integer n = 10;
  parameter Real k(unit="1/s") = 2;
  Real T[n](start=linspace(300, 400, n), each fixed=true, each unit="K");
  Real Q[n + 1](each unit="K/s");
equation
  Q[1] = 0;
  for i in 2:n loop
    Q[i] = k*(T[i - 1] - T[i]);
  end for;
  Q[n + 1] = 0;
  for i in 1:n loop
    der(T[i]) = Q[i] - Q[i + 1];
  end for;
end M;""",
        1.0,
        rod,
    ),
    "rod by array equations": Case(
        """
model M
  parameter Integer n = 10;
  parameter Real k(unit="1/s") = 2;
  Real T[n](start={300 + 100*(i - 1)/(n - 1) for i in 1:n}, each fixed=true, each unit="K");
equation
  der(T[1]) = k*(T[2] - T[1]);
  der(T[2:n - 1]) = k*(T[1:n - 2] - 2*T[2:n - 1] + T[3:n]);
  der(T[n]) = k*(T[n - 1] - T[n]);
end M;""",
        1.0,
        rod,
    ),
    "reactions with enumerated arrays": Case(
        """
model M
  type Species = enumeration(A, B, X);
  parameter Real k[3] = {0.1, 0.1, 10};
  Real c[Species](start={1, 1, 0}, each fixed=true, nominal={1, 1, 0.01});
equation
  der(c[Species.A]) = k[2]*c[Species.X] - k[1]*c[Species.A]*c[Species.B];
  der(c[Species.B]) = k[2]*c[Species.X] - k[1]*c[Species.A]*c[Species.B] - k[3]*c[Species.B]*c[Species.X];
  der(c[Species.X]) = k[1]*c[Species.A]*c[Species.B] - k[2]*c[Species.X] - k[3]*c[Species.B]*c[Species.X];
end M;""",
        5.0,
        solution(
            "c[1] c[2] c[3]",
            lambda t, c: [
                0.1 * c[2] - 0.1 * c[0] * c[1],
                0.1 * c[2] - 0.1 * c[0] * c[1] - 10 * c[1] * c[2],
                0.1 * c[0] * c[1] - 0.1 * c[2] - 10 * c[1] * c[2],
            ],
            [1, 1, 0],
        ),
    ),
    "pendulum": Case(
        """
model M
  constant Real g = 9.81;
  parameter Real L = 2;
  Real phi(start=1.5, fixed=true);
  Real w(start=0, fixed=true);
  Real r[2] = L*{sin(phi), -cos(phi)};
equation
  der(phi) = w;
  L*der(w) = -g*sin(phi);
end M;""",
        3.0,
        solution("phi w", lambda t, y: [y[1], -9.81 / 2 * np.sin(y[0])], [1.5, 0]),
    ),
    "two masses and a linear loop": Case(
        """
model M
  parameter Real m[2] = {1, 2};
  Real v[2](start={1, 0}, each fixed=true);
  Real a[2];
  Real f;
equation
  der(v) = a;
  m[1]*a[1] = -f;
  m[2]*a[2] = f - v[2];
  f = 3*(v[1] - v[2]) + 0.5*(a[1] - a[2]);
end M;""",
        3.0,
        solution(
            "v[1] v[2]",
            lambda t, v: np.linalg.solve([[1, 0, 1], [0, 2, -1], [-0.5, 0.5, 1]], [0, -v[1], 3 * (v[0] - v[1])])[:2],
            [1, 0],
        ),
    ),
    "diode and a nonlinear loop": Case(
        """
model M
  parameter Real R = 10, C = 0.01, Is = 1e-9, Vt = 0.025;
  Real u = 5*sin(20*time);
  Real u_C(start=0, fixed=true);
  Real u_D, i;
equation
  u = R*i + u_D + u_C;
  i = Is*(exp(u_D/Vt) - 1);
  C*der(u_C) = i - u_C/100;
end M;""",
        1.0,
    ),
    "Kepler's equation": Case(
        "model M\n  Real E;\nequation\n  2*time = E - 0.6*sin(E);\nend M;", 3.0, kepler, tolerance=1e-12
    ),
    "Van der Pol, stiff": Case(
        """
model M
  parameter Real mu = 1000;
  Real x(start=2, fixed=true);
  Real y(start=0, fixed=true, nominal=1e-3);
equation
  der(x) = y;
  der(y) = mu*(1 - x^2)*y - x;
end M;""",
        1000.0,
        solution("x", lambda t, y: [y[1], 1000 * (1 - y[0] ** 2) * y[1] - y[0]], [2, 0]),
        tolerance=1e-5,
        cvode=1e-6,
        cvode_error=1e-4,
    ),
    "Roberts' kinetics": Case(
        """
model M
  Real y[3](start={1, 0, 0}, fixed={true, true, false}, nominal={1, 1e-5, 1});
equation
  der(y[1]) = -0.04*y[1] + 1e4*y[2]*y[3];
  der(y[2]) = 0.04*y[1] - 1e4*y[2]*y[3] - 3e7*y[2]^2;
  sum(y) = 1;
end M;""",
        40.0,
        solution(
            "y[1] y[2]",
            lambda t, y: [
                -0.04 * y[0] + 1e4 * y[1] * (1 - y[0] - y[1]),
                0.04 * y[0] - 1e4 * y[1] * (1 - y[0] - y[1]) - 3e7 * y[1] ** 2,
            ],
            [1, 0],
        ),
    ),
    "a function with a loop": Case(
        """
model M
  function root
    input Real a;
    output Real x;
  algorithm
    x := a;
    for i in 1:12 loop
      x := 0.5*(x + a/x);
    end for;
  end root;
  Real x(start=4, fixed=true);
equation
  der(x) = -root(x);
end M;""",
        2.0,
        lambda t: {"x": (2 - t / 2) ** 2},
    ),
    "records": Case(
        """
record Point
  Real x;
  Real y;
end Point;
function turned
  input Point p;
  input Real angle;
  output Point q;
algorithm
  q.x := cos(angle)*p.x - sin(angle)*p.y;
  q.y := sin(angle)*p.x + cos(angle)*p.y;
end turned;
model M
  parameter Point start(x=1, y=0.5);
  Point p = turned(start, 2*time);
  Real length = sqrt(p.x^2 + p.y^2);
end M;""",
        2.0,
        lambda t: {"p.x": np.cos(2 * t) - 0.5 * np.sin(2 * t), "p.y": np.sin(2 * t) + 0.5 * np.cos(2 * t)},
    ),
    "state space": Case(
        """
block StateSpace
  parameter Real A[:, size(A, 1)];
  parameter Real B[size(A, 1), :];
  parameter Real C[:, size(A, 1)];
  input Real u[size(B, 2)];
  output Real y[size(C, 1)];
  Real x[size(A, 1)](each start=0, each fixed=true);
equation
  der(x) = A*x + B*u;
  y = C*x;
end StateSpace;
model M
  StateSpace system(A=[0, 1; -4, 0], B=[0; 1], C=[1, 0]);
equation
  system.u = {1};
end M;""",
        3.0,
        lambda t: {"system.y[1]": (1 - np.cos(2 * t)) / 4},
    ),
    "an equation that hides a constraint": Case(
        """
model M
  parameter Real ratio = 3;
  Real phi_1, w_1, tau_1, phi_2(start=0.1, fixed=true), w_2(start=0, fixed=true), tau_2;
equation
  der(phi_1) = w_1;
  der(phi_2) = w_2;
  phi_1 = ratio*phi_2;
  ratio*tau_1 + tau_2 = 0;
  0.5*der(w_1) = tau_1;
  der(w_2) = tau_2 - 22*phi_2;
end M;""",
        3.0,
        lambda t: {"phi_2": 0.1 * np.cos(2 * t), "w_1": -0.6 * np.sin(2 * t)},
    ),
    "inputs with values, components under conditions": Case(
        """
model Decay
  Real x(start=1, fixed=true);
equation
  der(x) = -x;
end Decay;
model M
  parameter Boolean both = false;
  Decay a, b if both;
  input Real u = 2;
  input Real w = 3*time;
  Real y(start=0, fixed=true);
equation
  der(y) = u + w;
end M;""",
        2.0,
        lambda t: {"y": 2 * t + 1.5 * t**2, "a.x": np.exp(-t)},
    ),
    "numbers that SymPy knows by name": Case(
        """
model M
  constant Real pi = 2*asin(1);
  constant Real e = exp(1);
  Real x(start=sqrt(2), fixed=true);
equation
  der(x) = pi*x/sqrt(2) + e/sqrt(3) + log(2) + log(10);
end M;""",
        1.0,
        solution("x", lambda t, y: [np.pi * y[0] / 2**0.5 + np.e / 3**0.5 + np.log(20)], [2**0.5]),
    ),
    "rounding": Case(
        """
model M
  Real x(start=0, fixed=true);
  Real saw = mod(time, 0.7);
equation
  der(x) = floor(2*time) + saw;
end M;""",
        2.0,
    ),
}


@pytest.mark.parametrize(("name", "fmi"), spread(CASES, [2, 3], every=3))
def test_a_model_against_an_independent_solution(name: str, fmi: int, built: Build) -> None:
    check(CASES[name], fmi, built)
