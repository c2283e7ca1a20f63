"""Every kind of FMU with the calls of fmpy's FMU2Slave: FMI 2 and 3, Co-Simulation and Model Exchange."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Model, FMU2Slave, fmi2Fatal, fmi2OK
from fmpy.fmi3 import FMU3Model, FMU3Slave

from overrun_hitch.fmu.integrated import Integrated
from overrun_hitch.fmu.messages import listening
from overrun_hitch.fmu.settings import Use


def loaded_slave(description: Any, folder: str, use: Use, messages: list[str]) -> Any:
    """The unit's library, loaded; what the unit will say goes to `messages`."""
    part = description.coSimulation if use == "cs" else description.modelExchange
    made = {"guid": description.guid, "unzipDirectory": folder, "modelIdentifier": part.modelIdentifier}
    if description.fmiVersion == "2.0":
        return FMU2Slave(**made) if use == "cs" else Integrated(FMU2Model(**made), description)
    unit = Calls3((FMU3Slave if use == "cs" else FMU3Model)(**made), messages)
    return unit if use == "cs" else Integrated(unit, description)


def callbacks_for(messages: list[str]) -> Any:
    """Those of FMI 2 for an instance whose messages are these."""
    callbacks = listening()
    callbacks.componentEnvironment = id(messages)
    return callbacks


class Calls3:
    """A unit of FMI 3 with the calls of FMI 2; those that have the same name are its own."""

    def __init__(self, unit: Any, messages: list[str]) -> None:
        self._unit = unit
        self._messages = messages
        self._experiment: dict[str, float] = {}

    def __getattr__(self, name: str) -> Any:
        return getattr(self._unit, name)

    def instantiate(self, callbacks: Any) -> None:
        """FMI 3 has the callback for messages alone."""
        self._unit.instantiate(logMessage=self._receive)

    def _receive(self, _: object, status: int, __: bytes, message: bytes) -> None:
        if status != fmi2OK:  # the same in FMI 3
            self._messages.append(message.decode("utf-8", errors="replace"))

    def setReal(self, references: Sequence[int], values: Sequence[float]) -> None:
        """Of Float64 alone."""
        self._unit.setFloat64(references, values)

    def getReal(self, references: Sequence[int]) -> list[float]:
        """Of Float64 alone."""
        return list(self._unit.getFloat64(references))

    def setupExperiment(self, tolerance: float, startTime: float) -> None:
        """Kept until initialization begins."""
        self._experiment = {"tolerance": tolerance, "startTime": startTime}

    def enterInitializationMode(self) -> None:
        """With what was set up."""
        self._unit.enterInitializationMode(**self._experiment)

    def doStep(self, time: float, size: float) -> None:
        """FMICallException where the unit ends the run."""
        _, ends, _, _ = self._unit.doStep(time, size)
        if ends:
            raise FMICallException("fmi3DoStep", fmi2Fatal)

    def newDiscreteStates(self) -> Any:
        """Its name in FMI 3: updateDiscreteStates."""
        return self._unit.updateDiscreteStates()

    def getDerivatives(self, rates: Any, count: int) -> None:
        """Its name in FMI 3: getContinuousStateDerivatives."""
        self._unit.getContinuousStateDerivatives(rates, count)
