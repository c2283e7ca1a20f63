"""Step brakes on the FMU, through fmpy. The one module that touches fmpy, which has no types.

fmpy's FMU2Slave is driven directly, not through simulate_fmu: so outputs are read at t = 0 before the first step,
every communication point is a multiple of the step without accumulated rounding, the unit's own messages are caught
instead of printed, and whatever ends the run, the unpacked folder goes and the working directory is what it was.
"""

from __future__ import annotations

import ctypes
import math
import os
import tempfile
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.metadata import version
from itertools import pairwise
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import xarray as xr
from fmpy.fmi1 import FMICallException, printLogMessage
from fmpy.fmi2 import (
    FMU2Slave,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    fmi2OK,
)

from overrun_hitch.parameters import HitchError, Parameters, Quantities, Scenario, quantity
from overrun_hitch.results import VARIABLES, dataset, scenario_attributes

MOST_STEPS = 1_000_000  # a table of 10 columns of that length takes 80 MB
STANDSTILL = 0.1  # m/s, the FMU's lowest start speed: slip, a difference over the speed, means nothing at rest


class Settings(Quantities):
    """How finely a run is computed and how finely it is written."""

    relative_tolerance: float = quantity(1e-6, "", "relative tolerance of the integrator", ge=1e-12, le=1e-2)
    communication_step: float = quantity(0.01, "s", "communication step", ge=1e-6)


def step_brake(
    scenario: Scenario, *, fmu: Path, relative_tolerance: float = 1e-6, communication_step: float = 0.01
) -> xr.Dataset:
    """Run `scenario` on the FMU file and sample it every `communication_step` s, t = 0 included (see results.dataset).

    The run ends early, with attribute `ended` = "standstill", before car or trailer comes to rest, where the paper's
    model ends. HitchError for settings out of range, an FMU that is none or not of this kind, and for whatever the
    FMU refuses, in its own words.
    """
    settings = Settings(relative_tolerance=relative_tolerance, communication_step=communication_step)
    h = settings.communication_step
    if scenario.duration / h > MOST_STEPS:
        raise HitchError(
            f"communication_step = {h:g} s is not allowed: {MOST_STEPS} steps at most in {scenario.duration:g} s"
        )
    points = _communication_points(scenario.duration, h)
    with _unpacked(fmu) as (description, folder), _instance(fmu, description, folder) as slave:
        references = _references(fmu, description)
        _start(slave, references, scenario, settings.relative_tolerance)
        outputs = [references[name] for name in VARIABLES]
        rows = [slave.getReal(outputs)]
        for now, then in pairwise(points.tolist()):
            if _comes_to_rest(rows[-1], then - now):
                break
            slave.doStep(now, then - now)
            rows.append(slave.getReal(outputs))
        slave.terminate()
    attributes = {
        **scenario_attributes(scenario),
        **settings.model_dump(),
        "fmu": fmu.name,
        "guid": description.guid,
        "ended": "duration" if len(rows) == len(points) else "standstill",
        "versions": ", ".join(f"{name} {version(name)}" for name in ("fmpy", "numpy", "xarray")),
    }
    return dataset(points[: len(rows)], dict(zip(VARIABLES, np.array(rows).T, strict=True)), attributes)


def car_alone(scenario: Scenario) -> Scenario:
    """The same step brake with nothing between car and trailer (k = k_t = C = r = 0): the car as if alone."""
    loose = scenario.parameters.changed({"k": 0.0, "k_t": 0.0, "C": 0.0, "r": 0.0})
    return scenario.changed(name=f"{scenario.name}, car alone", parameters=loose)


def _communication_points(duration: float, h: float) -> np.ndarray[Any, np.dtype[np.float64]]:
    """0, h, 2 h, ... and the end of the run, which a last shorter step may have to reach."""
    steps = math.ceil(duration / h * (1.0 - 1e-12))
    return np.append(np.arange(steps) * h, duration)


def _comes_to_rest(row: list[float], h: float) -> bool:
    v_car, v_trailer, a_car, a_trailer = row[:4]
    # Twice the step: an acceleration that grows within it must not carry the run past rest.
    return min(v_car + 2.0 * h * min(a_car, 0.0), v_trailer + 2.0 * h * min(a_trailer, 0.0)) < STANDSTILL


def _start(slave: Any, references: dict[str, int], scenario: Scenario, relative_tolerance: float) -> None:
    start = {**scenario.parameters.model_dump(), "brake_torque": scenario.brake_torque}
    slave.setReal([references[name] for name in start], list(start.values()))
    slave.setupExperiment(tolerance=relative_tolerance, startTime=0.0, stopTime=scenario.duration)
    slave.enterInitializationMode()
    slave.exitInitializationMode()


def _references(fmu: Path, description: Any) -> dict[str, int]:
    references = {variable.name: variable.valueReference for variable in description.modelVariables}
    wanted = [*VARIABLES, *Parameters.model_fields, "brake_torque"]
    missing = [name for name in wanted if name not in references]
    if missing:
        raise HitchError(f"{fmu} is not a car and trailer: it has no variable {', '.join(missing)}")
    return references


@contextmanager
def _unpacked(fmu: Path) -> Iterator[tuple[Any, str]]:
    """The model description of an FMU that this machine can run, and the folder it is unpacked in while needed."""
    if not fmu.is_file():
        raise HitchError(f"{fmu} is not there: an FMU file is needed")
    with tempfile.TemporaryDirectory(prefix="hitch-") as folder:
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
_CALLBACKS = fmi2CallbackFunctions(
    logger=_RECEIVER,
    allocateMemory=fmpy.fmi2.defaultCallbacks.allocateMemory,
    freeMemory=fmpy.fmi2.defaultCallbacks.freeMemory,
)
try:
    from fmpy.logging import addLoggerProxy

    addLoggerProxy(ctypes.byref(_CALLBACKS))
except (ImportError, OSError):
    pass  # fmpy ships no proxy for this platform: messages come without their values


@contextmanager
def _instance(fmu: Path, description: Any, folder: str) -> Iterator[Any]:
    """An instance of the FMU. What goes wrong in the FMU becomes a HitchError with the unit's last message."""
    messages: list[str] = []
    callbacks = fmi2CallbackFunctions.from_buffer_copy(_CALLBACKS)
    callbacks.componentEnvironment = id(messages)
    slave = _loaded(fmu, description, folder)
    _caught[id(messages)] = messages
    try:
        try:
            slave.instantiate(callbacks=callbacks)
        except Exception as error:  # fmpy raises bare Exception
            raise HitchError(f"{fmu} does not start: {_one_line(messages[-1] if messages else error)}") from None
        yield slave
    except FMICallException as error:
        raise HitchError(f"{fmu.name}: {_one_line(messages[-1] if messages else error)}") from None
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


def _one_line(message: object) -> str:
    return " ".join(str(message).split())
