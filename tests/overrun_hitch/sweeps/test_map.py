"""The map of a sweep: what is drawn over the metric, where, and what the legend calls it."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure

from overrun_hitch.measure.metrics import METRICS
from overrun_hitch.parameters import DATUM, Parameters
from overrun_hitch.sweeps.map import draw_map
from overrun_hitch.sweeps.table import show
from overrun_hitch.theory.boundary import critical_damping

DAMPERS, SPEEDS = np.linspace(20.0, 220.0, 11), np.linspace(20.0, 40.0, 5)


def swept(**fixed: float) -> xr.Dataset:
    """A sweep whose growth rate is 0 at C = 100 N.s/m, and whose drawbar leaves compression below 60 N.s/m."""
    C, V_0 = (grid.ravel() for grid in np.meshgrid(DAMPERS, SPEEDS))
    metrics = {
        "growth_rate": np.where(C < 40.0, np.nan, 0.001 * (100.0 - C)),
        "fit_residual": np.where(C < 40.0, 0.2, 1e-4),
        "time_out_of_compression": np.where(C < 60.0, 0.5, 0.0),
    }
    data: dict[str, Any] = {
        name: ("run", values, {"units": METRICS[name].unit, "long_name": METRICS[name].description})
        for name, values in metrics.items()
    }
    data |= {"status": ("run", np.ones(C.size, dtype=np.int8)), "message": ("run", np.full(C.size, ""))}
    coordinates: dict[str, Any] = {
        name: ("run", values, {"units": Parameters.unit(name), "long_name": Parameters.description(name)})
        for name, values in {"C": C, "V_0": V_0}.items()
    }
    coordinates |= {name: ("run", np.full(C.size, "one")) for name in ("fmu", "profile")}
    fixed = {**DATUM.changed(fixed).model_dump(exclude={"C", "V_0"})}
    return xr.Dataset(data, coordinates, {"title": "a sweep", "sweep": json.dumps({"duration": 6.0}), **fixed})


def legend(figure: Figure) -> list[str]:
    return [text.get_text() for one in figure.legends for text in one.get_texts()]


def test_the_boundary_is_linear_theorys() -> None:
    figure = draw_map(swept(), "growth_rate")
    (line,) = figure.axes[0].get_lines()
    C, V = (np.asarray(data, dtype=float) for data in line.get_data())
    assert (V.min(), V.max()) == (20.0, 40.0)
    for at in (0, 30, -1):
        assert C[at] == pytest.approx(critical_damping(DATUM, V[at]))


def test_the_legend_says_what_the_lines_and_the_hatching_are() -> None:
    assert legend(draw_map(swept(), "growth_rate")) == [
        "growth_rate = 0: fit over 6 s, in which the speed falls",
        "the drawbar leaves compression",
        "$C_\\mathrm{crit}$ at the start's speed, linear theory",
    ]


def test_no_boundary_where_theory_does_not_know_the_parameters() -> None:
    figure = draw_map(swept(CdA_t=2.0), "growth_rate")
    assert list(figure.axes[0].get_lines()) == [] and len(legend(figure)) == 2


def test_other_metrics_have_no_boundary() -> None:
    sweep = swept().drop_vars(["time_out_of_compression", "growth_rate"])
    assert legend(draw_map(sweep, "fit_residual")) == []


def test_why_runs_have_no_growth_rate_is_counted(capsys: pytest.CaptureFixture[str]) -> None:
    show("a sweep", swept(), [])
    assert "in 5 runs no exponential fits the oscillation (fit_residual over 0.05)" in capsys.readouterr().out
