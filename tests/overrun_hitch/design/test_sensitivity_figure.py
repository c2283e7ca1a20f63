"""The picture of Sobol indices is the table's: its order, less what explains nothing."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from overrun_hitch.design.sensitivity import Indices, Sensitivity
from overrun_hitch.design.sensitivity_figure import NOTHING, draw
from overrun_hitch.design.sensitivity_table import show


def indices(*total: float) -> Indices:
    values = np.array(total)
    return Indices(values, 0.1 * values, values, 0.1 * values)


def test_rows_are_those_of_the_table(capsys: pytest.CaptureFixture[str]) -> None:
    found = Sensitivity(
        ("mu", "k", "r", "C"),
        {"damping_ratio": indices(0.0, 0.001, 0.3, 0.5), "peak_jerk": indices(0.9 * NOTHING, 0.6, 0.02, 0.0)},
        64,
    )
    figure = draw(found, "a title")
    shown = [label.get_text() for label in figure.axes[0].get_yticklabels()][::-1]  # from above
    show("a title", found, [Path("out.svg")])
    rows = [line.split()[0] for line in capsys.readouterr().out.splitlines() if line.split()[0] in found.names]
    assert rows == ["C", "r", "k", "mu"] and shown == ["C", "r", "k"]
    assert "left out: 1 " in figure.get_suptitle()
    totals = [bar.get_width() for bar in figure.axes[1].patches[: len(shown)]]
    assert totals[::-1] == [0.0, 0.02, 0.6]


def test_where_all_explain_something_nothing_is_said() -> None:
    both = {"damping_ratio": indices(0.5, 0.5), "peak_jerk": indices(0.4, 0.6)}
    assert draw(Sensitivity(("C", "r"), both, 32), "a title").get_suptitle() == "a title"
