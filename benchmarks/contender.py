"""What a contender is: a way to compute figure 8's six seconds, with the compression at 600 points, 10 ms apart."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from overrun_hitch.parameters import FIGURES
from tests.oracles import radau

Floats = NDArray[np.float64]

SCENARIO = FIGURES["8"]
DURATION = 6.0  # s
STEP = 0.01  # s
TIME = np.arange(601) / 100.0  # s


@dataclass(frozen=True)
class Run:
    """CPU time in s, compression in m at TIME; None is what was not counted or what a contender does not tell."""

    cpu_time: float
    compression: Floats
    evaluations: int | None = None
    steps: int | None = None

    @property
    def error(self) -> float:
        """The largest distance of the compression from the oracle's, in m."""
        return float(np.abs(self.compression - _oracle()).max())


@dataclass(frozen=True)
class Contender:
    """`solve` makes a run at a relative tolerance; if told to count, with counts, and its CPU time means nothing."""

    name: str
    solve: Callable[[float, bool], Run]


def _oracle() -> Floats:
    return radau.trajectory(SCENARIO.parameters, SCENARIO.brake_torque).compression[::10]


def oracle_accuracy() -> float:
    """How far a method of another family, at a tighter tolerance, is from the oracle, in m."""
    other = radau.solve(SCENARIO.parameters, SCENARIO.brake_torque, TIME, method="DOP853", rtol=1e-13)
    return float(np.abs(other.compression - _oracle()).max())
