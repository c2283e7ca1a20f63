"""Speeds and accelerations that a run has not, from what it has."""

from __future__ import annotations

import numpy as np

from overrun_hitch.results import AnyRun, missing, values, with_samples


def with_motion(run: AnyRun, other: AnyRun) -> AnyRun:
    """`run` with what it has not: the car's speed from the `other`, the trailer's by the rate of compression.

    And the car's acceleration by the rate of its speed.
    """
    absent, time = missing(run), values(run, "time")
    if "v_car" in absent:
        run = with_samples(run, {"v_car": values(other, "v_car")})
    if "v_trailer" in absent:
        speed = values(run, "v_car") + np.gradient(values(run, "compression"), time)
        run = with_samples(run, {"v_trailer": speed})
    if "a_car" in absent:
        run = with_samples(run, {"a_car": np.gradient(values(run, "v_car"), time)})
    return run
