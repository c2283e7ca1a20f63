"""Theory against a faultless simulation (the oracle): who is judged, who agrees, and that a fault shows."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import pytest
import xarray as xr

from overrun_hitch.comparison.theory import compare, shunting
from overrun_hitch.experiments.step_brake import car_alone
from overrun_hitch.measure.judged import Judged
from overrun_hitch.measure.oscillation import Oscillation
from overrun_hitch.parameters import CASES, FIGURES, Scenario
from tests.oracles import radau
from tests.runs import step_brake

OracleRun = Callable[..., xr.Dataset]


def scenario(case: str = "ii", **changes: float) -> Scenario:
    return Scenario(name="test", parameters=CASES[case].changed(changes))


def compared(run: OracleRun, subject: Scenario, milliseconds: int = 10) -> dict[str, Judged]:
    rows = compare(run(subject, milliseconds), run(car_alone(subject), milliseconds))
    return {row.quantity: row for row in rows}


def simulated(fmu: Path, subject: Scenario) -> dict[str, Judged]:
    rows = compare(step_brake(subject, fmu=fmu), step_brake(car_alone(subject), fmu=fmu))
    return {row.quantity: row for row in rows}


@pytest.mark.parametrize(
    ("case", "C"), [("ii", 130.0), ("ii", 200.0), ("ii", 500.0), ("ii", 2000.0), ("i", 200.0), ("iii", 500.0)]
)
def test_theory_and_simulation_agree_while_the_drawbar_stays_in_compression(
    oracle_run: OracleRun, case: str, C: float
) -> None:
    rows = compared(oracle_run, scenario(case, C=C))
    assert {row.verdict for row in rows.values()} == {"agrees"}
    # Ten times closer than what is allowed: what is left is slip, not luck.
    assert abs(rows["shunting growth"].difference) < 1e-3
    assert abs(rows["shunting frequency"].difference) < 4e-4 * rows["shunting frequency"].expected


@pytest.mark.parametrize("milliseconds", [1, 100])
def test_the_verdict_does_not_depend_on_sampling(oracle_run: OracleRun, milliseconds: int) -> None:
    rows = compared(oracle_run, scenario(C=200.0), milliseconds)
    assert {row.verdict for row in rows.values()} == {"agrees"}
    # A dip out of compression that lasts 30 ms is seen between samples 100 ms apart.
    rows = compared(oracle_run, scenario(C=100.0), milliseconds)
    assert {row.not_judged for row in rows.values()} == {"drawbar leaves compression at t = 0.60 s"}


@pytest.mark.parametrize("C", [0.0, 20.0])
def test_self_excitation_is_judged_when_it_starts_small(oracle_run: OracleRun, C: float) -> None:
    rows = compared(oracle_run, scenario(C=C, compression_start=0.025))
    assert {row.verdict for row in rows.values()} == {"agrees"}
    assert rows["shunting growth"].found > 0.1


@pytest.mark.parametrize("figure", ["6a", "6b", "10"])
def test_no_verdict_where_the_drawbar_leaves_compression(oracle_run: OracleRun, figure: str) -> None:
    rows = compared(oracle_run, FIGURES[figure])
    for row in rows.values():
        assert row.verdict == "not judged"
        assert row.not_judged.startswith("drawbar leaves compression at t = 0.")
        assert math.isfinite(row.expected)
        mode = row.quantity.startswith("shunting")
        assert math.isnan(row.found) == mode  # no exponential fits such a motion
        assert ("no exponential fits the oscillation: it leaves 0." in row.not_judged) == mode


def test_no_verdict_where_a_clearance_comes_before_compression(oracle_run: OracleRun) -> None:
    """Figure 11: once in compression the drawbar stays there, and the numbers agree, but the run began outside."""
    rows = compared(oracle_run, FIGURES["11"])
    (entry,) = radau.trajectory(FIGURES["11"].parameters).events
    assert {row.not_judged for row in rows.values()} == {f"drawbar comes into compression only at t = {entry:.2f} s"}
    assert all(abs(row.difference) < row.allowed for row in rows.values())


def test_claim_10_frequency_of_figures_6(oracle_run: OracleRun) -> None:
    """The fundamental of motions that are no exponential, so that `compare` gives theirs no growth rate."""
    near, higher = (shunting(oracle_run(FIGURES[name]))[0] for name in ("6b", "6a"))
    expected = compared(oracle_run, FIGURES["6b"])["shunting frequency"].expected
    assert isinstance(near, Oscillation) and isinstance(higher, Oscillation)
    assert near.frequency == pytest.approx(expected, rel=0.06)
    assert higher.frequency > 1.15 * expected


def test_heavy_damping_leaves_the_steady_values_to_judge(oracle_run: OracleRun) -> None:
    for C, reason in ((3200.0, "only 1.5 periods to measure"), (8000.0, "the shunting mode is overdamped")):
        rows = compared(oracle_run, scenario(C=C))
        assert rows["shunting growth"].not_judged == rows["shunting frequency"].not_judged == reason
        assert {rows[name].verdict for name in ("acceleration A", "A / A_c", "compression D")} == {"agrees"}


@pytest.mark.parametrize("fault", [{"C": 1.05}, {"r": 1.02}, {"C_kt": 0.5}])
def test_a_fault_shows(oracle_run: OracleRun, fault: dict[str, float]) -> None:
    """A simulation of other parameters than it says is found out."""
    said = scenario(C=500.0)
    done = scenario(**{"C": 500.0} | {name: factor * getattr(said.parameters, name) for name, factor in fault.items()})
    run = oracle_run(done)
    run = run.assign_attrs({name: getattr(said.parameters, name) for name in fault})
    assert any(row.differs for row in compare(run, oracle_run(car_alone(said))))


@pytest.mark.parametrize("F_0", [100.0, 300.0])
def test_a_threshold_that_the_push_exceeds_all_the_time_is_judged(car_trailer_fmu: Path, F_0: float) -> None:
    rows = simulated(car_trailer_fmu, scenario(F_0=F_0, compression_start=0.02))
    assert {row.verdict for row in rows.values()} == {"agrees"}
    assert rows["A / A_c"].expected < 0.94


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"F_0": 150.0}, "drawbar comes into compression only at t = 0.02 s"),
        ({"rebound": 3.0}, "rebound = 3 is beyond linear theory"),
        ({"F_pull_max": 0.0}, "F_pull_max = 0 is beyond linear theory"),
        ({"mu": 1.0}, "mu = 1 is beyond linear theory"),
        ({"x_2": 0.03}, "drawbar's stiffness changes, at 0.03 m, at t = 0.18 s"),
        ({"travel": 0.02}, "drawbar's stiffness changes, at 0.02 m, at t = 0.14 s"),
    ],
)
def test_no_verdict_on_what_theory_does_not_know(car_trailer_fmu: Path, changes: dict[str, float], reason: str) -> None:
    rows = simulated(car_trailer_fmu, scenario(**changes))
    told = [row.not_judged.partition("; no exponential fits") for row in rows.values()]
    assert {before for before, *_ in told} == {reason}
    for row, (_, misfit, _) in zip(rows.values(), told, strict=True):
        assert math.isfinite(row.expected) and math.isfinite(row.found) != bool(misfit)


def test_a_buffer_out_of_reach_changes_nothing(car_trailer_fmu: Path) -> None:
    near = simulated(car_trailer_fmu, scenario(travel=0.1, x_2=0.06, k_2=8000.0))
    for name, row in simulated(car_trailer_fmu, scenario()).items():
        assert near[name].found == pytest.approx(row.found, rel=1e-12)


def test_nothing_between_car_and_trailer(oracle_run: OracleRun) -> None:
    rows = compared(oracle_run, scenario(k=0.0, r=0.0))
    assert {row.verdict for row in rows.values()} == {"not judged"}
