"""Models that the generator writes from Modelica, in the shape of the hand-written ones."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from fmu_build.codegen.elimination import print_elimination
from fmu_build.codegen.model import print_c
from fmu_build.equations.derive import derive
from fmu_build.equations.elimination import eliminate
from fmu_build.equations.initialize import initialize
from fmu_build.equations.jacobian import differentiate
from fmu_build.equations.lower import lower
from fmu_build.equations.sort import sort
from fmu_build.fmu.ports import declare
from fmu_build.frontend.flatten import flatten
from fmu_build.ir.models import TOKEN_PLACEHOLDER
from tests.fmu_build.runtime.hand_written import TOKEN

# Nonlinear in all that is known, with direct feedthrough, a calculated parameter, a start value that follows from
# parameters, and a relation.
NONLINEAR = """model Nonlinear
  parameter Real a(unit="1") = 0.7;
  parameter Real b(unit="1") = 1.3;
  parameter Real g(unit="1") = a*a*b;
  parameter Real x_0(unit="1") = 0.4;
  input Real u(unit="1", start=0.3);
  Real x(unit="1", start=x_0*b, fixed=true);
  Real y(unit="1", start=0.2, fixed=true);
  output Real p(unit="1");
  output Real q(unit="1");
  output Real of_state(unit="1") = y;
equation
  der(x) = -g*x + sin(time)*y + u*u;
  der(y) = -b*x*y + (if x > 0.25 then a*(x - 0.25)*u else 0);
  p = x*x*y + a*u + cos(b*time);
  q = exp(-x)*y/(1 + g);
end Nonlinear;
"""

# All that events can do: reinit, ticks, edges, inputs and parameters of all types, warnings, errors, an end.
EVENTS = """model Events
  type Mode = enumeration(slow, fast);
  parameter Real e(unit="1") = 0.8;
  parameter Real T_s(unit="s", min=0.01) = 0.05;
  parameter Integer most = 40;
  input Boolean open(start=true);
  input Integer level(start=1);
  input Real u(start=0.2);
  output Mode mode(start=Mode.slow, fixed=true);
  output Integer bounces(start=0, fixed=true);
  output Boolean high;
  Real h(start=1, fixed=true);
  Real v(start=0, fixed=true);
  discrete Real mean(start=0, fixed=true);
equation
  der(h) = v;
  der(v) = -9.81 + u + (if mode == Mode.fast then -level else 0);
  high = h > 0.5 and open;
  when h < 0 then
    reinit(v, -e*pre(v));
    bounces = pre(bounces) + 1;
    mode = if pre(mode) == Mode.slow then Mode.fast else Mode.slow;
  end when;
  when sample(0, T_s) then
    mean = 0.9*pre(mean) + 0.1*h;
  end when;
  when bounces > most then
    terminate("enough, after " + String(time) + " s");
  end when;
  assert(h < 2, "h is " + String(h), AssertionLevel.warning);
  assert(h < 50, "h is " + String(h));
end Events;
"""


@dataclass(frozen=True)
class GeneratedModel:
    name: str
    sources: dict[str, str]
    value_references: dict[str, int]
    states: tuple[str, ...]
    relations: tuple[object, ...]

    def files(self) -> dict[str, str]:
        header = self.sources["variables.h"].replace(TOKEN_PLACEHOLDER, TOKEN)
        return {**self.sources, "unit.h": "", "variables.h": header}

    def references(self) -> dict[str, int]:
        return self.value_references


def generate(modelica: Path, class_name: str) -> GeneratedModel:
    flat = flatten(modelica, class_name)
    model = sort(initialize(derive(lower(flat))))
    name = class_name.rpartition(".")[2]
    jacobian = differentiate(model)
    algebra = print_elimination(eliminate(jacobian.entries, len(model.states)))
    return GeneratedModel(
        name,
        print_c(model, jacobian, name, declare(flat, model).coupling).files | algebra.files,
        dict(model.value_references),
        tuple(model.states),
        tuple(model.relations),
    )
