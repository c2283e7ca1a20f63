"""Many runs through the same communication points, with as little as possible between the calls."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    fmi2Warning,
)
from numpy.typing import NDArray

from overrun_hitch.fmu.messages import StepRefused

Floats = NDArray[np.float64]


class Sampler:
    """Steps a started unit through communication points and reads the same variables at each, run after run.

    The same calls as Unit.step and Unit.get, with arguments made once: 100 points cost 0.1 ms beside the unit's own
    work instead of 1.5 ms through fmpy's wrappers.
    """

    def __init__(
        self, slave: Any, references: Sequence[int], points: Floats, refusal: Callable[[Exception], str]
    ) -> None:
        count = len(references)
        self._slave = slave
        self._refusal = refusal
        self._references = (ctypes.c_uint * count)(*references)
        self._table: Floats = np.empty((len(points), count))
        self._rows = [(ctypes.c_double * count).from_buffer(row) for row in self._table]
        self._times = points.tolist()

    def run(self, before_step: Mapping[int, Callable[[], None]] | None = None) -> Floats:
        """Values (points, names) in SI units, in a table that the next run overwrites.

        `before_step` is called before the steps with these numbers, to change inputs. StepRefused as for Unit.step.
        """
        do_step, get_real = self._slave.dll.fmi2DoStep, self._slave.dll.fmi2GetReal
        component, references, count = self._slave.component, self._references, len(self._references)
        self._check("fmi2GetReal", get_real(component, references, count, self._rows[0]))
        for step, (now, then, row) in enumerate(zip(self._times, self._times[1:], self._rows[1:], strict=False)):
            if before_step and step in before_step:
                before_step[step]()
            self._check("fmi2DoStep", do_step(component, now, then - now, 1))
            self._check("fmi2GetReal", get_real(component, references, count, row))
        return self._table

    def _check(self, function: str, status: int) -> None:
        if status > fmi2Warning:
            raise StepRefused(self._refusal(FMICallException(function, status)))
