"""A thousand step brakes varying C and eps by hitch.run_many, beside FMPy with one instance that is reset in between.

    python -m benchmarks.many

Both in this process in turns, 100 output points, two outputs; the results must be the same to the
bit. CPU times are medians of the rounds.
"""

from __future__ import annotations

import contextlib
import io
from time import process_time

import fmpy
import numpy as np
from fmpy.fmi2 import FMU2Slave

import overrun_hitch as hitch
from benchmarks.comparison import in_turns

C, EPS = np.linspace(100.0, 2000.0, 40), np.linspace(0.0, 0.1, 25)
OUTPUTS = ["compression", "a_car"]
ROUNDS = 5
AT_LEAST = 4.0  # times the CPU time of run_many


class Fmpy:
    """An instance, and simulate_fmu on it as FMPy's own documentation shows it for many runs."""

    def __init__(self) -> None:
        fmu = str(hitch.fmu_path())
        self.description, self.folder = fmpy.read_model_description(fmu), fmpy.extract(fmu)
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


def ours() -> np.ndarray:
    """The same by run_many."""
    many = hitch.run_many({"C": C.tolist(), "eps": EPS.tolist()}, outputs=OUTPUTS, progress=lambda *_: None)
    return np.stack([many[name].values for name in OUTPUTS], axis=2)


def main() -> None:
    """Measure and print."""
    by_fmpy = Fmpy()
    ways = (ours, by_fmpy.run_many)
    values = [way() for way in ways]  # and everything is loaded
    times = np.median(in_turns([lambda way=way: _cpu_time(way) for way in ways], ROUNDS, "many runs"), axis=0)
    by_fmpy.unit.freeInstance()
    equal = "the same to the bit" if (values[0] == values[1]).all() else "NOT THE SAME"
    print(f"{C.size * EPS.size} runs: run_many {times[0]:.2f} s, FMPy {times[1]:.2f} s of CPU time; results {equal}")
    ratio = times[1] / times[0]
    print(f"FMPy over run_many: {ratio:.1f}, at least {AT_LEAST:g}: {'met' if ratio >= AT_LEAST else 'missed'}")


def _cpu_time(way: object) -> float:
    begin = process_time()
    way()  # type: ignore[operator]
    return process_time() - begin


if __name__ == "__main__":
    main()
