"""What the paper left out of the overrun device: a brake that lags, a guide that rubs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from overrun_hitch.experiments.free_vibration import measured_mode
from overrun_hitch.fmu.unit import AnyUnit
from overrun_hitch.paper.study.beyond import CHECKED_RATIOS, designed
from overrun_hitch.parameters import FIGURES, Parameters
from overrun_hitch.theory.boundary import critical_damping, light_damping_estimate
from overrun_hitch.theory.dry_friction import onset_amplitude
from overrun_hitch.theory.linear import shunting_mode

Floats = NDArray[np.float64]

LAGS = np.linspace(0.0, 0.05, 11)  # s
RATIOS = np.geomspace(0.5, 10.0, 19)  # r/k in m: closer together where the contours bend
SPEEDS = (10.0, 40.0)  # m/s
CHECKED_LAGS = (0.005, 0.02, 0.05)  # s; at the lower speed with CHECKED_RATIOS, at the higher the other way round
BESIDE = 0.05  # of C_crit: how far from the boundary the FMU is asked
TYPICAL_LAG = 0.02  # s
FRICTION = 50.0  # N


@dataclass(frozen=True)
class LagCheck:
    """The FMU on both sides of the boundary."""

    tau_b: float  # s
    ratio: float  # r/k in m
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
    """C_crit in N.s/m at SPEEDS (n,), LAGS (m,) and RATIOS (l,), checks; figure 8 with TYPICAL_LAG."""

    C_crit: Floats  # (n, m, l), by the eigenvalues
    closed_form: Floats  # (n, m, l), the same for light damping
    checks: tuple[LagCheck, ...]
    growth_rate: float  # 1/s, of figure 8's combination with TYPICAL_LAG at its speed, by theory
    onset: float  # m, a* of the same with FRICTION
    borne: float  # s, the lag with which figure 8's combination neither shunts nor decays at its speed, by theory


def device(unit: AnyUnit) -> Device:
    """The chart by theory, the checks on the FMU."""
    ratios = (CHECKED_RATIOS, CHECKED_RATIOS[::-1])
    checks = tuple(
        _check(unit, lag, ratio, V)
        for V, at_V in zip(SPEEDS, ratios, strict=True)
        for lag, ratio in zip(CHECKED_LAGS, at_V, strict=True)
    )
    p = FIGURES["8"].parameters.changed({"tau_b": TYPICAL_LAG})
    onset = onset_amplitude(p.changed({"F_f": FRICTION}), p.V_0)
    growth_rate = float(shunting_mode(p, p.V_0).growth_rate)
    borne = brentq(lambda lag: critical_damping(p.changed({"tau_b": lag}), p.V_0) - p.C, 0.0, LAGS[-1], xtol=1e-6)
    charts = _chart(critical_damping), _chart(light_damping_estimate)
    return Device(*charts, checks, growth_rate, onset, float(borne))


def _chart(boundary: Callable[[Parameters, float], float]) -> Floats:
    """(n, m, l)."""
    rows = [[designed(ratio).changed({"tau_b": lag}) for ratio in RATIOS.tolist()] for lag in LAGS.tolist()]
    return np.array([[[boundary(p, V) for p in row] for row in rows] for V in SPEEDS])


def _check(unit: AnyUnit, tau_b: float, ratio: float, V: float) -> LagCheck:
    p = designed(ratio).changed({"tau_b": tau_b})
    C_crit = critical_damping(p, V)
    below, above = (
        measured_mode(unit, p.changed({"C": (1.0 + side) * C_crit}), V).growth_rate for side in (-BESIDE, BESIDE)
    )
    return LagCheck(tau_b, ratio, V, C_crit, below, above)
