"""FMU files opened in this process: loaded, instantiated and, whatever ends a run, freed and removed again."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Slave,
)

from overrun_hitch.fmu.messages import caught, listening, one_line, refusal
from overrun_hitch.fmu.unit import HitchUnit, Unit
from overrun_hitch.fmu.unpacking import unpacked
from overrun_hitch.parameters import HitchError, Parameters
from overrun_hitch.results import VARIABLES


@contextmanager
def opened_unit(fmu: Path) -> Iterator[HitchUnit]:
    """CarTrailer.fmu, see `opened`. HitchError also for an FMU that has not its variables."""
    needed = [*VARIABLES, *Parameters.model_fields, "brake_torque"]
    with _opened(fmu, needed, "a car and trailer") as (description, slave, messages):
        yield HitchUnit(fmu.name, description, slave, messages)


@contextmanager
def opened(fmu: Path, needed: Sequence[str], what: str) -> Iterator[Unit]:
    """Unpack and instantiate the FMU file, and clean up behind.

    `needed` are names that it must have to be `what` ("a trailer"). HitchError for a file that is none, for another
    kind of FMU, and for whatever the FMU refuses.
    """
    with _opened(fmu, needed, what) as (description, slave, messages):
        yield Unit(fmu.name, description, slave, messages)


@contextmanager
def _opened(fmu: Path, needed: Sequence[str], what: str) -> Iterator[tuple[Any, Any, list[str]]]:
    with unpacked(fmu) as (description, folder):
        names = {variable.name for variable in description.modelVariables}
        missing = [name for name in needed if name not in names]
        if missing:
            raise HitchError(f"{fmu} is not {what}: it has no variable {', '.join(missing)}")
        with _instance(fmu, description, folder) as (slave, messages):
            yield description, slave, messages


@contextmanager
def _instance(fmu: Path, description: Any, folder: str) -> Iterator[tuple[Any, list[str]]]:
    """An instance of the FMU. What goes wrong in the FMU becomes a HitchError with the unit's last message."""
    messages: list[str] = []
    callbacks = listening()
    callbacks.componentEnvironment = id(messages)
    slave = _loaded(fmu, description, folder)
    caught[id(messages)] = messages
    try:
        try:
            slave.instantiate(callbacks=callbacks)
        except Exception as error:  # fmpy raises bare Exception
            raise HitchError(f"{fmu} does not start: {one_line(messages[-1] if messages else error)}") from None
        yield slave, messages
    except FMICallException as error:
        raise HitchError(refusal(fmu.name, messages, error)) from None
    finally:
        if slave.component is not None:
            slave.freeInstance()
        del caught[id(messages)]


def _loaded(fmu: Path, description: Any, folder: str) -> Any:
    """The FMU's shared library with the functions of FMI 2.0 for co-simulation."""
    here = os.getcwd()
    try:
        identifier = description.coSimulation.modelIdentifier
        return FMU2Slave(guid=description.guid, unzipDirectory=folder, modelIdentifier=identifier)
    except Exception as error:  # fmpy raises bare Exception
        raise HitchError(f"{fmu} does not load: {one_line(error)}") from None
    finally:
        os.chdir(here)  # fmpy changes to the library's folder to load it, and stays there if that fails
