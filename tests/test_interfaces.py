"""FMI 2 and 3, Co-Simulation and Model Exchange: four ways to the same trajectories."""

from __future__ import annotations

from pathlib import Path

import fmpy
import numpy as np
import pytest

from overrun_hitch.parameters import FIGURES
from overrun_hitch.results import VARIABLES

# fmpy's CVode is a BDF method: its global error over 45 events of figure 6a is 1e7 times its tolerance.
TOLERANCE = {"CoSimulation": 1e-10, "ModelExchange": 1e-13}
WAYS = [(2, "CoSimulation"), (2, "ModelExchange"), (3, "CoSimulation"), (3, "ModelExchange")]


def simulate(fmu: Path, interface: str, figure: str, tolerance: float | None = None) -> np.ndarray:
    scenario = FIGURES[figure]
    return fmpy.simulate_fmu(
        str(fmu),
        fmi_type=interface,
        stop_time=scenario.duration,
        output_interval=0.01,
        relative_tolerance=tolerance or TOLERANCE[interface],
        start_values={**scenario.parameters.model_dump(), "brake_torque": scenario.brake_torque},
        output=list(VARIABLES),
        record_events=False,
    )


@pytest.mark.parametrize("figure", ["6a", "6b", "8", "10"])
def test_the_same_trajectories(car_trailer_fmus: dict[int, Path], figure: str) -> None:
    runs = {way: simulate(car_trailer_fmus[way[0]], way[1], figure) for way in WAYS}
    reference = runs[WAYS[0]]
    for (version, interface), run in runs.items():
        assert run["time"] == pytest.approx(reference["time"], abs=1e-12)
        worst = max(np.abs(run[name] - reference[name]).max() / np.ptp(reference[name]) for name in VARIABLES)
        print(f"figure {figure}, FMI {version} {interface}: {worst:.1e}")
        assert worst < 1e-6


# Tolerance, and the largest error of the compression in m, at most: Co-Simulation, and fmpy's CVode in Model Exchange.
BUYS = {
    ("8", 1e-4): (3e-5, 3e-3),
    ("8", 1e-6): (3e-7, 1e-4),
    ("8", 1e-8): (1e-9, 3e-6),
    ("6a", 1e-4): (1e-3, 1e-1),
    ("6a", 1e-6): (3e-6, 1e-3),
    ("6a", 1e-8): (1e-9, 1e-4),
}


@pytest.mark.parametrize("figure", ["8", "6a"])
def test_what_a_tolerance_buys(figure: str, car_trailer_fmu: Path) -> None:
    exact = simulate(car_trailer_fmu, "CoSimulation", figure)["compression"]  # at 1e-10
    for tolerance in (1e-4, 1e-6, 1e-8):
        errors = [
            np.abs(simulate(car_trailer_fmu, kind, figure, tolerance)["compression"] - exact).max()
            for kind in TOLERANCE
        ]
        print(f"figure {figure}, {tolerance:.0e}: {errors[0]:.0e} m, by CVode in Model Exchange {errors[1]:.0e} m")
        assert all(error < allowed for error, allowed in zip(errors, BUYS[figure, tolerance], strict=True))
