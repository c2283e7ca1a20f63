"""web/src/comparison.ts against comparison/theory.py: on the same traces, the same numbers, verdicts and reasons."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

from overrun_hitch.comparison.theory import compare
from overrun_hitch.experiments.step_brake import brake, car_alone
from overrun_hitch.fmu.opening import opened_unit
from overrun_hitch.fmu.settings import Settings
from overrun_hitch.measure.metrics import NEEDED, Traces, measured
from overrun_hitch.parameters import CASES, FIGURES, Scenario
from overrun_hitch.results import VARIABLES
from overrun_hitch.scenarios import asked_scenario
from tests.web.conftest import NodeRunner

pytestmark = pytest.mark.full

BEYOND: tuple[dict[str, float], ...] = (
    {"sigma": 0.4}, {"tau_b": 0.1}, {"F_f": 200.0}, {"rebound": 3.0, "C": 1000.0}, {"CdA_c": 0.7}, {"mu": 0.8},
    {"F_pull_max": 50.0}, {"V_0": 12.0}, {"V_0": 3.0}, {"C": 9000.0}, {"C": 120.0}, {"M_t": 900.0, "k": 9000.0},
    {"brake_torque": 0.0}, {"brake_torque": 9000.0}, {"x_2": 0.01, "k_2": 20000.0}, {"k": 0.0, "r": 0.0},
    {"F_0": 500.0}, {"eps": 0.002, "C": 800.0}, {"sigma": 0.2, "tau_b": 0.05, "eps": 0.05}, {"travel": 0.02},
    {"k": 2e7, "C": 100.0}, {"k": 2e6, "C": 3000.0}, {"k": 1e5, "r": 0.0, "C": 20.0}, {"k": 0.0},
)  # fmt: skip


def scenarios() -> Iterator[Scenario]:
    yield from FIGURES.values()
    yield from (asked_scenario(None, name, {}) for name in CASES)
    for changes in BEYOND:
        torque = changes.get("brake_torque")
        rest = {name: value for name, value in changes.items() if name != "brake_torque"}
        yield asked_scenario(None, None, rest, brake_torque=torque)
    rng = np.random.default_rng(20261129)
    for _ in range(20):
        spread = {"C": 2000.0, "eps": 0.1, "tau_b": 0.1, "M_t": 1000.0, "V_0": 50.0, "k": 10000.0}
        changes = {name: most * float(rng.uniform(0.1, 1.0)) for name, most in spread.items()}
        yield asked_scenario("8", None, changes | {"eps": changes["eps"] * float(rng.integers(2))})


def traces(run: xr.Dataset) -> dict[str, list[float]]:
    return {name: run[name].values.tolist() for name in ("time", *VARIABLES)}


def as_many(run: xr.Dataset) -> Traces:
    """One run as metrics take many."""
    values = {name: run[name].values[None] for name in NEEDED}
    return Traces(run["time"].values, values, np.array([run.attrs["eps"]]))


def test_the_page_judges_as_hitch_run(run_node: NodeRunner, car_trailer_fmu: Path, tmp_path: Path) -> None:
    cases: list[dict[str, Any]] = []
    with opened_unit(car_trailer_fmu) as unit:
        for scenario in scenarios():
            run = brake(unit, scenario, Settings()).dataset()
            alone = brake(unit, car_alone(scenario), Settings()).dataset()
            values = {**scenario.parameters.model_dump(), "brake_torque": scenario.brake_torque}
            rows = [
                {"quantity": row.quantity, "theory": row.expected, "run": row.found, "verdict": row.verdict,
                 "allowed": row.allowed, "notJudged": row.not_judged}
                for row in compare(run, alone)
            ]  # fmt: skip
            finite = [{name: None if value != value else value for name, value in row.items()} for row in rows]
            jerk = float(measured(("peak_jerk",), as_many(run))["peak_jerk"][0])
            sides = {"traces": traces(run), "alone": traces(alone)}
            cases.append({"values": values, **sides, "rows": finite, "jerk": jerk})
    assert {row["verdict"] for one in cases for row in one["rows"]} == {"agrees", "not judged"}
    assert not any(isinstance(v, float) and math.isinf(v) for one in cases for row in one["rows"] for v in row.values())
    file = tmp_path / "cases.json"
    file.write_text(json.dumps(cases), encoding="utf-8")
    run_node("comparison", COMPARISONS=str(file))
