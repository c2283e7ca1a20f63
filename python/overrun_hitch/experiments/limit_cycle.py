"""Sustained oscillations of the FMU at held speed: downhill, where the driver's brake keeps the speed.

Linear theory says which damper lets small oscillations grow; what they grow to, only the nonlinear model tells.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from overrun_hitch.fmu.unit import AnyUnit, HitchUnit
from overrun_hitch.measure.oscillation import NoOscillation, measure
from overrun_hitch.parameters import Parameters
from overrun_hitch.results import VARIABLES
from overrun_hitch.theory.working_point import g_n

Floats = NDArray[np.float64]

STEP = 0.01  # s
RELATIVE_TOLERANCE = 1e-8
SPEED_TIME = 20.0  # s: the driver corrects a speed error so slowly that the oscillation does not feel it
SETTLING = 180.0  # s
OBSERVED = 20.0  # s
FADED = 0.05  # of the steady compression: smaller is still on its way to rest
STEADY_GROWTH = 0.003  # 1/s: faster, and the amplitude changes by more than 6 % while it is observed
SPEED_ALLOWED = 1.0  # m/s, from the speed to be held


@dataclass(frozen=True)
class Sustained:
    """What a motion has come to after `SETTLING` seconds."""

    verdict: str  # "sustained", "unsettled" (still growing or decaying), "fades" or "runs away"
    amplitude: float  # m, of the fundamental of the compression; NaN where it fades or runs away
    frequency: float  # Hz
    growth_rate: float  # 1/s, what is left of growth or decay
    lowest: float  # m, the smallest compression of a cycle


NOTHING = (math.nan, math.nan, math.nan, math.nan)


def weight_push(parameters: Parameters, grade: float) -> float:
    """The trailer's weight along a road of this grade (negative: downhill), in N, positive forward."""
    return -parameters.M_t * g_n * grade / math.hypot(1.0, grade)


def sustained_motion(unit: AnyUnit, parameters: Parameters, V: float, grade: float, amplitude: float) -> Sustained:
    """What becomes of an oscillation of `amplitude` (m) at V (m/s), downhill (grade < 0)."""
    p = parameters
    beyond = weight_push(p, grade) / (p.k + p.r / p.R_t)
    start = p.changed({"V_0": V, "compression_start": p.eps + beyond + amplitude})
    descent = unit.perform(_descend, start, V, grade, beyond)
    if descent is None:
        return Sustained("runs away", *NOTHING)
    speed, compression = descent
    last = slice(-round(OBSERVED / STEP), None)
    time: Floats = np.arange(round(OBSERVED / STEP), dtype=np.float64) * STEP
    if np.ptp(compression[last]) < 2.0 * FADED * beyond:
        return Sustained("fades", *NOTHING)
    found = measure(time, compression[last])
    if isinstance(found, NoOscillation) or abs(float(speed[last].mean()) - V) > SPEED_ALLOWED:
        return Sustained("runs away", *NOTHING)
    return Sustained(
        verdict="sustained" if abs(found.growth_rate) < STEADY_GROWTH else "unsettled",
        amplitude=abs(found.amplitude_of(time, compression[last])),
        frequency=found.frequency,
        growth_rate=found.growth_rate,
        lowest=float(compression[last].min()),
    )


def _descend(unit: HitchUnit, start: Parameters, V: float, grade: float, beyond: float) -> tuple[Floats, Floats] | None:
    """Speed (n,) in m/s and compression (n,) in m of a descent with the driver's brake as a slow PI control.

    None where the speed could not be held.
    """
    p = start
    mass = p.M_c + p.M_t
    steady = p.R_c * (weight_push(p, grade) * mass / p.M_t - p.r * beyond / p.R_t)
    unit.start(p, {"brake_torque": steady, "grade": grade}, RELATIVE_TOLERANCE)
    v_car, compression = (list(VARIABLES).index(name) for name in ("v_car", "compression"))
    rows, integral = [], 0.0
    for n in range(round((SETTLING + OBSERVED) / STEP)):
        outputs = unit.outputs()
        rows.append((outputs[v_car], outputs[compression]))
        error = outputs[v_car] - V
        if abs(error) > 0.5 * V:
            return None
        integral += error * STEP
        correction = p.R_c * mass * (error + integral / SPEED_TIME) / SPEED_TIME
        unit.set({"brake_torque": max(0.0, steady + correction)})
        unit.step(n * STEP, STEP)
    table = np.array(rows)
    return table[:, 0], table[:, 1]
