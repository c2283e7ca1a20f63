"""The smallest damper that is enough: by theory, by the FMU, and nothing smaller."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from overrun_hitch import cli
from overrun_hitch.design.optimise import Wanted, default_range, least_damping, optimise, smallest
from overrun_hitch.fmu.opening import opened_unit
from overrun_hitch.parameters import CASES, DATUM, HitchError
from overrun_hitch.theory.linear import shunting_mode


@given(ratio=st.floats(0.03, 0.3), case=st.sampled_from(sorted(CASES)))
@settings(max_examples=10, deadline=None)
def test_it_is_enough_at_every_speed_and_less_is_not(ratio: float, case: str) -> None:
    wanted = Wanted(ratio=ratio)
    C, worst = smallest(CASES[case], "C", 0.0, 5000.0, wanted)
    speeds = np.linspace(10.0, 40.0, 301)
    enough, less = (shunting_mode(CASES[case].changed({"C": each}), speeds).damping_ratio for each in (C, 0.999 * C))
    assert enough.min() == pytest.approx(ratio, abs=1e-6)
    assert less.min() < ratio
    assert 10.0 <= worst <= 40.0


def test_the_lowest_value_where_that_is_enough() -> None:
    assert smallest(DATUM, "C", 2000.0, 3000.0, Wanted(ratio=0.1))[0] == 2000.0


@pytest.mark.parametrize("name", ["C", "M_t"])
def test_the_fmu_confirms_it(car_trailer_fmu: Path, name: str) -> None:
    low, high = default_range(DATUM, name)
    wanted = Wanted(ratio=0.07)
    with opened_unit(car_trailer_fmu) as unit:
        found = optimise(unit, DATUM, name, low, high, wanted)
    assert least_damping(found.after, wanted)[0] >= 0.07 - 1e-9
    assert [one.verdict for one in found.damping] == ["agrees"] * len(found.damping)
    assert all(np.isfinite(values).all() for values in found.costs.values())


def test_more_damping_delays_the_trailer_brakes(car_trailer_fmu: Path) -> None:
    with opened_unit(car_trailer_fmu) as unit:
        found = optimise(unit, DATUM.changed({"eps": 0.1}), "C", 0.0, 5000.0, Wanted(ratio=0.2))
    before, after = found.costs["trailer_brake_delay"]
    assert after > before


def test_what_can_not_be_reached_is_told_with_the_most() -> None:
    with pytest.raises(HitchError, match=r"no C from 0 to 100 N\.s/m gives .* 0\.1 at all speeds .* with C = 100"):
        smallest(DATUM, "C", 0.0, 100.0, Wanted(ratio=0.1))


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--ratio", "0"], "ratio = 0 1 is not allowed: damping ratio must be a finite number, greater than 0 1"),
        (["--V", "20"], "--V '20' is no range; allowed: A:B"),
        (["--V", "40:10"], "--V '40:10' is an empty range"),
        (["--V", "0:10"], "V_low = 0 m/s is not allowed"),
        (["--free", "Q"], "there is no parameter 'Q'"),
        (["--free", "eps"], "eps = 0 m gives no range to look in: say --range A:B"),
        (["--range=-5:5"], "C = -5 N.s/m is not allowed"),
        (["--ratio", "0.9", "--range", "0:10"], "no C from 0 to 10 N.s/m gives a damping ratio of 0.9"),
    ],
)
def test_bad_input(options: list[str], message: str, car_trailer_fmu: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["optimise", "--fmu", str(car_trailer_fmu), *options]) == 2
    assert message in capsys.readouterr().err


def test_the_command(car_trailer_fmu: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["optimise", "--fmu", str(car_trailer_fmu), "--case", "iii", "--V", "20:40"]) == 0
    out = capsys.readouterr().out
    assert "case iii: C = " in out
    assert "agrees" in out
    assert "trailer_brake_delay" in out
