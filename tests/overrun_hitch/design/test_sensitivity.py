"""Sobol indices of FMU runs against those of linear theory, and their bad input."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from overrun_hitch import cli
from overrun_hitch.design.sensitivity import Variation, analysed, plan_variation, varied
from overrun_hitch.parameters import DATUM, HitchError
from overrun_hitch.sweeps.runner import Runner
from overrun_hitch.sweeps.store import opened_store, read_sweep
from overrun_hitch.theory.linear import shunting_mode
from overrun_hitch.theory.steady import steady

SMALL = Variation(samples=16)


def runs(fmu: Path, store: Path) -> xr.Dataset:
    plan = plan_variation(DATUM, SMALL, fmu, "small", communication_step=0.05)
    runner = Runner(plan.job, fmu)
    with opened_store(store, plan) as opened:
        for number in opened.missing():
            opened.write(number, runner.run(opened.batch(number)))
    runner.close()
    return read_sweep(store).load()


@pytest.mark.full
def test_they_are_those_of_linear_theory(car_trailer_fmu: Path, tmp_path: Path) -> None:
    """The same sample, in theory at the speed half way through the run of 6 s."""
    sweep = runs(car_trailer_fmu, tmp_path / "small.zarr")
    found = analysed(sweep, DATUM, SMALL)
    columns = {name: sweep[name].values for name in varied(DATUM)}
    rows = [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)]
    combinations = [DATUM.changed(row) for row in rows]
    speeds = [each.V_0 + 3.0 * steady(each, 1000.0).A for each in combinations]
    ratios = [float(shunting_mode(*each).damping_ratio) for each in zip(combinations, speeds, strict=True)]
    theory = analysed(sweep.assign(damping_ratio=("run", np.array(ratios))), DATUM, SMALL)
    assert found.runs == 16 * (len(columns) + 2)
    ours, expected = found.indices["damping_ratio"].total, theory.indices["damping_ratio"].total
    assert ours == pytest.approx(expected, abs=0.02)
    assert set(np.array(found.names)[np.argsort(-expected)[:3]]) == {"C", "R_t", "r"}


def test_what_is_nothing_does_not_vary() -> None:
    assert {name for name, value in DATUM.model_dump().items() if value == 0.0}.isdisjoint(varied(DATUM))


@pytest.mark.full
def test_runs_without_damping_are_told(car_trailer_fmu: Path, tmp_path: Path) -> None:
    sweep = runs(car_trailer_fmu, tmp_path / "small.zarr")
    sweep["damping_ratio"][3] = np.nan
    with pytest.raises(HitchError, match=r"1 of .* runs have no damping_ratio, .* its drawbar does not oscillate"):
        analysed(sweep, DATUM, SMALL)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--spread", "1"], "spread = 1 is not allowed"),
        (["--samples", "100"], "samples = 100 is not allowed: it must be a power of two"),
        (["--samples", "4"], "samples = 4 is not allowed"),
        (["--set", "Q=1"], "there is no parameter 'Q'"),
    ],
)
def test_bad_input(
    options: list[str], message: str, car_trailer_fmu: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(["sensitivity", "--fmu", str(car_trailer_fmu), "--output", str(tmp_path / "out"), *options]) == 2
    assert message in capsys.readouterr().err
    assert not (tmp_path / "out").exists()
