"""Stops of the FMU from speed to rest, and how its shunting grows and fades on the way."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from overrun_hitch.experiments.drive import drive
from overrun_hitch.experiments.free_vibration import WHEELS_SETTLED
from overrun_hitch.fmu.unit import AnyUnit
from overrun_hitch.measure.envelope import measured_envelope
from overrun_hitch.parameters import Scenario
from overrun_hitch.results import VARIABLES

Floats = NDArray[np.float64]

STEP = 0.01  # s
RELATIVE_TOLERANCE = 1e-9
SLOWEST = 0.5  # m/s: below, the tyres' law is another (Components.Tyre, v_low)


@dataclass(frozen=True)
class Stop:
    """What the FMU did in a stop, every `STEP` seconds."""

    scenario: Scenario
    time: Floats  # (n,) s
    v_car: Floats  # (n,) m/s
    compression: Floats  # (n,) m

    @property
    def faster(self) -> slice:
        """Samples after the wheels have settled in which the car is faster than `SLOWEST`."""
        return self._until(self.v_car < SLOWEST)

    @property
    def in_theory(self) -> slice:
        """Those of them before the drawbar first leaves compression: linear theory applies."""
        return self._until((self.v_car < SLOWEST) | (self.compression <= self.scenario.parameters.eps))

    def envelope(self, part: slice) -> tuple[Floats, Floats]:
        """Times (m,) in s and amplitudes (m,) in m of the compression in this part."""
        return measured_envelope(self.time[part], self.compression[part])

    def _until(self, over: NDArray[np.bool_]) -> slice:
        return slice(round(WHEELS_SETTLED / STEP), int(over.argmax()) if over.any() else None)


def stop(unit: AnyUnit, scenario: Scenario) -> Stop:
    """Brake for the scenario's duration, beyond rest if it is long enough."""
    wanted = [list(VARIABLES).index(name) for name in ("v_car", "compression")]
    steps = [(n * STEP, STEP) for n in range(round(scenario.duration / STEP))]
    inputs = {"brake_torque": scenario.brake_torque}
    rows = unit.perform(drive, scenario.parameters, inputs, RELATIVE_TOLERANCE, steps)
    v_car, compression = rows[:, wanted].T
    time: Floats = np.arange(len(rows), dtype=np.float64) * STEP
    return Stop(scenario, time, v_car, compression)
