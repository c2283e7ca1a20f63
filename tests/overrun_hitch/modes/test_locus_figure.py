"""Root loci: smooth curves with marks where they belong, the same bytes for the same curves."""

from __future__ import annotations

import itertools
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.lines import Line2D
from matplotlib.text import Text

from overrun_hitch.modes.locus import LocusCurve, computed, draw_loci, spread
from overrun_hitch.parameters import CASES
from overrun_hitch.show.traces import rendered, save
from overrun_hitch.theory.linear import shunting_mode
from tests.sampling import sampled

DAMPERS = [0.0, 50.0, 100.0, 200.0, 400.0, 800.0, 1600.0, 3200.0]


@pytest.fixture(scope="module")
def curves() -> list[LocusCurve]:
    return [computed(f"case {case}", CASES[case], 20.0, DAMPERS) for case in ("i", "ii", "iii")]


def named(lines: list[Line2D], label: str) -> Line2D:
    return next(line for line in lines if line.get_label() == label)


def test_marks_lie_on_the_curve(curves: list[LocusCurve]) -> None:
    for C in DAMPERS:
        expected = complex(shunting_mode(CASES["ii"].changed({"C": C}), 20.0).eigenvalue)
        assert curves[1].at(C) == pytest.approx(expected, rel=1e-12)
    line = named(list(draw_loci(curves).axes[0].lines), "case ii")
    marked = np.column_stack(line.get_data())[line.get_markevery()]
    assert marked == pytest.approx(np.array([[curves[1].at(C).real, curves[1].at(C).imag] for C in DAMPERS]))


@pytest.mark.parametrize("last", [3200.0, 1e5])
def test_the_curve_is_smooth_even_where_it_meets_the_real_axis(last: float) -> None:
    curve = computed("", CASES["ii"], 20.0, [0.0, last])
    steps = np.abs(np.diff(curve.eigenvalue)) / np.abs(curve.eigenvalue).max()
    assert steps.max() < 0.04
    assert len(curve.C) < 500
    assert (np.diff(curve.C) > 0.0).all()


def test_axes_boundary_and_numbers(curves: list[LocusCurve]) -> None:
    plane = draw_loci(curves, real=(-5.0, 0.3), imaginary=(0.0, 12.0)).axes[0]
    assert plane.get_xlabel() == "Real part (1/s)"
    assert plane.get_ylabel() == "Imaginary part (rad/s)"
    assert plane.get_xlim() == (-5.0, 0.3)
    assert plane.get_ylim() == (0.0, 12.0)
    numbers = {text.get_text() for text in plane.texts}
    assert numbers == {f"{C:g}" for C in DAMPERS}


@given(st.lists(st.floats(0.0, 1.0), max_size=30), st.floats(0.001, 0.2))
def test_numbers_stand_apart_and_near_their_marks(places: list[float], apart: float) -> None:
    wanted = np.sort(places)
    found = spread(wanted, apart)
    room = min(apart, 1.0 / max(len(places), 1))
    assert (np.diff(found) >= room - 1e-12).all()
    assert len(found) == 0 or (found[0] >= 0.5 * room - 1e-12 and found[-1] <= 1.0 - 0.5 * room + 1e-12)
    if len(places) and (np.diff(wanted) > room).all() and wanted[0] > 0.5 * room and wanted[-1] < 1.0 - 0.5 * room:
        np.testing.assert_allclose(found, wanted, atol=1e-12)


@pytest.mark.parametrize("count", sampled([2, 8, 16], [16]))
def test_no_number_lies_on_another(count: int) -> None:
    marks = np.geomspace(1.0, 40000.0, count)
    figure = draw_loci([computed("case ii", CASES["ii"], 20.0, marks)], title="x")
    rendered(figure, "svg")
    boxes = [Text.get_window_extent(number) for number in figure.axes[0].texts]  # without the line to the mark
    assert len(boxes) == count
    assert not [pair for pair in itertools.combinations(boxes, 2) if pair[0].overlaps(pair[1])]


def test_measured_points_are_open_marks() -> None:
    measured = (np.array([100.0]), np.array([-0.05 + 10.2j]))
    figure = draw_loci([computed("case ii", CASES["ii"], 20.0, DAMPERS, measured)], damper=(0.0, 400.0))
    for axes, expected in zip(figure.axes, ((-0.05, 10.2), (100.0, -0.05)), strict=True):
        points = [
            line for line in axes.lines if line.get_markerfacecolor() == "none" and line.get_linestyle() == "None"
        ]
        assert [tuple(line.get_xydata()[0]) for line in points] == [pytest.approx(expected)]
    assert "measured" in figure.legends[0].get_title().get_text()


def test_one_damper_alone_can_be_drawn() -> None:
    assert draw_loci([computed("case ii", CASES["ii"], 20.0, [500.0])]).axes[0].texts[0].get_text() == "500"


def test_the_same_curves_give_the_same_files(curves: list[LocusCurve], tmp_path: Path) -> None:
    first, second = (save(draw_loci(curves, title="x", damper=(0.0, 200.0)), tmp_path / name) for name in "ab")
    for one, other in zip(first, second, strict=True):
        assert one.read_bytes() == other.read_bytes()
