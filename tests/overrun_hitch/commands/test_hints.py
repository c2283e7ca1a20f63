"""Hints about what is hardly meant: one line on stderr, and the exit status stays."""

from __future__ import annotations

from pathlib import Path

import pytest

from overrun_hitch import cli
from overrun_hitch.commands.hints import hint_sweep, hints
from overrun_hitch.parameters import CASES, DATUM, FIGURES
from overrun_hitch.sweeps.planner import planned
from overrun_hitch.sweeps.spec import SweepSpec


def test_the_papers_own_runs_get_none() -> None:
    assert [line for case in CASES.values() for line in hints(case, 1000.0)] == []
    assert [line for figure in FIGURES.values() for line in hints(figure.parameters, figure.brake_torque)] == []


@pytest.mark.parametrize(
    ("changes", "torque", "said"),
    [
        ({"V_0": 120.0}, 0.0, ["V_0 = 120 m/s is 432 km/h; speeds are in m/s"]),
        ({"R_c": 35.0}, 0.0, ["R_c = 35 m is a large wheel; radii are in m"]),
        ({"R_t": 35.0}, 0.0, ["R_t = 35 m is a large wheel; radii are in m"]),
        ({"C_kc": 1e7}, 5000.0, ["5000 N.m would brake by 13 m/s2, more than 1 g"]),
        ({"C_kc": 2e4}, 1000.0, ["the car's slip would be 0.14; beyond 0.1 a tyre needs its friction, mu"]),
        ({"C_kc": 2e4, "mu": 1.0}, 1000.0, []),
        ({"mu": 0.25}, 1000.0, ["1000 N.m is more than friction, mu = 0.25, can hold: the car's wheels lock"]),
        ({"k": 0.0, "r": 0.0}, 1000.0, []),
    ],
)
def test_each_thing_gets_one_line(changes: dict[str, float], torque: float, said: list[str]) -> None:
    assert list(hints(DATUM.changed(changes), torque)) == said


def test_a_sweep_is_told_once_what_its_ends_are(car_trailer_fmu: Path, capsys: pytest.CaptureFixture[str]) -> None:
    grid = {"V_0": {"min": 20.0, "max": 120.0, "count": 6}, "R_t": {"min": 0.3, "max": 35.0, "count": 3}}
    hint_sweep(planned(SweepSpec(grid=grid, duration=2.0), [car_trailer_fmu]))
    expected = ["V_0 = 120 m/s is 432 km/h; speeds are in m/s", "R_t = 35 m is a large wheel; radii are in m"]
    assert sorted(capsys.readouterr().err.splitlines()) == sorted(f"hint: {line}" for line in expected)
    profile = {"hard": {"time": [0.0], "brake_torque": [9000.0]}}
    together = {"k_t": [0.0, 548e3], "F_0": [0.0, 100.0]}  # of which one run will be refused
    for quiet in (SweepSpec(grid={"C": [100.0, 500.0]}), SweepSpec(grid=together), SweepSpec(profiles=profile)):
        hint_sweep(planned(quiet, [car_trailer_fmu]))
    assert capsys.readouterr().err == ""


def test_the_command_goes_on(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["stability", "--V", "120", "--C", "500", "--output", str(tmp_path)]) == 0
    out, err = capsys.readouterr()
    assert err == "hint: V_0 = 120 m/s is 432 km/h; speeds are in m/s\n"
    assert "shunting mode by linear theory" in out and "hint" not in out
