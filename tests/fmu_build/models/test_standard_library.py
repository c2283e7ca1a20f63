"""Components of the Modelica Standard Library that a brake engineer reaches for, in small models with a closed form."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import cos, exp, log, sin, sqrt

import fmpy
import numpy as np
import pytest

from tests import standard_library
from tests.fmu_build.conftest import Build

BLOCKS, ROTATIONAL, TRANSLATIONAL = (
    "Modelica.Blocks",
    "Modelica.Mechanics.Rotational",
    "Modelica.Mechanics.Translational",
)
BASIC = "Modelica.Electrical.Analog.Basic"
TOLERANCE = 1e-8
ERROR = {"CoSimulation": 5e-8, "ModelExchange": 1e-6}  # the latter of fmpy's CVode, which finds events less closely


@dataclass(frozen=True)
class Model:
    """Components, connections, and what an output should be at a time."""

    declared: str
    connected: str
    output: str
    expected: Callable[[float], float]


def braked(t: float) -> float:
    """A speed of 1 that 0.5*0.1*100 brakes."""
    return max(0.0, 1 - 5 * t)


def late(response: Callable[[float], float]) -> Callable[[float], float]:
    """The response to a step at 0.5."""
    return lambda t: response(t - 0.5) if t > 0.5 else 0.0


SHAFT = f"{ROTATIONAL}.Components.Inertia m(J=1, w(start=1, fixed=true), phi(start=0, fixed=true));"
MASS = f"{TRANSLATIONAL}.Components.Mass m(m=1, v(start=1, fixed=true), s(start=0, fixed=true));"
PRESSED = f"{BLOCKS}.Sources.Constant c(k=0.1);"
STEP = f"{BLOCKS}.Sources.Step s(startTime=0.5);"
A = sqrt(0.75)
MODELS = {
    "BearingFriction": Model(
        f"{ROTATIONAL}.Components.BearingFriction b(tau_pos=[0, 1; 1, 2]); {SHAFT}",
        "connect(b.flange_b, m.flange_a);",
        "m.phi",
        lambda t: 2 * (1 - exp(-min(t, log(2)))) - min(t, log(2)),
    ),
    "Rotational Brake": Model(
        f"{ROTATIONAL}.Components.Brake b(fn_max=100); {SHAFT} {PRESSED}",
        "connect(b.flange_b, m.flange_a); connect(c.y, b.f_normalized);",
        "m.w",
        braked,
    ),
    "Clutch": Model(
        f"{ROTATIONAL}.Components.Clutch b(fn_max=100); {ROTATIONAL}.Components.Fixed f; {SHAFT} {PRESSED}",
        "connect(b.flange_b, m.flange_a); connect(f.flange, b.flange_a); connect(c.y, b.f_normalized);",
        "m.w",
        braked,
    ),
    "Translational Brake": Model(
        f"{TRANSLATIONAL}.Components.Brake b(fn_max=100); {MASS} {PRESSED}",
        "connect(b.flange_b, m.flange_a); connect(c.y, b.f_normalized);",
        "m.v",
        braked,
    ),
    "Damper": Model(
        f"{TRANSLATIONAL}.Components.Damper d(d=1); {TRANSLATIONAL}.Components.Fixed f; {MASS}",
        "connect(f.flange, d.flange_a); connect(d.flange_b, m.flange_a);",
        "m.v",
        lambda t: exp(-t),
    ),
    "SpringDamper": Model(
        f"{TRANSLATIONAL}.Components.SpringDamper d(c=1, d=1); {TRANSLATIONAL}.Components.Fixed f; {MASS}",
        "connect(f.flange, d.flange_a); connect(d.flange_b, m.flange_a);",
        "m.s",
        lambda t: exp(-t / 2) * sin(A * t) / A,
    ),
    "ElastoGap": Model(
        f"{TRANSLATIONAL}.Components.ElastoGap d(c=100, d=0, s_rel0=-1); {TRANSLATIONAL}.Components.Fixed f; {MASS}",
        "connect(m.flange_b, d.flange_a); connect(d.flange_b, f.flange);",
        "m.v",
        lambda t: 1.0 if t < 1 else cos(10 * (t - 1)) if t < 1 + np.pi / 10 else -1.0,
    ),
    "Force, Ramp": Model(
        f"{TRANSLATIONAL}.Sources.Force f; {BLOCKS}.Sources.Ramp r(height=2, duration=1, startTime=0.5); {MASS}",
        "connect(f.flange, m.flange_b); connect(r.y, f.f);",
        "m.v",
        lambda t: 1 + (min(max(t - 0.5, 0), 1) ** 2 + 2 * max(t - 1.5, 0)),
    ),
    "IdealGear": Model(
        f"{ROTATIONAL}.Components.IdealGear g(ratio=2); {ROTATIONAL}.Components.Inertia n(J=1);"
        f" {ROTATIONAL}.Sources.ConstantTorque t(tau_constant=1); {SHAFT}",
        "connect(g.flange_b, m.flange_a); connect(n.flange_b, g.flange_a); connect(t.flange, n.flange_a);",
        "m.w",
        lambda t: 1 + 2 * t / 5,
    ),
    "TransferFunction": Model(
        f"{BLOCKS}.Continuous.TransferFunction p(b={{1}}, a={{1, 2, 1}}, initType={BLOCKS}.Types.Init.InitialState);"
        f" {STEP}",
        "connect(s.y, p.u);",
        "p.y",
        late(lambda t: 1 - (1 + t) * exp(-t)),
    ),
    "StateSpace": Model(
        f"{BLOCKS}.Continuous.StateSpace p(A=[-1, 0; 0, -2], B=[1; 1], C=[1, 1], D=[0],"
        f" initType={BLOCKS}.Types.Init.InitialState); {STEP}",
        "connect(s.y, p.u[1]);",
        "p.y[1]",
        late(lambda t: 1 - exp(-t) + (1 - exp(-2 * t)) / 2),
    ),
    "LimPID, FirstOrder": Model(  # at the limit up to y = 0.5, where 4*(1 - y) = 2
        f"{BLOCKS}.Continuous.LimPID p(controllerType={BLOCKS}.Types.SimpleController.P, k=4, yMax=2); {STEP}"
        f" {BLOCKS}.Continuous.FirstOrder f(T=1, initType={BLOCKS}.Types.Init.InitialOutput);",
        "connect(s.y, p.u_s); connect(p.y, f.u); connect(f.y, p.u_m);",
        "f.y",
        late(lambda t: 2 * (1 - exp(-t)) if t < log(4 / 3) else 0.8 - 0.3 * exp(-5 * (t - log(4 / 3)))),
    ),
    "Resistor, Inductor, Capacitor": Model(
        f"{BASIC}.Resistor r(R=1); {BASIC}.Inductor l(L=1, i(start=0, fixed=true)); {BASIC}.Ground g;"
        f" {BASIC}.Capacitor c(C=1, v(start=0, fixed=true));"
        " Modelica.Electrical.Analog.Sources.StepVoltage v(V=1, startTime=0.5);",
        "connect(v.p, r.p); connect(r.n, l.p); connect(l.n, c.p); connect(c.n, v.n); connect(v.n, g.p);",
        "c.v",
        late(lambda t: 1 - exp(-t / 2) * (cos(A * t) + sin(A * t) / (2 * A))),
    ),
    "TimeTable": Model(
        f"{BLOCKS}.Sources.TimeTable t(table=[0, 0; 1, 0; 1, 1; 2, 4], timeScale=0.5, offset=7, startTime=0.1);",
        "",
        "t.y",
        lambda t: 7 + max(0.0, 3 * (t - 0.1) / 0.5 - 2) * (t > 0.6),
    ),
    "CombiTimeTable": Model(
        f"{BLOCKS}.Sources.CombiTimeTable t(table=[0, 1, 5; 1, 2, 4; 1, 3, 4; 3, 7, 0], columns={{3, 2}},"
        f" offset={{10, 20}}, startTime=0.1, timeScale=0.5, extrapolation={BLOCKS}.Types.Extrapolation.Periodic);",
        "",
        "t.y[2]",
        lambda t: 20 + float(np.interp((t - 0.1) / 0.5 % 3, [0, 1, 1 + 1e-12, 3], [1, 2, 3, 7])) if t > 0.1 else 20.0,
    ),
}


@pytest.mark.full
@standard_library.needed
@pytest.mark.parametrize("name", MODELS)
def test_component(name: str, built: Build) -> None:
    model = MODELS[name]
    declared, connected = (text.replace("; ", ";\n  ") for text in (model.declared, model.connected))
    fmu = built(f"model M\n  {declared}\nequation\n  {connected}\nend M;\n", 2)
    for kind in ("CoSimulation", "ModelExchange"):
        result = fmpy.simulate_fmu(
            str(fmu),
            stop_time=2,
            output_interval=0.064,  # no output at an event
            output=[model.output],
            fmi_type=kind,
            record_events=False,
            relative_tolerance=TOLERANCE,
        )
        expected = [model.expected(t) for t in result["time"]]
        error = np.abs(result[model.output] - expected).max()
        print(f"{name}, {kind}: {error:.1e}")
        assert error < ERROR[kind]
