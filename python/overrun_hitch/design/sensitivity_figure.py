"""Sobol indices as bars, parameter by parameter, in the order of the table; without what explains nothing."""

from __future__ import annotations

import textwrap

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from overrun_hitch.design.sensitivity import Sensitivity
from overrun_hitch.measure.metrics import METRICS
from overrun_hitch.show.traces import STYLE, WIDTH

NOTHING = 0.005  # a total index that the table would round to 0.00
FIRST, TOTAL = "#0b3c6f", "#e3a36f"  # dark and light: told apart in greyscale


def draw(found: Sensitivity, title: str) -> Figure:
    """A panel for each metric, the parameters in the order of the table, from above."""
    order = [place for place in reversed(found.ranked()) if _explains(found, place)]
    rows = np.arange(len(order))
    left_out = len(found.names) - len(order)
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(1.2 * WIDTH, 1.9 + 0.3 * len(order)), layout="constrained")
        aside = f"\n(left out: {left_out} whose total is less than {NOTHING:g} in both)" if left_out else ""
        figure.suptitle(title + aside, fontsize=10)
        panels = figure.subplots(1, len(found.indices), sharey=True)
        for axes, (metric, indices) in zip(panels, found.indices.items(), strict=True):
            error = {"ecolor": "#555555", "elinewidth": 1.0, "capsize": 2.0}
            for offset, values, confidence, colour, label in (
                (0.2, indices.total, indices.total_confidence, TOTAL, "total"),
                (-0.2, indices.first, indices.first_confidence, FIRST, "alone"),
            ):
                axes.barh(
                    rows + offset,
                    values[order],
                    0.38,
                    xerr=confidence[order],
                    color=colour,
                    error_kw=error,
                    label=label,
                )
            what = METRICS[metric].description.split(",")[0]
            axes.set_xlabel(textwrap.fill(f"Share of the variance of {what} (1)", 30))
            axes.set_axisbelow(True)
            axes.grid(axis="y", visible=False)
        panels[0].set_yticks(rows, [found.names[place] for place in order])
        panels[-1].legend(loc="lower right")
    return figure


def _explains(found: Sensitivity, place: int) -> bool:
    return any(indices.total[place] >= NOTHING for indices in found.indices.values())
