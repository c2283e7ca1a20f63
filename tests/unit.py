"""One FMI 2 Co-Simulation instance of an FMU, driven call by call, as an importer's own code would."""

from __future__ import annotations

from pathlib import Path

import fmpy
import numpy as np
from fmpy.fmi2 import FMU2Slave


class Unit:
    """``slave`` is fmpy's thin wrapper of the C functions; here are names instead of value references."""

    slave_class = FMU2Slave

    def __init__(self, fmu: Path, folder: Path) -> None:
        self.description = fmpy.read_model_description(str(fmu))
        self.references = {v.name: v.valueReference for v in self.description.modelVariables}
        fmpy.extract(str(fmu), unzipdir=str(folder))
        identifier = self.description.coSimulation.modelIdentifier
        self.slave = self.slave_class(
            guid=self.description.guid, unzipDirectory=str(folder), modelIdentifier=identifier
        )

    def set(self, **values: float) -> None:
        self.slave.setReal([self.references[name] for name in values], list(values.values()))

    def get(self, *names: str) -> np.ndarray:
        return np.array(self.slave.getReal([self.references[name] for name in names]))

    def outputs(self) -> np.ndarray:
        return self.get(*(v.name for v in self.description.modelVariables if v.causality == "output"))

    def start(self, time: float = 0.0, stop: float | None = None, **values: float) -> None:
        """From the instantiated state to the first communication point."""
        self.set(**values)
        self.slave.setupExperiment(startTime=time, stopTime=stop)
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()
