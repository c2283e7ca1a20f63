"""Sobol indices as bars, parameter by parameter, the most important on top."""

from __future__ import annotations

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from overrun_hitch.design.sensitivity import Sensitivity
from overrun_hitch.measure.metrics import METRICS
from overrun_hitch.show.traces import STYLE

FIRST, TOTAL = "#0b3c6f", "#e3a36f"  # dark and light: told apart in greyscale


def draw(found: Sensitivity, title: str) -> Figure:
    """A panel for each metric, the parameters in the order of the largest total index of the two."""
    order = np.argsort(
        [max(indices.total[place] for indices in found.indices.values()) for place in range(len(found.names))]
    )
    rows = np.arange(len(order))
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(7.2, 1.6 + 0.26 * len(order)), layout="constrained")
        figure.suptitle(title, fontsize=10)
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
            axes.set_xlabel(f"Share of the variance of\n{METRICS[metric].description.split(',')[0]} (1)")
            axes.set_axisbelow(True)
            axes.grid(axis="y", visible=False)
        panels[0].set_yticks(rows, [found.names[place] for place in order])
        panels[-1].legend(loc="lower right")
    return figure
