"""The benchmark's table: which tolerance, in which order, which verdict; on contenders that are made up."""

from __future__ import annotations

import numpy as np
import pytest

from benchmarks.comparison import ALLOWED, CVODE, FROM_C, FROM_FMPY, RADAU, TOLERANCES, Row, in_turns, loosest, table
from benchmarks.contender import SCENARIO, TIME, Contender, Run
from benchmarks.work_precision import STYLES, drawn
from tests.oracles import radau


def exact() -> np.ndarray:
    return radau.trajectory(SCENARIO.parameters, SCENARIO.brake_torque).compression[::10]


def row(name: str, milliseconds: float, error: float = 1e-6) -> Row:
    run = Run(0.0, exact() + error * (TIME == 3.0), evaluations=50, steps=7)
    return Row(name, 1e-4, run, 1e-3 * milliseconds * np.array([0.5, 0.9, 1.0, 1.1, 9.0]))


def verdicts(*rows: Row) -> tuple[dict[str, str], bool]:
    lines, met = table([row(FROM_C, 2.0), row(FROM_FMPY, 8.0), *rows])
    cells = [[cell.strip() for cell in line.split("|")[1:-1]] for line in lines]
    assert {len(line) for line in cells} == {10}
    return {line[0]: " ".join(line[1:]) for line in cells[2:]}, met


def test_ratios_are_of_medians_and_judged_where_something_is_demanded() -> None:
    text, met = verdicts(row(RADAU, 210.0), row(CVODE, 25.0), row("SciPy's LSODA, numpy", 1.0))
    assert met
    assert text[RADAU] == "1.0e-04 1.0e-06 50 7 210 (189 to 231) 105 26.2 100 times C met"
    assert text[CVODE].endswith("12.5 3.12 3 times fmpy met")
    assert text["SciPy's LSODA, numpy"].strip().endswith("0.5 0.125")


@pytest.mark.parametrize("missed", [row(RADAU, 190.0), row(CVODE, 23.0), row(RADAU, 210.0, error=1.1 * ALLOWED)])
def test_too_small_a_ratio_or_too_large_an_error_is_not_met(missed: Row) -> None:
    text, met = verdicts(missed)
    assert not met
    assert text[missed.name].endswith("NOT MET")


def test_the_loosest_tolerance_within_the_error_is_taken() -> None:
    contender = Contender("made up", lambda tolerance, _: Run(0.0, exact() + 0.3 * tolerance))
    found = loosest(contender, ALLOWED)
    assert 0.3 * found <= ALLOWED < 0.3 * TOLERANCES[TOLERANCES.index(found) - 1]
    with pytest.raises(ValueError, match="made up does not reach 1e-15 m"):
        loosest(contender, 1e-15)


def test_everyone_has_a_turn_in_every_round() -> None:
    calls: list[int] = []

    def solve(number: int) -> float:
        calls.append(number)
        return float(len(calls))

    times = in_turns([lambda: solve(0), lambda: solve(1)], 3, "turns")
    assert calls == [0, 1, 0, 1, 0, 1]
    np.testing.assert_array_equal(times, [[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]])


def test_the_diagram_names_every_contender() -> None:
    times = np.array([1e-3, 2e-3])
    labels = drawn({name: (times, 1e-4 * times) for name in STYLES}).axes[0].get_legend_handles_labels()[1]
    assert labels[:-1] == list(STYLES)
