"""Hitch.fmu in Exudyn: car and trailer are masses, their wheels rotors, with tyres between. Figure 8's step brake.

Largest compression and frequency are within 0.5 % and 0.1 % of CarTrailer.fmu's at steps of 1 and 5 ms, or the exit
status is 1.
"""

from __future__ import annotations

import sys
import tempfile

import exudyn as exu
import numpy as np
from exudyn.itemInterface import (
    CoordinateSpringDamperExt,
    LoadCoordinate,
    MarkerNodeCoordinate,
    Mass1D,
    Node1D,
    Rotor1D,
)
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi2 import FMU2Slave

from overrun_hitch.measure.oscillation import measure

BRAKE_TORQUE, DURATION, V_0, R = 1000.0, 6.0, 40.0, 0.35  # N.m, s, m/s, m
STEPS = (0.001, 0.005)  # s
CAR, TRAILER = (1000.0, 5.0, 400e3), (500.0, 2.5, 200e3)  # kg, kg.m2 of the wheels, N per unit slip
PEAK, FREQUENCY = 0.005, 0.001  # farthest from CarTrailer.fmu, relative


class Vehicle:
    """A mass on a lumped wheel, and what acts on both."""

    def __init__(self, system: exu.MainSystem, mass: float, inertia: float, C_k: float) -> None:
        self.system, self.C_k = system, C_k
        self.effective_mass = mass + inertia / R**2
        self.body, body = self.coordinate(Mass1D, V_0, mass=mass)
        _, wheel = self.coordinate(Rotor1D, V_0 / R, inertia=inertia)
        self.force, self.torque = (system.AddLoad(LoadCoordinate(markerNumber=end, load=0.0)) for end in (body, wheel))
        self.tyre = system.AddObject(CoordinateSpringDamperExt(markerNumbers=[wheel, body], factor0=R))

    def coordinate(self, kind: type, speed: float, **inertia: float) -> tuple[int, int]:
        """Node and marker of a coordinate that has inertia."""
        node = self.system.AddNode(
            Node1D(referenceCoordinates=[0.0], initialCoordinates=[0.0], initialVelocities=[speed])
        )
        self.system.AddObject(kind(nodeNumber=node, **inertia))
        return node, self.system.AddMarker(MarkerNodeCoordinate(nodeNumber=node, coordinate=0))

    @property
    def x(self) -> float:
        """Way in m."""
        return float(self.system.GetNodeOutput(self.body, exu.OutputVariableType.Coordinates))

    @property
    def v(self) -> float:
        """Speed in m/s."""
        return float(self.system.GetNodeOutput(self.body, exu.OutputVariableType.Coordinates_t))

    def hold(self, force: float, brake_torque: float) -> None:
        """What acts during the next step; the tyre's force follows the slip: its damping is over the speed."""
        self.system.SetLoadParameter(self.force, "load", force)
        self.system.SetLoadParameter(self.torque, "load", -brake_torque)
        self.system.SetObjectParameter(self.tyre, "damping", self.C_k / self.v)


class Hitch:
    """The unit, with names instead of value references."""

    def __init__(self, fmu: str, **start: float) -> None:
        description = read_model_description(fmu)
        identifier = description.coSimulation.modelIdentifier
        self.references = {variable.name: variable.valueReference for variable in description.modelVariables}
        self.folder = tempfile.TemporaryDirectory()
        extract(fmu, self.folder.name)
        self.slave = FMU2Slave(guid=description.guid, unzipDirectory=self.folder.name, modelIdentifier=identifier)
        self.slave.instantiate()
        self.set(**start)
        self.slave.setupExperiment(startTime=0.0)
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()

    def set(self, **values: float) -> None:
        """Set by name."""
        self.slave.setReal([self.references[name] for name in values], list(values.values()))

    def get(self, *names: str) -> list[float]:
        """Get by name."""
        return list(self.slave.getReal([self.references[name] for name in names]))

    def free(self) -> None:
        """End it, and delete what was unpacked."""
        self.slave.terminate()
        self.slave.freeInstance()
        self.folder.cleanup()


def brake(fmu: str, step: float) -> np.ndarray:
    """Compression (n,) at the beginning of each step in Exudyn."""
    container = exu.SystemContainer()
    system = container.AddSystem()
    car, trailer = Vehicle(system, *CAR), Vehicle(system, *TRAILER)
    system.Assemble()
    hitch = Hitch(fmu, v_car=V_0, v_trailer=V_0, M_front=car.effective_mass, M_rear=trailer.effective_mass)
    compression = []

    def before_step(_: exu.MainSystem, end: float) -> bool:
        compression.append(trailer.x - car.x)
        force, torque = hitch.get("F_hitch_hold", "trailer_brake_torque_hold")
        hitch.set(v_car=car.v, v_trailer=trailer.v)
        hitch.slave.doStep(end - step, step)
        car.hold(force, BRAKE_TORQUE)
        trailer.hold(-force, torque)
        return True

    system.SetPreStepUserFunction(before_step)
    settings = exu.SimulationSettings()
    settings.timeIntegration.numberOfSteps = round(DURATION / step)
    settings.timeIntegration.endTime = DURATION
    settings.timeIntegration.verboseMode = 0
    settings.solution.file.write = False
    # Explicit: what is held over a step acts in that step. Implicit methods mix in the last one's, half a step late.
    system.SolveDynamic(settings, solverType=exu.DynamicSolverType.RK44)
    hitch.free()
    return np.array(compression)


def show(title: str, time: np.ndarray, compression: np.ndarray) -> tuple[float, float]:
    """A line for a run: largest compression (m) and frequency (Hz), which it returns, and growth rate."""
    found, peak = measure(time, compression), compression.max()
    print(f"{title}: {peak:.5f} m, {found.frequency:.4f} Hz, {found.growth_rate:.4f} 1/s")
    return peak, found.frequency


hitch, whole = sys.argv[1:] or ["build/fmi2/Hitch.fmu", "build/fmi2/CarTrailer.fmu"]
start = {"brake_torque": BRAKE_TORQUE}
reference = simulate_fmu(whole, stop_time=DURATION, output_interval=0.001, start_values=start, output=["compression"])
expected = show("CarTrailer.fmu", reference["time"], reference["compression"])
apart = np.zeros(2)
for step in STEPS:
    compression = brake(hitch, step)
    found = show(f"Exudyn at {1000.0 * step:g} ms", step * np.arange(len(compression)), compression)
    apart = np.maximum(apart, np.abs(np.divide(found, expected) - 1.0))
print(f"apart: {apart[0]:.2%} in compression, {apart[1]:.2%} in frequency")
sys.exit(int(apart[0] > PEAK or apart[1] > FREQUENCY))
