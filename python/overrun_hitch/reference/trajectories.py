"""Trajectories by two solvers that share nothing, and how far they are apart: that is what is said of their accuracy.

One is the unit's own (Rosenbrock's method of order 5, its switching points located on the dense output), the other
CVODE (BDF with root finding) on the unit's Model Exchange half. That the unit's equations are the paper's is another
question, which tests answer with SciPy on equations written down by hand.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from overrun_hitch.experiments.drive import drive
from overrun_hitch.fmu.guest_unit import guest_file
from overrun_hitch.fmu.settings import TIME_LIMIT, Use
from overrun_hitch.foreign.mapping import NO_NAMES
from overrun_hitch.parameters import Scenario
from overrun_hitch.results import VARIABLES, dataset, scenario_attributes, values

Floats = NDArray[np.float64]

STEP = 0.01  # s
TOLERANCES: Mapping[Use, float] = {"cs": 1e-12, "me": 1e-9}  # CVODE's own is a thousand times smaller
ALLOWED = 1e-5  # of a variable's range: a hundredth of what `hitch crosscheck` allows


@dataclass(frozen=True)
class Trajectory:
    """One case of the set."""

    scenario: Scenario
    run: xr.Dataset  # by the unit's own solver, see results.dataset
    accuracy: Mapping[str, float]  # largest distance of the other solver's, in the variable's unit

    @property
    def differing(self) -> list[str]:
        """Variables of which the two solvers say different things."""
        return [
            name for name, far in self.accuracy.items() if not far <= ALLOWED * float(np.ptp(values(self.run, name)))
        ]


def trajectory(fmu: Path, scenario: Scenario, time_limit: float = TIME_LIMIT) -> Trajectory:
    """`scenario` on our FMU, beyond standstill if it goes so far. HitchError for an FMU that is not ours."""
    own, other = (_table(fmu, scenario, use, time_limit) for use in TOLERANCES)
    time: Floats = np.arange(len(own), dtype=np.float64) * STEP
    run = dataset(time, dict(zip(VARIABLES, own.T, strict=True)), scenario_attributes(scenario))
    far = np.abs(own - other).max(axis=0)
    return Trajectory(scenario, run, dict(zip(VARIABLES, far.tolist(), strict=True)))


def _table(fmu: Path, scenario: Scenario, use: Use, time_limit: float) -> Floats:
    steps = [(n * STEP, STEP) for n in range(round(scenario.duration / STEP))]
    inputs = {"brake_torque": scenario.brake_torque}
    with guest_file(fmu, time_limit, NO_NAMES, use) as unit:
        return unit.perform(drive, scenario.parameters, inputs, TOLERANCES[use], steps)
