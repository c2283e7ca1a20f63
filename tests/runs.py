"""Runs of our own FMU in this process: the same as step_brake's (test_guest.py) without a guest's third of a second."""

from __future__ import annotations

from pathlib import Path

import xarray as xr

from overrun_hitch.experiments.step_brake import brake
from overrun_hitch.fmu.opening import opened_unit
from overrun_hitch.fmu.settings import Settings
from overrun_hitch.parameters import Scenario


def step_brake(scenario: Scenario, *, fmu: Path, **settings: float) -> xr.Dataset:
    """`brake` on a new instance."""
    with opened_unit(fmu) as unit:
        return brake(unit, scenario, Settings(**settings)).dataset()
