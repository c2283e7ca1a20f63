"""Car.fmu and Trailer.fmu in FMPy, with a master of one's own. Both step at once, or the trailer first.

Figure 8's step brake: 1000 N.m at 40 m/s for 6 s, values exchanged every 10 ms.
"""

from __future__ import annotations

import shutil
import sys

from fmpy import extract, read_model_description
from fmpy.simulation import instantiate_fmu

STEPS, H = 600, 0.01  # s


class Unit:
    """An FMU with names instead of value references."""

    def __init__(self, fmu: str) -> None:
        description = read_model_description(fmu)
        self.folder = extract(fmu)
        self.slave = instantiate_fmu(self.folder, description, "CoSimulation")
        self.references = {variable.name: variable.valueReference for variable in description.modelVariables}

    def start(self, **values: float) -> None:
        """Set parameters and inputs, and initialize."""
        self.set(**values)
        self.slave.setupExperiment(startTime=0.0)
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()

    def set(self, **values: float) -> None:
        """Set by name."""
        self.slave.setReal([self.references[name] for name in values], list(values.values()))

    def __getitem__(self, name: str) -> float:
        return self.slave.getReal([self.references[name]])[0]

    def free(self) -> None:
        """End it, and delete what was unpacked."""
        self.slave.terminate()
        self.slave.freeInstance()
        shutil.rmtree(self.folder)


def show(scheme: str, car: Unit, trailer: Unit) -> None:
    """One line for the end of a run."""
    print(f"{scheme}: v_car = {car['v_car']:.6f} m/s, compression = {trailer['compression']:.6f} m")


def both_at_once(car: Unit, trailer: Unit) -> None:
    """Jacobi: each holds for a step what the other had at its beginning."""
    car.start(brake_torque=1000.0)
    trailer.start(v_car=car["v_car"], extrapolation=1.0, applied_force=3.0)
    for n in range(STEPS):
        speed, force = car["v_car"], trailer["F_hitch_hold"]
        trailer.set(v_car=speed)
        car.set(F_hitch=force)
        trailer.slave.doStep(n * H, H)
        car.slave.doStep(n * H, H)


def trailer_first(car: Unit, trailer: Unit) -> None:
    """Gauss-Seidel: the car makes the step with the mean force of the step that the trailer has just made."""
    car.start(brake_torque=1000.0)
    trailer.start(v_car=car["v_car"], extrapolation=1.0, applied_force=2.0)
    for n in range(STEPS):
        trailer.set(v_car=car["v_car"])
        trailer.slave.doStep(n * H, H)
        car.set(F_hitch=trailer["F_hitch_mean"])
        car.slave.doStep(n * H, H)


files = sys.argv[1:] or ["build/fmi2/Car.fmu", "build/fmi2/Trailer.fmu"]
for scheme in (both_at_once, trailer_first):
    units = Unit(files[0]), Unit(files[1])
    scheme(*units)
    show(scheme.__name__, *units)
    for unit in units:
        unit.free()
