"""What a spec comes to, and that a bad one is told before anything runs."""

from __future__ import annotations

from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.stats import qmc

from overrun_hitch import cli
from overrun_hitch.parameters import CASES, DATUM, HitchError, Parameters
from overrun_hitch.sweeps.plan import Plan
from overrun_hitch.sweeps.planner import planned
from overrun_hitch.sweeps.sampling import sampled
from overrun_hitch.sweeps.spec import SweepSpec, read_spec

axes = st.dictionaries(
    st.sampled_from(sorted(name for name in Parameters.model_fields if Parameters.limits(name)[1] >= 50.0)),
    st.lists(st.floats(1.0, 50.0), min_size=1, max_size=4, unique=True),
    min_size=1,
    max_size=3,
)


def plan_of(fmu: Path, **spec: Any) -> Plan:
    return planned(SweepSpec(**spec), [fmu])


@given(grid=axes)
@settings(max_examples=20, deadline=None)
def test_a_grid_is_the_product_of_its_axes(car_trailer_fmu: Path, grid: dict[str, list[float]]) -> None:
    plan = plan_of(car_trailer_fmu, grid=grid)
    assert list(zip(*plan.columns.values(), strict=True)) == list(product(*grid.values()))
    assert list(plan.columns) == list(grid)
    assert {**plan.job.fixed, **dict.fromkeys(grid, 0.0)}.keys() == {*Parameters.model_fields, "brake_torque"}


def test_parts_are_combined(car_trailer_fmu: Path) -> None:
    plan = planned(
        SweepSpec(
            grid={
                "C": {"min": 100.0, "max": 900.0, "count": 3},
                "k_t": {"min": 1e3, "max": 1e5, "count": 3, "scale": "log"},
            },
            runs={"k": [5000.0, 6000.0], "r": [15e3, 16e3]},
            sample={"method": "sobol", "count": 4, "ranges": {"M_t": {"min": 300.0, "max": 700.0}}},
            profiles={"a": {"time": [0.0], "brake_torque": [500.0]}, "b": {"time": [0.0], "brake_torque": [900.0]}},
        ),
        [car_trailer_fmu, car_trailer_fmu],
    )  # fmt: skip
    assert plan.runs == 2 * 2 * 3 * 3 * 2 * 4
    rows = set(zip(plan.fmu, plan.profile, *plan.columns.values(), strict=True))
    assert len(rows) == plan.runs
    assert set(plan.columns["C"]) == {100.0, 500.0, 900.0}
    assert sorted(set(plan.columns["k_t"])) == pytest.approx([1e3, 1e4, 1e5])
    assert set(zip(plan.columns["k"], plan.columns["r"], strict=True)) == {(5000.0, 15e3), (6000.0, 16e3)}
    assert "brake_torque" not in plan.job.fixed


@pytest.mark.parametrize("method", ["sobol", "latin-hypercube"])
def test_samples_fill_their_ranges_and_can_be_made_again(method: str) -> None:
    ranges = {"C": (100.0, 900.0), "k": (4000.0, 7000.0), "M_t": (300.0, 700.0)}
    points = sampled(method, 64, 3, ranges)
    table = np.array(list(points.values())).T
    unit = qmc.scale(table, *np.array(list(ranges.values())).T, reverse=True)
    assert unit.min() >= 0.0
    assert unit.max() <= 1.0
    # Each sixty-fourth of each range has one point: so for a hypercube, and for a Sobol sequence of a power of two.
    assert all(sorted(np.floor(column * 64).astype(int)) == list(range(64)) for column in unit.T)
    same, other = (np.array(list(sampled(method, 64, seed, ranges).values())).T for seed in (3, 4))
    assert (same == table).all()
    assert (other != table).all()


def test_case_and_parameters_are_the_base(car_trailer_fmu: Path) -> None:
    plan = plan_of(car_trailer_fmu, case="iii", parameters={"M_t": 600.0, "grade": -0.05}, grid={"C": [1.0, 2.0]})
    assert plan.job.fixed["k"] == CASES["iii"].k != DATUM.k
    assert plan.job.fixed["M_t"] == 600.0
    assert plan.job.fixed["grade"] == -0.05
    assert "C" not in plan.job.fixed


BAD = [
    ("grid = {Q = [1.0]}", "grid: there is no parameter or input 'Q'; allowed: "),
    ("gird = {C = [1.0]}", "there is no setting in a sweep 'gird'; did you mean grid? allowed: name, "),
    ("grid = {C = []}", "grid.C = [] is not allowed"),
    ("grid = {C = [1.0, 1.0]}", "grid.C has a value twice"),
    ("grid = {C = [-1.0]}", "C = -1 N.s/m is not allowed: drawbar damper coefficient must be a finite number, at"),
    ("grid = {C = ['much']}", "grid.C.0 = 'much' is not allowed: "),
    ("grid = {C = [true]}", "grid.C.0 = True is not allowed: "),
    ("grid = {C = [nan]}", "grid.C.0 = nan is not allowed: "),
    ("grid = {C = {min = 5.0, max = 1.0, count = 3}}", "grid.C: min = 5 is greater than max = 1"),
    ("grid = {C = {min = 5.0, max = 5.0, count = 3}}", "grid.C is an empty range, from 5 to 5"),
    ("grid = {C = {min = 5.0, max = 9.0, count = 1}}", "grid.C.count = 1 is not allowed: input should be greater"),
    ("grid = {C = {min = 5.0, max = 9.0}}", "grid.C.count is not allowed: field required"),
    ("grid = {C = {min = 5.0, max = 9.0, cuont = 3, count = 3}}", "setting in grid.C 'cuont'; did you mean count?"),
    ("grid = {C = {min = 0.0, max = 9.0, count = 3, scale = 'log'}}", "grid.C: min = 0 is not allowed on a log scale"),
    ("grid = {C = {min = 0.0, max = 9.0, count = 2000000}}", "grid.C: count = 2000000 is not allowed"),
    ("runs = {C = [1.0, 2.0], k = [1.0]}", "the columns of runs must have equal lengths; C has 2, k has 1"),
    ("runs = {C = [1.0]}\nparameters = {C = 2.0}", "C stands in parameters or profiles and in runs"),
    ("runs = {C = [1.0]}\ngrid = {C = [2.0]}", "C stands in grid.C and in runs"),
    ("sample = {method = 'sobol', count = 100, ranges = {C = {min = 1.0, max = 2.0}}}", "sample.count = 100 is"),
    ("sample = {method = 'sobol', count = 0, ranges = {C = {min = 1.0, max = 2.0}}}", "sample.count = 0 is"),
    ("sample = {method = 'dice', count = 4, ranges = {C = {min = 1.0, max = 2.0}}}", "sample.method = 'dice'"),
    ("sample = {method = 'sobol', count = 4, ranges = {}}", "sample.ranges = {} is not allowed"),
    ("sample = {method = 'sobol', count = 4, ranges = {C = {min = 2.0, max = 1.0}}}", "sample.ranges.C: min = 2"),
    ("sample = {method = 'sobol', count = 4, ranges = {C = {min = -2.0, max = 1.0}}}", "sample.ranges: C = -2 N.s/m"),
    ("metrics = ['growth']", "there is no metric 'growth'; did you mean growth_rate? allowed: growth_rate"),
    ("trajectories = ['speed']", "there is no variable 'speed'; allowed: "),
    ("case = 'x'", "there is no case 'x'"),
    ("duration = 0.0", "duration = 0 s"),
    ("communication_step = 0.7", "communication_step = 0.7 s is not allowed: it must divide the duration, 6 s"),
    ("communication_step = 1e-6", "communication_step = 1e-06 s is not allowed: at most"),
    ("relative_tolerance = 0.0", "relative_tolerance = 0 is not allowed"),
    ("name = '../elsewhere'", "name = '../elsewhere' is not allowed"),
    ("profiles = {p = {time = [0.0]}}", "profiles.p has no input; allowed: brake_torque, grade"),
    ("profiles = {p = {time = [0.0], wind = [1.0]}}", "there is no input 'wind'; allowed: brake_torque, grade"),
    ("profiles = {p = {time = [0.0, 1.0], grade = [1.0]}}", "profiles.p.grade has 1 values for 2 knots"),
    ("profiles = {p = {time = [1.0], grade = [1.0]}}", "profiles.p.time is not allowed: it must start at 0 s"),
    ("profiles = {p = {time = [0.0, 0.005], grade = [0.0, 0.1]}}", "every knot must be a communication point"),
    ("profiles = {p = {time = [0.0], brake_torque = [-1.0]}}", "profiles.p: brake_torque = -1 N.m"),
    ("fmus = ['none.fmu']", "none.fmu is not there: an FMU file is needed"),
    ("C = [1", "is not TOML"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "message"), BAD)
def test_a_bad_spec_is_one_line_and_status_2(
    text: str, message: str, car_trailer_fmu: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    spec, output = tmp_path / "bad.toml", tmp_path / "out"
    spec.write_text(text)
    fmu = [] if "fmus" in text else ["--fmu", str(car_trailer_fmu)]
    status = cli.main(["sweep", str(spec), "--output", str(output), *fmu])
    out, err = capsys.readouterr()
    assert (status, out, err.count("\n")) == (2, "", 1)
    assert message in err
    assert not output.exists()


def test_fmus_are_looked_for_beside_the_spec(tmp_path: Path) -> None:
    (tmp_path / "spec.toml").write_text("fmus = ['a.fmu', '/b.fmu']")
    assert read_spec(tmp_path / "spec.toml").fmus == [str(tmp_path / "a.fmu"), "/b.fmu"]


def test_too_many_runs(car_trailer_fmu: Path) -> None:
    axis = {"min": 1.0, "max": 2.0, "count": 1001}
    with pytest.raises(HitchError, match="the sweep has 1002001 runs; allowed: at most 1000000"):
        plan_of(car_trailer_fmu, grid={"C": axis, "k": axis})
