"""Drives: the calls of a run, in the process where the unit is. Little is imported, because each such process does."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from overrun_hitch.parameters import Parameters

if TYPE_CHECKING:  # a host that asks for a run loads no fmpy
    from overrun_hitch.fmu.unit import HitchUnit

Floats = NDArray[np.float64]


def drive(
    unit: HitchUnit,
    parameters: Parameters,
    inputs: Mapping[str, float],
    relative_tolerance: float,
    steps: Iterable[tuple[float, float]],
    slowest: float = -np.inf,
    torques: Sequence[tuple[float, float]] | None = None,
) -> Floats:
    """The outputs (n + 1, variables) at the start and after each of the steps (time and size in s).

    `torques` are brake torques (N.m) at the start and at the end of each step; without, it stays as it is. It ends
    early before car or trailer becomes slower than `slowest` (m/s).
    """
    unit.start(parameters, inputs, relative_tolerance)
    rows = [unit.outputs()]
    for number, (time, size) in enumerate(steps):
        if _becomes_slower(rows[-1], size, slowest):
            break
        if torques:
            unit.feed("brake_torque", *torques[number], size)
        unit.step(time, size)
        rows.append(unit.outputs())
    return np.array(rows)


def _becomes_slower(row: list[float], h: float, slowest: float) -> bool:
    v_car, v_trailer, a_car, a_trailer = row[:4]
    # Twice the step: an acceleration that grows within it must not carry the run past rest.
    return min(v_car + 2.0 * h * min(a_car, 0.0), v_trailer + 2.0 * h * min(a_trailer, 0.0)) < slowest
