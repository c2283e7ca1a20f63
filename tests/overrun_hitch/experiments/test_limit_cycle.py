"""Sustained oscillations of the FMU at held speed."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from overrun_hitch.experiments.limit_cycle import sustained_motion, weight_push
from overrun_hitch.fmu.opening import opened_unit
from overrun_hitch.fmu.unit import HitchUnit
from overrun_hitch.parameters import CASES, Parameters
from overrun_hitch.theory.describing_function import predicted_cycles

V, GRADE = 40.0, -0.1


@pytest.fixture
def unit(car_trailer_fmu: Path) -> Iterator[HitchUnit]:
    with opened_unit(car_trailer_fmu) as unit:
        yield unit


def case_ii(C: float, eps: float = 0.1) -> Parameters:
    return CASES["ii"].changed({"C": C, "eps": eps})


def test_it_is_the_same_from_inside_and_from_outside(unit: HitchUnit) -> None:
    small, large = (sustained_motion(unit, case_ii(90.0), V, GRADE, start) for start in (0.005, 0.04))
    print(f"from 5 mm {small.amplitude * 1e3:.2f} mm, from 40 mm {large.amplitude * 1e3:.2f} mm")
    assert small.verdict == large.verdict == "sustained"
    assert small.amplitude == pytest.approx(large.amplitude, rel=0.01)
    assert small.frequency == pytest.approx(large.frequency, rel=0.01)


def test_with_enough_damping_it_fades(unit: HitchUnit) -> None:
    """From well inside the clearance: what linear theory says of small motions holds for this one too."""
    assert sustained_motion(unit, case_ii(160.0), V, GRADE, 0.04).verdict == "fades"


def test_what_is_still_fading_is_not_called_sustained(unit: HitchUnit) -> None:
    """A little above the boundary a large motion takes longer to fade than we look."""
    found = sustained_motion(unit, case_ii(130.0), V, GRADE, 0.04)
    assert found.verdict == "unsettled" and found.growth_rate < -0.01


def test_clearance_that_is_not_crossed_does_not_matter(unit: HitchUnit) -> None:
    half, full = (sustained_motion(unit, case_ii(80.0, eps), V, GRADE, 0.02) for eps in (0.05, 0.1))
    assert half.lowest > 0.0 and full.lowest == pytest.approx(half.lowest + 0.05, abs=1e-4)
    assert full.amplitude == pytest.approx(half.amplitude, rel=1e-4)
    assert full.frequency == pytest.approx(half.frequency, rel=1e-4)


def test_it_scales_with_the_weight_along_the_road(unit: HitchUnit) -> None:
    steep, gentle = (sustained_motion(unit, case_ii(100.0), V, grade, 0.01 * grade / GRADE) for grade in (GRADE, -0.05))
    ratio = weight_push(case_ii(100.0), GRADE) / weight_push(case_ii(100.0), -0.05)
    assert steep.amplitude / gentle.amplitude == pytest.approx(ratio, rel=0.02)
    assert steep.frequency == pytest.approx(gentle.frequency, rel=0.01)


@pytest.mark.parametrize(
    ("C", "amplitude", "frequency"),
    [
        (115.0, 0.03, 0.01),
        pytest.param(110.0, 0.05, 0.01, marks=pytest.mark.full),
        pytest.param(100.0, 0.12, 0.03, marks=pytest.mark.full),
    ],
)
def test_near_the_boundary_the_describing_function_predicts_it(
    unit: HitchUnit, C: float, amplitude: float, frequency: float
) -> None:
    """What is neglected grows with the part of the cycle that is spent in the clearance."""
    (predicted,) = predicted_cycles(case_ii(C), V, weight_push(case_ii(C), GRADE))
    found = sustained_motion(unit, case_ii(C), V, GRADE, predicted.amplitude)
    print(
        f"C = {C:g}: {found.amplitude / predicted.amplitude - 1:+.3f}, {found.frequency / predicted.frequency - 1:+.3f}"
    )
    assert found.amplitude == pytest.approx(predicted.amplitude, rel=amplitude)
    assert found.frequency == pytest.approx(predicted.frequency, rel=frequency)
    assert abs(found.growth_rate) < 1e-3


def test_what_cannot_be_held_is_said(unit: HitchUnit) -> None:
    assert sustained_motion(unit, case_ii(20.0, 0.0), V, GRADE, 0.005).verdict == "runs away"
