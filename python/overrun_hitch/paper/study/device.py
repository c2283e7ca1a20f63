"""What the paper left out of the overrun device: a brake that lags, a guide that rubs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from overrun_hitch.experiments.free_vibration import measured_mode
from overrun_hitch.fmu.unit import AnyUnit
from overrun_hitch.parameters import CASES, FIGURES
from overrun_hitch.theory.boundary import critical_damping
from overrun_hitch.theory.dry_friction import onset_amplitude
from overrun_hitch.theory.linear import shunting_mode

Floats = NDArray[np.float64]

LAGS = np.linspace(0.0, 0.05, 26)  # s
SPEEDS = (5.0, 10.0, 20.0, 40.0)  # m/s
CHECKED_LAGS = (0.005, 0.02, 0.05)  # s
CHECKED_SPEEDS = (10.0, 40.0)  # m/s
BESIDE = 0.05  # of C_crit: how far from the boundary the FMU is asked
TYPICAL_LAG = 0.02  # s
FRICTION = 50.0  # N


@dataclass(frozen=True)
class LagCheck:
    """The FMU on both sides of the boundary."""

    tau_b: float  # s
    V: float  # m/s
    C_crit: float  # N.s/m
    growth_below: float  # 1/s, at (1 - BESIDE) C_crit
    growth_above: float  # 1/s, at (1 + BESIDE) C_crit

    @property
    def holds(self) -> bool:
        """Growing with less damping than C_crit, decaying with more."""
        return self.growth_below > 0.0 > self.growth_above


@dataclass(frozen=True)
class Device:
    """Case ii: C_crit (n, m) in N.s/m at SPEEDS (n,) and LAGS (m,) by theory, checks; figure 8 with TYPICAL_LAG."""

    C_crit: Floats
    checks: tuple[LagCheck, ...]
    growth_rate: float  # 1/s, of figure 8's combination with TYPICAL_LAG at its speed, by theory
    onset: float  # m, a* of the same with FRICTION


def device(unit: AnyUnit) -> Device:
    """The chart by theory, the checks on the FMU."""
    case = CASES["ii"]
    chart = np.array([[critical_damping(case.changed({"tau_b": lag}), V) for lag in LAGS.tolist()] for V in SPEEDS])
    checks = tuple(_check(unit, lag, V) for lag in CHECKED_LAGS for V in CHECKED_SPEEDS)
    p = FIGURES["8"].parameters.changed({"tau_b": TYPICAL_LAG})
    onset = onset_amplitude(p.changed({"F_f": FRICTION}), p.V_0)
    return Device(chart, checks, float(shunting_mode(p, p.V_0).growth_rate), onset)


def _check(unit: AnyUnit, tau_b: float, V: float) -> LagCheck:
    p = CASES["ii"].changed({"tau_b": tau_b})
    C_crit = critical_damping(p, V)
    below, above = (
        measured_mode(unit, p.changed({"C": (1.0 + side) * C_crit}), V).growth_rate for side in (-BESIDE, BESIDE)
    )
    return LagCheck(tau_b, V, C_crit, below, above)
