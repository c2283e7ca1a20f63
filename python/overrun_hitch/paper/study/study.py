"""Everything that the paper's claims, figures and the report are made of, computed once."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from overrun_hitch.comparison.theory import compare
from overrun_hitch.experiments.linearisation import Linearisation, at_steady_braking, at_zero_slip
from overrun_hitch.experiments.step_brake import brake, car_alone
from overrun_hitch.fmu.guest_unit import guest_unit
from overrun_hitch.fmu.settings import TIME_LIMIT, Settings
from overrun_hitch.fmu.unit import AnyUnit
from overrun_hitch.paper.study.beyond import Boundary, Motion, Shunting, boundary, motions, stops
from overrun_hitch.paper.study.curves import CURVES, Locus, V, locus
from overrun_hitch.paper.study.device import Device, device
from overrun_hitch.parameters import CASES, FIGURES, Parameters, Scenario
from overrun_hitch.results import Run
from overrun_hitch.theory.steady import steady

SETTINGS = Settings(relative_tolerance=1e-8, communication_step=0.01)
BRAKE_TORQUE = 1000.0  # N.m, that of the paper's figures 6 to 11
DAMPED = 500.0  # N.s/m: settles within a run of 6 s

# Claim 3: what must not change the steady state, and what must scale it.
VARIATIONS: Mapping[str, dict[str, float]] = {
    "C = 500 N.s/m, V = 40 m/s": {"C": 500.0, "V_0": 40.0},
    "C = 250 N.s/m": {"C": 250.0, "V_0": 40.0},
    "C = 2000 N.s/m": {"C": 2000.0, "V_0": 40.0},
    "V = 25 m/s": {"C": 500.0, "V_0": 25.0},
    "k and r doubled": {"C": 500.0, "V_0": 40.0, "k": 2.0 * CASES["ii"].k, "r": 2.0 * CASES["ii"].r},
}


@dataclass(frozen=True)
class SteadyState:
    """Steady braking from one side: see steady.Steady."""

    ratio: float  # A / A_c (1)
    A: float  # m/s2
    D: float  # m


@dataclass(frozen=True)
class Study:
    """What was computed. Keys are the paper's names of cases and figures."""

    fmu: str  # name of the file
    guid: str
    runs: Mapping[str, Run]  # figures 6a to 11
    run_without_clearance: Run  # figure 11 without clearance, for claim 13
    alone: Mapping[str, Run]  # the same figures, the car alone
    loci: Mapping[str, tuple[Locus, ...]]  # figures 4 and 5
    steady_theory: Mapping[str, SteadyState]  # cases, and VARIATIONS of case ii
    steady_fmu: Mapping[str, SteadyState]
    at_zero_slip: Mapping[str, Linearisation]  # cases
    at_braking: Linearisation  # case ii, figure 8
    boundary: Boundary
    motions: tuple[Motion, ...]  # with clearance, at held speed
    stops: tuple[Shunting, ...]  # to standstill
    device: Device  # that lags and rubs


def study(fmu: Path, progress: Callable[[str], object] = lambda _: None, time_limit: float = TIME_LIMIT) -> Study:
    """Compute everything on the FMU file and in theory; `progress` is told what is being done.

    A run may take `time_limit` s.
    """
    with guest_unit(fmu, time_limit) as unit:
        progress("braking: figures 6 to 11")
        runs = {name: brake(unit, scenario, SETTINGS) for name, scenario in FIGURES.items()}
        alone = {name: brake(unit, car_alone(scenario), SETTINGS) for name, scenario in FIGURES.items()}
        free = FIGURES["11"].changed(name="figure 11, eps=0", parameters=FIGURES["11"].parameters.changed({"eps": 0.0}))
        without = brake(unit, free, SETTINGS)
        progress("steady deceleration: the nine cases")
        states = _steady_parameters()
        steady_fmu = {name: _measured_steady(unit, parameters) for name, parameters in states.items()}
        loci = _loci(unit, progress)
        progress("linearisation")
        engaged = {name: at_zero_slip(unit, case.changed({"C": DAMPED}), V) for name, case in CASES.items()}
        braking = at_steady_braking(unit, FIGURES["8"].parameters, V, BRAKE_TORQUE)
        progress("boundary of self-excitation")
        chart = boundary(unit)
        progress("a brake that lags")
        lagging = device(unit)
        progress("stops to standstill")
        stopped = stops(unit)
        return Study(
            fmu=unit.name,
            guid=unit.identity.guid,
            runs=runs,
            run_without_clearance=without,
            alone=alone,
            loci=loci,
            steady_theory={name: _theoretical_steady(parameters) for name, parameters in states.items()},
            steady_fmu=steady_fmu,
            at_zero_slip=engaged,
            at_braking=braking,
            boundary=chart,
            motions=motions(unit, progress),
            stops=stopped,
            device=lagging,
        )


def _loci(unit: AnyUnit, progress: Callable[[str], object]) -> dict[str, tuple[Locus, ...]]:
    found = {}
    for figure, curves in CURVES.items():
        progress(f"root loci: figure {figure}")
        found[figure] = tuple(locus(unit, curve) for curve in curves)
    return found


def _steady_parameters() -> dict[str, Parameters]:
    """The nine cases, well damped, and the variations of case ii."""
    cases = {name: case.changed({"C": DAMPED}) for name, case in CASES.items()}
    return cases | {name: CASES["ii"].changed(changes) for name, changes in VARIATIONS.items()}


def _theoretical_steady(parameters: Parameters) -> SteadyState:
    theory = steady(parameters, BRAKE_TORQUE)
    return SteadyState(theory.ratio, theory.A, theory.D)


def _measured_steady(unit: AnyUnit, parameters: Parameters) -> SteadyState:
    scenario = Scenario(name="steady braking", parameters=parameters, brake_torque=BRAKE_TORQUE)
    rows = compare(brake(unit, scenario, SETTINGS), brake(unit, car_alone(scenario), SETTINGS))
    found = {row.quantity: row.found for row in rows}
    return SteadyState(found["A / A_c"], found["acceleration A"], found["compression D"])
