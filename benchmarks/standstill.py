"""CPU time of stops from 30 m/s, with 10 s beyond, against the same brake for as long at speed.

`python -m benchmarks.standstill FMU` prints a table: one core, the C function called from here, communication steps of
10 ms, which end most steps, and of 100 ms, where the error control chooses. The run at speed has the same brake torque
and starts so fast that it is at about 30 m/s when the other has stood for 10 s. Both have their turns, and of their
times the ratio alone is judged.
"""

from __future__ import annotations

import sys
import tempfile
import time
from pathlib import Path
from statistics import median

from overrun_hitch.experiments.limit_cycle import g_n
from overrun_hitch.parameters import DATUM, Parameters
from overrun_hitch.theory.steady import steady
from tests.unit import Unit

RUNS = 31
STEPS = (0.01, 0.1)  # s
BEYOND = 10.0  # s
V_0 = 30.0  # m/s
LIMIT = 5.0
STOPS = {  # torque on the car's wheels (N.m), grade, changed parameters
    "C = 500 N.s/m": (2000.0, 0.0, {"mu": 1.0}),
    "uphill, C = 0": (2000.0, 0.1, {"mu": 1.0, "C": 0.0}),
    "downhill, clearance 0.1 m, C = 100 N.s/m": (2000.0, -0.1, {"mu": 1.0, "C": 100.0, "eps": 0.1}),
    "mu = 0.3, all wheels locked": (1600.0, 0.0, {"mu": 0.3}),
    "mu = 0.3, clearance 0.1 m, C = 0": (1600.0, 0.0, {"mu": 0.3, "C": 0.0, "eps": 0.1}),
}


def start(unit: Unit, parameters: Parameters, torque: float, grade: float) -> None:
    """To the start of a run, from any state."""
    unit.slave.reset()
    unit.start(brake_torque=torque, grade=grade, **parameters.model_dump())


def duration_of_stop(unit: Unit, parameters: Parameters, torque: float, grade: float) -> float:
    """Seconds until both speeds are below 0.1 m/s for good, and BEYOND."""
    start(unit, parameters, torque, grade)
    n, last = 0, 0
    while (n - last) * STEPS[-1] < BEYOND:
        unit.slave.doStep(n * STEPS[-1], STEPS[-1])
        n += 1
        if abs(unit.get("v_car", "v_trailer")).max() >= 0.1:
            last = n
    return n * STEPS[-1]


def cpu_time(unit: Unit, parameters: Parameters, torque: float, grade: float, points: list[float]) -> float:
    """Seconds for a run."""
    do_step, component, step = unit.slave.dll.fmi2DoStep, unit.slave.component, points[1]
    start(unit, parameters, torque, grade)
    begin = time.process_time()
    for point in points:
        do_step(component, point, step, 1)
    return time.process_time() - begin


def main() -> int:
    """Print the table; 1 where a stop takes longer than LIMIT times the run at speed."""
    worst = 0.0
    with tempfile.TemporaryDirectory(prefix="benchmark-") as folder:
        unit = Unit(Path(sys.argv[1]), Path(folder))
        unit.slave.instantiate()
        print("| stop from 30 m/s | duration | step | CPU time | at speed | ratio |\n|---|---|---|---|---|---|")
        for name, (torque, grade, changes) in STOPS.items():
            stop = DATUM.changed({"V_0": V_0, **changes})
            duration = duration_of_stop(unit, stop, torque, grade)
            deceleration = abs(steady(stop, torque).A) + g_n * grade
            fast = stop.changed({"V_0": V_0 + deceleration * duration, "mu": DATUM.mu})
            for step in STEPS:
                points = [n * step for n in range(round(duration / step))]
                rounds = [[cpu_time(unit, p, torque, grade, points) for p in (stop, fast)] for _ in range(RUNS)]
                ours, theirs = map(median, zip(*rounds, strict=True))
                worst = max(worst, ours / theirs)
                print(
                    f"| {name} | {duration:.1f} s | {1e3 * step:.0f} ms | {1e3 * ours:.2f} ms | {1e3 * theirs:.2f} ms "
                    f"| {ours / theirs:.2f} |"
                )
        unit.slave.freeInstance()
    print(f"At most {LIMIT:g} times: {'met' if worst <= LIMIT else 'NOT MET'}")
    return 0 if worst <= LIMIT else 1


if __name__ == "__main__":
    sys.exit(main())
