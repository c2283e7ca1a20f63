"""FMUs opened in this process, through fmpy. The one module that touches fmpy, which has no types.

fmpy's FMU2Slave is driven directly, not through simulate_fmu: so outputs are read at the start before the first step,
the unit's own messages are caught instead of printed, and whatever ends a run, the unpacked folder goes and the working
directory is what it was.
"""

from __future__ import annotations

import ctypes
import os
import tempfile
import zipfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
from fmpy.fmi1 import FMICallException, printLogMessage
from fmpy.fmi2 import (
    FMU2Slave,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    fmi2OK,
    fmi2Warning,
)
from numpy.typing import NDArray

from overrun_hitch.parameters import HitchError, Parameters
from overrun_hitch.results import VARIABLES

Floats = NDArray[np.float64]


class StartRefused(HitchError):
    """The unit could not start a run with these values; the message is its own."""


class StepRefused(HitchError):
    """The unit could not make a step; the message is its own."""


@dataclass(frozen=True)
class Variable:
    """A real parameter or input as an FMU describes it."""

    unit: str  # "" where the FMU gives none
    description: str
    low: float  # -inf: no limit
    high: float


@dataclass(frozen=True)
class Description:
    """What an FMU file says of itself, without being loaded."""

    guid: str
    parameters: Mapping[str, Variable]
    inputs: Mapping[str, Variable]
    interpolates: bool  # takes slopes of its inputs


class Unit:
    """An instance of an FMU for co-simulation, with names instead of value references; good for any number of runs.

    From `opened`. What the FMU refuses becomes a HitchError in its own words where `opened` ends.
    """

    def __init__(self, name: str, description: Any, slave: Any, messages: list[str]) -> None:
        self.name = name
        self._messages = messages
        self.guid = str(description.guid)
        self._slave = slave
        self._references = {variable.name: variable.valueReference for variable in description.modelVariables}
        self._derivatives = [unknown.variable for unknown in description.derivatives]
        self._fresh = True

    def start_with(self, values: Mapping[str, float], relative_tolerance: float) -> None:
        """From any state to t = 0 of a new run with these parameters and inputs (SI units). StartRefused if not."""
        self._messages.clear()  # those of the run before
        try:
            if not self._fresh:
                self._slave.reset()
            self._fresh = False
            self.set(values)
            self._slave.setupExperiment(tolerance=relative_tolerance, startTime=0.0)
            self._slave.enterInitializationMode()
            self._slave.exitInitializationMode()
        except FMICallException as error:
            raise StartRefused(_refusal(self.name, self._messages, error)) from None

    def set(self, values: Mapping[str, float]) -> None:
        """Set inputs, and during a run tunable parameters, by name (SI units)."""
        self._slave.setReal([self._references[name] for name in values], list(values.values()))

    def set_slopes(self, slopes: Mapping[str, float]) -> None:
        """How inputs change during the next step, by name, in their units per second."""
        references = [self._references[name] for name in slopes]
        self._slave.setRealInputDerivatives(references, [1] * len(references), list(slopes.values()))

    def change(self, values: Mapping[str, float], slopes: Mapping[str, float]) -> None:
        """Set inputs, and how they change during the next step. StepRefused if the unit doesn't take them."""
        try:
            self.set(values)
            if slopes:
                self.set_slopes(slopes)
        except FMICallException as error:
            raise StepRefused(_refusal(self.name, self._messages, error)) from None

    def get(self, names: Sequence[str]) -> list[float]:
        """Values by name (SI units)."""
        return list(self._slave.getReal([self._references[name] for name in names]))

    def step(self, time: float, size: float) -> None:
        """Go on from `time` by `size`, both in s. StepRefused if the unit can't; it may be started again."""
        try:
            self._slave.doStep(time, size)
        except FMICallException as error:
            raise StepRefused(_refusal(self.name, self._messages, error)) from None

    def sampler(self, names: Sequence[str], points: Floats) -> Sampler:
        """For many runs through the same `points` (n,) in s: see Sampler."""
        references = [self._references[name] for name in names]
        return Sampler(self._slave, references, points, lambda error: _refusal(self.name, self._messages, error))

    @contextmanager
    def saved(self) -> Iterator[Callable[[], None]]:
        """Keep the present state; what is given takes the unit back to it, as often as it is called."""
        state = self._slave.getFMUstate()
        try:
            yield lambda: self._slave.setFMUstate(state)
        finally:
            self._slave.freeFMUstate(state)

    def jacobian(self) -> tuple[list[str], Floats]:
        """Names (n,) of the states and the derivatives (n, n) of their rates by them: the unit's directional ones."""
        states = [rate.derivative.name for rate in self._derivatives]
        rates = [rate.valueReference for rate in self._derivatives]
        columns = [self._slave.getDirectionalDerivative(rates, [self._references[state]], [1.0]) for state in states]
        return states, np.array(columns, dtype=np.float64).T


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


class HitchUnit(Unit):
    """CarTrailer.fmu, or another tool's export of it."""

    def start(self, parameters: Parameters, inputs: Mapping[str, float], relative_tolerance: float) -> None:
        """From any state to t = 0 of a new run with these parameters and inputs (SI units)."""
        self.start_with({**parameters.model_dump(), **inputs}, relative_tolerance)

    def outputs(self) -> list[float]:
        """The outputs in the order of results.VARIABLES."""
        return self.get(list(VARIABLES))


@contextmanager
def opened_unit(fmu: Path, folder: Path | None = None) -> Iterator[HitchUnit]:
    """CarTrailer.fmu, see `opened`. HitchError also for an FMU that has not its variables.

    It is unpacked within `folder`, or where the system keeps temporary files.
    """
    needed = [*VARIABLES, *Parameters.model_fields, "brake_torque"]
    with _opened(fmu, needed, "a car and trailer", folder) as (description, slave, messages):
        yield HitchUnit(fmu.name, description, slave, messages)


def described(fmu: Path) -> Description:
    """What the FMU file says of its parameters and inputs. HitchError for a file that is none or of another kind."""
    with _unpacked(fmu) as (description, _):
        tables = {
            causality: {
                variable.name: Variable(
                    unit=variable.unit or "",
                    description=variable.description or variable.name,
                    low=-np.inf if variable.min is None else float(variable.min),
                    high=np.inf if variable.max is None else float(variable.max),
                )
                for variable in description.modelVariables
                if variable.type == "Real" and variable.causality == causality
            }
            for causality in ("parameter", "input")
        }
        interpolates = bool(description.coSimulation.canInterpolateInputs)
        return Description(str(description.guid), tables["parameter"], tables["input"], interpolates)


@contextmanager
def opened(fmu: Path, needed: Sequence[str], what: str) -> Iterator[Unit]:
    """Unpack and instantiate the FMU file, and clean up behind.

    `needed` are names that it must have to be `what` ("a trailer"). HitchError for a file that is none, for another
    kind of FMU, and for whatever the FMU refuses.
    """
    with _opened(fmu, needed, what) as (description, slave, messages):
        yield Unit(fmu.name, description, slave, messages)


@contextmanager
def _opened(
    fmu: Path, needed: Sequence[str], what: str, within: Path | None = None
) -> Iterator[tuple[Any, Any, list[str]]]:
    with _unpacked(fmu, within) as (description, folder):
        names = {variable.name for variable in description.modelVariables}
        missing = [name for name in needed if name not in names]
        if missing:
            raise HitchError(f"{fmu} is not {what}: it has no variable {', '.join(missing)}")
        with _instance(fmu, description, folder) as (slave, messages):
            yield description, slave, messages


@contextmanager
def _unpacked(fmu: Path, within: Path | None = None) -> Iterator[tuple[Any, str]]:
    """The model description of an FMU that this machine can run, and the folder it is unpacked in while needed."""
    if not fmu.is_file():
        raise HitchError(f"{fmu} is not there: an FMU file is needed")
    with tempfile.TemporaryDirectory(prefix="hitch-", dir=within) as folder:
        try:
            description = fmpy.read_model_description(str(fmu))
            with zipfile.ZipFile(fmu) as archive:
                names = archive.namelist()
            fmpy.extract(str(fmu), unzipdir=folder)
        except zipfile.BadZipFile:
            raise HitchError(f"{fmu} is broken: an FMU is a zip archive") from None
        except KeyError:
            raise HitchError(f"{fmu} is broken: it has no modelDescription.xml") from None
        except Exception as error:  # fmpy raises bare Exception, and lxml its own
            raise HitchError(f"{fmu} is broken: {_one_line(error)}") from None
        _check_kind(fmu, description, names)
        yield description, folder


def _check_kind(fmu: Path, description: Any, names: list[str]) -> None:
    if description.fmiVersion != "2.0" or description.coSimulation is None:
        raise HitchError(f"{fmu} has FMI {description.fmiVersion}: an FMI 2.0 unit for co-simulation is needed")
    library = f"{description.coSimulation.modelIdentifier}{fmpy.sharedLibraryExtension}"
    if f"binaries/{fmpy.platform}/{library}" not in names:
        there = sorted({name.split("/")[1] for name in names if name.startswith("binaries/") and name.count("/") == 2})
        raise HitchError(f"{fmu} has no {library} for {fmpy.platform}; it has {', '.join(there) or 'no binaries'}")


# fmpy's native proxy, which formats messages, knows one receiver for the whole process. So ours stays for good, tells
# runs apart by their component environment, and hands on what is not ours to fmpy's own.
_caught: dict[int, list[str]] = {}


def _receive(environment: int | None, instance: bytes, status: int, category: bytes, message: bytes) -> None:
    if environment not in _caught:
        printLogMessage(environment, instance, status, category, message)
    elif status != fmi2OK:
        _caught[environment].append(message.decode("utf-8", errors="replace"))


_RECEIVER = fmi2CallbackLoggerTYPE(_receive)


def listening() -> Any:
    """Callbacks for an FMU. From now on messages come to us, also after others have left a receiver that is gone, as
    fmpy.simulate_fmu does when it is given a logger."""
    callbacks = fmi2CallbackFunctions(
        logger=_RECEIVER,
        allocateMemory=fmpy.fmi2.defaultCallbacks.allocateMemory,
        freeMemory=fmpy.fmi2.defaultCallbacks.freeMemory,
    )
    try:
        from fmpy.logging import addLoggerProxy

        addLoggerProxy(ctypes.byref(callbacks))
    except (ImportError, OSError):
        pass  # fmpy ships no proxy for this platform: messages come without their values
    return callbacks


@contextmanager
def _instance(fmu: Path, description: Any, folder: str) -> Iterator[tuple[Any, list[str]]]:
    """An instance of the FMU. What goes wrong in the FMU becomes a HitchError with the unit's last message."""
    messages: list[str] = []
    callbacks = listening()
    callbacks.componentEnvironment = id(messages)
    slave = _loaded(fmu, description, folder)
    _caught[id(messages)] = messages
    try:
        try:
            slave.instantiate(callbacks=callbacks)
        except Exception as error:  # fmpy raises bare Exception
            raise HitchError(f"{fmu} does not start: {_one_line(messages[-1] if messages else error)}") from None
        yield slave, messages
    except FMICallException as error:
        raise HitchError(_refusal(fmu.name, messages, error)) from None
    finally:
        if slave.component is not None:
            slave.freeInstance()
        del _caught[id(messages)]


def _loaded(fmu: Path, description: Any, folder: str) -> Any:
    """The FMU's shared library with the functions of FMI 2.0 for co-simulation."""
    here = os.getcwd()
    try:
        identifier = description.coSimulation.modelIdentifier
        return FMU2Slave(guid=description.guid, unzipDirectory=folder, modelIdentifier=identifier)
    except Exception as error:  # fmpy raises bare Exception
        raise HitchError(f"{fmu} does not load: {_one_line(error)}") from None
    finally:
        os.chdir(here)  # fmpy changes to the library's folder to load it, and stays there if that fails


def _refusal(name: str, messages: Sequence[str], error: Exception) -> str:
    """The unit's last message, or fmpy's where it has none."""
    return f"{name}: {_one_line(messages[-1] if messages else error)}"


def _one_line(message: object) -> str:
    return " ".join(str(message).split())
