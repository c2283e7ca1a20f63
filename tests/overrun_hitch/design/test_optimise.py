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
from tests.sampling import sampled


@pytest.mark.full
@given(ratio=st.floats(0.03, 0.3), case=st.sampled_from(sorted(CASES)))
@settings(max_examples=10, deadline=None)
def test_it_is_enough_at_every_speed_and_less_is_not(ratio: float, case: str) -> None:
    wanted = Wanted(ratio=ratio)
    found = smallest(CASES[case], "C", 0.0, 5000.0, wanted)
    C = found.value
    speeds = np.linspace(10.0, 40.0, 301)
    enough, less = (shunting_mode(CASES[case].changed({"C": each}), speeds).damping_ratio for each in (C, 0.999 * C))
    assert enough.min() == pytest.approx(ratio, abs=1e-6)
    assert less.min() < ratio
    assert 10.0 <= found.worst <= 40.0 and not found.is_edge


def test_the_lowest_value_where_that_is_enough() -> None:
    found = smallest(DATUM, "C", 2000.0, 3000.0, Wanted(ratio=0.1))
    assert found.value == 2000.0 and found.is_edge and found.enough_until == np.inf


def test_more_is_not_better() -> None:
    """A light trailer shunts less, a heavy one more: too heavy, and it is not enough any more."""
    wanted = Wanted(ratio=0.1)
    found = smallest(DATUM, "M_t", 5.0, 5000.0, wanted)
    assert found.is_edge and 5.0 < found.enough_until < 500.0
    until, further = (DATUM.changed({"M_t": factor * found.enough_until}) for factor in (0.999, 1.001))
    assert least_damping(until, wanted)[0] > 0.1 > least_damping(further, wanted)[0]


@pytest.mark.parametrize("name", sampled(["V_0", "mu", "k_2", "F_pull_max"], ["mu", "k_2"]))
def test_what_has_no_influence_is_told(name: str) -> None:
    low, high = default_range(DATUM, name)
    with pytest.raises(HitchError, match=rf"^{name} has no influence: .* 0\.05323 "):
        smallest(DATUM.changed({"C": 500.0}), name, low, high, Wanted(ratio=0.1))


@pytest.mark.parametrize(
    ("rebound", "ratio"),
    [
        (3.0, 0.1),
        (0.0, 0.05),
        pytest.param(3.0, 0.2, marks=pytest.mark.full),
        pytest.param(1.5, 0.2, marks=pytest.mark.full),
    ],
)
def test_a_damper_of_two_rates(car_trailer_fmu: Path, rebound: float, ratio: float) -> None:
    """Half the damper with three times the rebound, for light damping; the FMU's decrement says so."""
    wanted, single = Wanted(ratio=ratio), smallest(DATUM, "C", 0.0, 5000.0, Wanted(ratio=ratio)).value
    with opened_unit(car_trailer_fmu) as unit:
        found = optimise(unit, DATUM.changed({"rebound": rebound}), "C", 0.0, 5000.0, wanted)
    assert found.found.value == pytest.approx(single * 2.0 / (1.0 + rebound), rel=1e-6)
    assert [one.verdict for one in found.damping] == ["agrees"] * 2
    assert max(one.allowed / one.expected for one in found.damping) < 0.03


def test_a_threshold_and_more_stiffnesses(car_trailer_fmu: Path) -> None:
    """Beyond its threshold, before its second stiffness: the damper is that of the paper's drawbar."""
    device = DATUM.changed({"F_0": 150.0, "x_2": 0.02, "k_2": 16e3, "travel": 0.08, "eps": 0.01, "sigma": 0.3})
    with opened_unit(car_trailer_fmu) as unit:
        found = optimise(unit, device, "C", 0.0, 5000.0, Wanted(ratio=0.1))
    assert [one.verdict for one in found.damping] == ["agrees"] * 2
    assert found.found.value == pytest.approx(833.3, rel=0.02)


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
        (["--ratio", "0"], "ratio = 0 is not allowed: damping ratio must be a finite number, at least 0.001, less"),
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
