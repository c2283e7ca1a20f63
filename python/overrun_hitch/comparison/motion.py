"""Speeds and accelerations that a run has not, from what it has."""

from __future__ import annotations

import numpy as np
import xarray as xr

from overrun_hitch.results import missing, values


def with_motion(run: xr.Dataset, other: xr.Dataset) -> xr.Dataset:
    """`run` with what it has not: the car's speed from the `other`, the trailer's by the rate of compression.

    And the car's acceleration by the rate of its speed.
    """
    absent, time = missing(run), values(run, "time")
    if "v_car" in absent:
        run = run.assign(v_car=other["v_car"])
    if "v_trailer" in absent:
        speed = values(run, "v_car") + np.gradient(values(run, "compression"), time)
        run = run.assign(v_trailer=("time", speed, run["v_trailer"].attrs))
    if "a_car" in absent:
        run = run.assign(a_car=("time", np.gradient(values(run, "v_car"), time), run["a_car"].attrs))
    return run
