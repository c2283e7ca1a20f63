"""Results keep units and digits, on disk too."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from overrun_hitch.parameters import FIGURES, HitchError
from overrun_hitch.results import VARIABLES, Run, columns, missing, read_csv, scenario_of, values, with_samples
from overrun_hitch.show.files import write_csv

OracleRun = Callable[..., xr.Dataset]


def test_csv_keeps_every_digit_and_unit(oracle_run: OracleRun, tmp_path: Path) -> None:
    run = oracle_run(FIGURES["8"])
    path = tmp_path / "new" / "run.csv"
    write_csv(path, columns(run))
    assert path.read_text(encoding="utf-8").startswith("time [s],v_car [m/s],v_trailer [m/s],a_car [m/s2],")
    back = read_csv(path)
    xr.testing.assert_identical(back, run.drop_attrs(deep=False))
    assert [entry.name for entry in path.parent.iterdir()] == ["run.csv"]


def test_the_scenario_is_in_the_attributes(oracle_run: OracleRun) -> None:
    assert scenario_of(oracle_run(FIGURES["10"])) == FIGURES["10"]
    with pytest.raises(HitchError, match=r"^the result does not say what was run: attribute scenario is missing$"):
        scenario_of(xr.Dataset())


@pytest.mark.parametrize("text", ["", "time [s]\n1,2\n", "time [s]\nx\n", "time [s],v_car [km/h]\n0,1\n", "\x00\n1\n"])
def test_anything_else_is_refused_in_one_line(tmp_path: Path, text: str) -> None:
    path = tmp_path / "bad.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(HitchError, match=r"bad\.csv") as caught:
        read_csv(path)
    assert "\n" not in str(caught.value)
    with pytest.raises(HitchError, match=r"cannot read"):
        read_csv(tmp_path / "none.csv")


def test_variables_say_what_they_are(oracle_run: OracleRun) -> None:
    run = oracle_run(FIGURES["8"])
    for name in [*run.data_vars, "time"]:
        assert run[name].attrs["units"]
        assert run[name].attrs["long_name"]
        assert np.isfinite(run[name]).all()


def test_a_run_is_the_same_with_and_without_xarray(oracle_run: OracleRun) -> None:
    there = oracle_run(FIGURES["8"])
    run = Run(values(there, "time"), {name: values(there, name) for name in VARIABLES}, there.attrs)
    assert run.dataset().identical(there)
    assert scenario_of(run) == scenario_of(there) and missing(run) == missing(there)
    other = {"v_car": 2.0 * values(run, "v_car")}
    assert with_samples(run, other).dataset().identical(with_samples(there, other))
    assert values(with_samples(run, other), "a_car") is values(run, "a_car")
    for one, same in zip(columns(run).items(), columns(there).items(), strict=True):
        assert one[0] == same[0] and (one[1] == same[1]).all()
