"""Bench.fmu moved as a trace was."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from overrun_hitch.fitting.motion import Motion
from overrun_hitch.fitting.trace import Floats
from overrun_hitch.fmu.opening import opened
from overrun_hitch.fmu.unit import Unit
from overrun_hitch.parameters import Parameters

OUTPUTS = ("F_hitch", "trailer_brake_torque")
TOLERANCE = 1e-8  # relative, of the integrator: derivatives are taken from differences of 1e-4


class Bench:
    """The unit, to be moved again and again with other parameters. From `opened_bench`."""

    def __init__(self, unit: Unit, moved: Motion, names: frozenset[str]) -> None:
        self._unit = unit
        self._names = names
        # The rate runs straight from sample to sample but for so small a jump that the compression is hit at each.
        h, change = np.diff(moved.time), np.diff(moved.v_rel)
        first = np.diff(moved.compression) / h - change / 2.0
        self._start = {"v_rel": float(first[0]), "compression_start": float(moved.compression[0])}
        self._sampler = unit.sampler(OUTPUTS, moved.time, ("v_rel", first, change / h))

    def run(self, parameters: Mapping[str, float], shift: float = 0.0) -> Floats:
        """Hitch force (N) and brake torque (N.m), (2, n), at the times of the motion, `shift` m further in."""
        start = self._start["compression_start"] + shift
        own = {name: value for name, value in parameters.items() if name in self._names}
        self._unit.start_with({**own, **self._start, "compression_start": start}, TOLERANCE)
        outputs: Floats = self._sampler.run().T.copy()
        return outputs


@contextmanager
def opened_bench(fmu: Path, moved: Motion) -> Iterator[Bench]:
    """Bench.fmu, to be moved like this. HitchError for another FMU, and for what it refuses."""
    with opened(fmu, [*OUTPUTS, "v_rel", "compression_start"], "a bench") as unit:
        yield Bench(unit, moved, unit.names & set(Parameters.model_fields))
