"""The FMU: co-simulation from C and from fmpy, model exchange with fmpy's CVode.

Both of fmpy's go through its simulate_fmu, on an instance made before: what that costs is on both sides.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from ctypes import byref, c_long, c_void_p
from pathlib import Path
from time import process_time
from typing import Any
from unittest.mock import patch

import fmpy
from fmpy.fmi2 import FMU2Model
from fmpy.sundials import CVodeSolver
from fmpy.sundials.libraries import sundials_cvode

from benchmarks import six_seconds
from benchmarks.contender import DURATION, SCENARIO, STEP, Contender, Floats, Run
from tests.unit import Unit

RUNS = 21  # of the C program each time; it tells their median


class Model(Unit):
    """An instance for model exchange."""

    slave_class = FMU2Model


@contextmanager
def contenders(fmu: Path, folder: Path) -> Iterator[list[Contender]]:
    """From C, from fmpy, and model exchange, while the FMU is unpacked in the folder and instantiated."""
    command = six_seconds.compiled(fmu, folder)
    slave, model = Unit(fmu, folder / "slave"), Model(fmu, folder / "model")

    def from_c(tolerance: float, _: bool) -> Run:
        values = six_seconds.printed(command, tolerance, RUNS)
        evaluations = next(int(name.partition(":")[2]) for name in values if name.startswith("right-hand side:"))
        return Run(values["total"][0], values["compression"], evaluations, int(values["steps"][0]))

    def co_simulation(tolerance: float, count: bool) -> Run:
        cpu_time, compression = _simulated(slave, tolerance)
        if not count:
            return Run(cpu_time, compression)
        same = from_c(tolerance, count)  # steps of the same sizes but for rounding, as a test holds
        return Run(cpu_time, compression, same.evaluations, same.steps)

    def model_exchange(tolerance: float, count: bool) -> Run:
        if not count:
            return Run(*_simulated(model, tolerance))
        with _counting() as counts:
            return Run(*_simulated(model, tolerance), **counts)

    try:
        slave.slave.instantiate()
        model.slave.instantiate()
        yield [
            Contender("FMU from C", from_c),
            Contender("FMU from fmpy", co_simulation),
            Contender("FMU, fmpy's CVode", model_exchange),
        ]
    finally:
        for unit in (slave, model):
            if unit.slave.component is not None:
                unit.slave.freeInstance()


def _simulated(unit: Unit, tolerance: float) -> tuple[float, Floats]:
    begin = process_time()
    unit.slave.reset()
    result = fmpy.simulate_fmu(
        unit.slave.unzipDirectory,
        validate=False,
        stop_time=DURATION,
        output_interval=STEP,
        relative_tolerance=tolerance,
        start_values={"brake_torque": SCENARIO.brake_torque},
        output=["compression"],
        record_events=False,
        model_description=unit.description,
        fmu_instance=unit.slave,
    )
    return process_time() - begin, result["compression"]


@contextmanager
def _counting() -> Iterator[dict[str, int]]:
    """What CVode takes meanwhile: its own counter of steps starts anew at each event, and fmpy shows none."""
    counts = {"evaluations": 0, "steps": 0}

    class Counting(CVodeSolver):
        def f(self, *arguments: Any) -> int:
            counts["evaluations"] += 1
            return super().f(*arguments)

        def step(self, *arguments: Any) -> Any:
            before = self.steps()
            found = super().step(*arguments)
            counts["steps"] += self.steps() - before
            return found

        def steps(self) -> int:
            number = c_long()
            sundials_cvode.CVodeGetNumSteps(c_void_p(self.cvode_mem), byref(number))
            return number.value

    with patch("fmpy.sundials.CVodeSolver", Counting):
        yield counts
