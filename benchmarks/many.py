"""A thousand step brakes varying C and eps by hitch.run_many, beside FMPy with one instance that is reset in between.

    python -m benchmarks.many

In this process in turns, 100 output points, two outputs; the results must be the same to the bit. The same runs by the
compiled loop (fmu/sampler.c) and nothing else tell what the unit takes by itself, below which no way gets.
"""

from __future__ import annotations

import contextlib
import io
import os
import sys
import tempfile
from collections.abc import Callable
from time import process_time
from typing import Any

import fmpy
import numpy as np
from fmpy.fmi2 import FMU2Slave

import overrun_hitch as hitch
from benchmarks.comparison import in_turns
from overrun_hitch.fmu.sampler import Sampler, compiled_loop

C, EPS = np.linspace(100.0, 2000.0, 40), np.linspace(0.0, 0.1, 25)
OUTPUTS = ["compression", "a_car"]
TIMES = np.append(0.06 * np.arange(100), 6.0)
ROUNDS = 11
WANTED = 4.0  # times the CPU time of run_many


class Fmpy:
    """An instance, and simulate_fmu on it as FMPy's own documentation shows it for many runs."""

    def __init__(self, folder: str) -> None:
        fmu = str(hitch.fmu_path())
        self.description, self.folder = fmpy.read_model_description(fmu), fmpy.extract(fmu, folder)
        name = self.description.coSimulation.modelIdentifier
        self.unit = FMU2Slave(
            guid=self.description.guid, unzipDirectory=self.folder, modelIdentifier=name, instanceName="unit"
        )
        self.unit.instantiate()

    def run_many(self) -> np.ndarray:
        """Values (C, eps, outputs, points)."""
        with contextlib.redirect_stdout(io.StringIO()):  # it tells each time that `grade` has no input signal
            return np.array([[self.run(damper, clearance) for clearance in EPS] for damper in C])

    def run(self, damper: float, clearance: float) -> list[list[float]]:
        """One of them."""
        self.unit.reset()
        result = fmpy.simulate_fmu(
            self.folder, validate=False, stop_time=6, output_interval=0.06, relative_tolerance=1e-6,
            start_values={"C": damper, "eps": clearance, "brake_torque": 1000.0}, output=OUTPUTS,
            model_description=self.description, fmu_instance=self.unit, record_events=False,
        )  # fmt: skip
        return [result[name].tolist() for name in OUTPUTS]


class Alone:
    """The same instance, its runs through the compiled loop."""

    def __init__(self, by_fmpy: Fmpy) -> None:
        references = {variable.name: variable.valueReference for variable in by_fmpy.description.modelVariables}
        self._unit = by_fmpy.unit
        self._varied = [references[name] for name in ("C", "eps", "brake_torque")]
        self._sampler = Sampler(self._unit, [references[name] for name in OUTPUTS], TIMES, str)

    def run_many(self) -> np.ndarray:
        """Values (C, eps, outputs, points)."""
        return np.array([[self.run(damper, clearance) for clearance in EPS] for damper in C])

    def run(self, damper: float, clearance: float) -> np.ndarray:
        """One of them."""
        self._unit.reset()
        self._unit.setReal(self._varied, [damper, clearance, 1000.0])
        self._unit.setupExperiment(tolerance=1e-6, startTime=0.0, stopTime=6.0)
        self._unit.enterInitializationMode()
        self._unit.exitInitializationMode()
        return self._sampler.run().T.copy()


def ours() -> np.ndarray:
    """The same by run_many."""
    many = hitch.run_many({"C": C.tolist(), "eps": EPS.tolist()}, outputs=OUTPUTS, progress=lambda *_: None)
    return np.stack([many[name].values for name in OUTPUTS], axis=2)


def section() -> str:
    """For results.md. RuntimeError where the ways do not give the same bits."""
    if compiled_loop() is None:
        raise RuntimeError("the loop of fmu/sampler.c is not compiled: a C compiler is needed")
    with tempfile.TemporaryDirectory(prefix="benchmark-") as name:
        by_fmpy = Fmpy(name)
        ways: dict[str, Callable[[], Any]] = {
            "`hitch.run_many`": ours, "FMPy, one instance": by_fmpy.run_many,
            "the unit alone, from C": Alone(by_fmpy).run_many,
        }  # fmt: skip
        first, *others = [way() for way in ways.values()]  # and everything is loaded
        if not all((values == first).all() for values in others):
            raise RuntimeError("run_many, FMPy and C do not give the same bits")
        each = in_turns([lambda way=way: _cpu_time(way) for way in ways.values()], ROUNDS, "many runs")
        by_fmpy.unit.freeInstance()
    times = np.median(each, axis=0) / (C.size * EPS.size)
    over = np.median(each / each[:, :1], axis=0)
    rows = [
        f"| {name} | {1e3 * time:.3f} ms | {ratio:.2f} |" for name, time, ratio in zip(ways, times, over, strict=True)
    ]
    return f"""## Many runs

{C.size * EPS.size} step brakes of 6 s varying C and eps, 100 output points, two outputs: the same bits. CPU time of
whole calls, user and system (none has other processes), medians of {ROUNDS} rounds in which each had its turn; the load
average was {os.getloadavg()[0]:.1f} at the end. `python -m benchmarks.many` prints this section.

| | CPU time a run | over run_many |
|---|---|---|
{chr(10).join(rows)}

FMPy over `run_many`: {over[1]:.1f}; wanted: {WANTED:g}. No way can reach more than FMPy over the unit alone:
{over[1] / over[2]:.1f}.
"""


def _cpu_time(way: Callable[[], Any]) -> float:
    begin = process_time()
    way()
    return process_time() - begin


if __name__ == "__main__":
    sys.stdout.write(section())
