"""The paper's figures and the three beyond it: what is drawn, on which axes, from which numbers."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from overrun_hitch.experiments.limit_cycle import Sustained
from overrun_hitch.paper.figures import boundary as boundary_figure
from overrun_hitch.paper.figures import cycles as cycles_figure
from overrun_hitch.paper.figures import device as device_figure
from overrun_hitch.paper.figures import steady as steady_figure
from overrun_hitch.paper.figures.all import stem
from overrun_hitch.paper.figures.steady import DECELERATION, DEFLECTIONS, stiffness
from overrun_hitch.paper.study.curves import DAMPERS
from overrun_hitch.paper.study.device import SPEEDS
from overrun_hitch.paper.study.study import Study
from overrun_hitch.parameters import CASES, DATUM
from overrun_hitch.theory.steady import steady

TRACES = ("6a", "6b", "7", "8", "9", "10", "11")


def points(axes: Axes, marker: str) -> np.ndarray:
    """Where (n, 2) this marker stands alone, without a line."""
    lines = [line for line in axes.lines if line.get_marker() == marker and line.get_linestyle() == "None"]
    return np.concatenate([np.column_stack(line.get_data()) for line in lines] or [np.empty((0, 2))])


def test_they_are_all_there(paper_figures: dict[str, Figure]) -> None:
    assert list(paper_figures) == ["3", "4", "5", *TRACES, "boundary", "cycles", "device", "stops"]
    assert stem("6a") == "figure-6a" and stem("cycles") == "cycles"
    for figure in paper_figures.values():
        # Inner panels of a stack share the axis below.
        assert all(axes.get_ylabel() for axes in figure.axes)
        assert "(" in figure.axes[-1].get_xlabel() or "(" in figure.axes[0].get_xlabel()


@pytest.mark.parametrize("deflection", DEFLECTIONS)
@pytest.mark.parametrize("ratio", [0.0, 1.225, 2.975, 10.0])
def test_stiffness_for_a_deflection(ratio: float, deflection: float) -> None:
    k = stiffness(ratio, deflection)
    parameters = DATUM.changed({"k": k, "r": ratio * k})
    per_torque = steady(parameters, 1.0)
    assert per_torque.D / abs(per_torque.A) == pytest.approx(deflection / DECELERATION, rel=1e-12)


def test_figure_3(paper_figures: dict[str, Figure], paper_study: Study) -> None:
    ratios, k = paper_figures["3"].axes
    assert ratios.get_xlim() == (0.0, 10.0) and k.get_xlim() == (0.0, 10.0)
    marks = np.concatenate([points(ratios, "o"), points(ratios, "s")])
    assert marks[:, 1] == pytest.approx([paper_study.steady_fmu[case].ratio for case in CASES])
    curve = ratios.lines[0]
    assert np.interp(2.975, *curve.get_data()) == pytest.approx(0.95, abs=1e-4)
    for case in ("i", "ii", "iii"):  # the three that give 1 cm per m/s2
        p = CASES[case]
        assert np.interp(p.r / p.k, *k.lines[1].get_data()) == pytest.approx(p.k, rel=5e-3)


@pytest.mark.parametrize("figure", ["4", "5"])
def test_root_loci(paper_figures: dict[str, Figure], paper_study: Study, figure: str) -> None:
    plane, _ = paper_figures[figure].axes
    left, right = plane.get_xlim()
    assert left < -5.0 and right == pytest.approx(0.3)
    measured = np.concatenate([points(plane, marker) for marker in "os^DvP"])
    expected = [mode.eigenvalue for locus in paper_study.loci[figure] for mode in locus.fmu]
    assert len(measured) == 6 * len(DAMPERS)
    assert sorted(measured[:, 0]) == pytest.approx(sorted(value.real for value in expected))
    assert (measured[:, 0] > left).all()


@pytest.mark.parametrize("figure", TRACES)
def test_traces_fit_their_axes(paper_figures: dict[str, Figure], figure: str) -> None:
    panels = paper_figures[figure].axes
    assert len(panels) == 3 and panels[0].get_xlim() == (0.0, 6.0)
    for axes in panels:
        low, high = axes.get_ylim()
        for line in axes.lines:
            values = np.asarray(line.get_ydata(), dtype=float)
            assert low <= values.min() and values.max() <= high


def test_figures_to_be_compared_have_the_same_axes(paper_figures: dict[str, Figure]) -> None:
    for group in (("6b", "7", "8"), ("9", "10", "11")):
        limits = {tuple(axes.get_ylim() for axes in paper_figures[name].axes) for name in group}
        assert len(limits) == 1


def test_boundary_marks_where_the_fmu_agrees(paper_figures: dict[str, Figure], paper_study: Study) -> None:
    (axes,) = paper_figures["boundary"].axes
    assert len(points(axes, "o")) == 9 and len(points(axes, "X")) == 0
    first, *others = paper_study.boundary.checks
    wrong = dataclasses.replace(paper_study.boundary, checks=(dataclasses.replace(first, growth_below=-1.0), *others))
    (axes,) = boundary_figure.draw(wrong).axes
    assert len(points(axes, "o")) == 8
    assert points(axes, "X").tolist() == [[first.ratio, first.V]]


def test_the_lag_marks_where_the_fmu_agrees(paper_figures: dict[str, Figure], paper_study: Study) -> None:
    assert [len(points(axes, "o")) for axes in paper_figures["device"].axes] == [3, 3]
    assert [len(points(axes, "X")) for axes in paper_figures["device"].axes] == [0, 0]
    first, *others = paper_study.device.checks
    wrong = dataclasses.replace(paper_study.device, checks=(dataclasses.replace(first, growth_below=-1.0), *others))
    axes = device_figure.draw(wrong).axes[SPEEDS.index(first.V)]
    assert points(axes, "X").tolist() == [[first.ratio, 1e3 * first.tau_b]]


def test_the_lags_closed_form_is_within_three_per_cent(paper_study: Study) -> None:
    """Of the chart, over all speeds, lags and r/k."""
    found = paper_study.device
    np.testing.assert_allclose(found.closed_form, found.C_crit, rtol=0.031)


def test_cycles_show_every_motion(paper_figures: dict[str, Figure], paper_study: Study) -> None:
    amplitudes, frequencies = paper_figures["cycles"].axes
    found = np.concatenate([points(amplitudes, marker) for marker in "Ps^o"])
    assert len(found) == len(paper_study.motions)
    away = [motion for motion in paper_study.motions if motion.fmu.verdict == "runs away"]
    assert len(points(amplitudes, r"$\uparrow$")) == len(away)
    heights = sorted(1e3 * m.fmu.amplitude for m in paper_study.motions if m.fmu.verdict == "sustained")
    assert sorted(y for _, y in found if 0.0 < y < 90.0) == pytest.approx(heights)
    assert len(np.concatenate([points(frequencies, marker) for marker in "Ps^o"])) == len(heights)


def test_an_unsettled_motion_is_drawn_as_such(paper_study: Study, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cycles_figure, "DAMPERS", np.array([0.9]))  # the lines would take seconds
    growing = Sustained("unsettled", 0.02, 1.5, 0.01, 0.0)
    motion = dataclasses.replace(paper_study.motions[0], fmu=growing)
    figure = cycles_figure.draw([motion, *paper_study.motions[1:]])
    assert "FMU has not settled" in [text.get_text() for text in figure.legends[0].get_texts()]
    assert [y for x, y in points(figure.axes[0], "P") if x == motion.C] == [20.0]


def test_figure_3_shows_what_the_fmu_gave(paper_study: Study) -> None:
    wrong = {**paper_study.steady_fmu, "ii": dataclasses.replace(paper_study.steady_fmu["ii"], ratio=0.7)}
    axes = steady_figure.draw(wrong).axes[0]
    assert 0.7 in points(axes, "o")[:, 1]


def test_stops_show_prediction_and_fmu(paper_figures: dict[str, Figure], paper_study: Study) -> None:
    trace, amplitudes, errors = paper_figures["stops"].axes
    compression, steady_line, *envelope = trace.lines[0], trace.lines[3], *trace.lines[1:3]
    assert steady_line.get_linestyle() == "--" and len(set(steady_line.get_ydata())) == 1
    below, above = (np.interp(compression.get_xdata(), *line.get_data()) for line in envelope)
    at_speed = np.asarray(compression.get_xdata()) < 15.0
    height = np.asarray(compression.get_ydata())[at_speed]
    assert (height > below[at_speed] - 0.05).all() and (height < above[at_speed] + 0.05).all()
    for found, marker in zip(paper_study.stops, "os^P", strict=True):
        assert points(amplitudes, marker)[:, 1] == pytest.approx(1e3 * found.fmu.amplitude)
        assert points(errors, marker)[:, 1] == pytest.approx(1e2 * found.in_theory.error)
    low, high = errors.get_ylim()
    assert all(low < y < high for marker in "os^P" for _, y in points(errors, marker))
    turnings = sorted(points(amplitudes, "|")[:, 1])
    assert turnings == pytest.approx(sorted(1e3 * found.fmu.predicted.max() for found in paper_study.stops
                                            if found.turning < 40.0), rel=1e-3)  # fmt: skip
