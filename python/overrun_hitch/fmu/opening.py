"""FMU files opened in this process: loaded, instantiated and, whatever ends a run, freed and removed again."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from fmpy.fmi1 import FMICallException

from overrun_hitch.fmu.messages import caught, one_line, refusal
from overrun_hitch.fmu.settings import USES, Use
from overrun_hitch.fmu.slaves import callbacks_for, loaded_slave
from overrun_hitch.fmu.translation import translation
from overrun_hitch.fmu.unit import HitchUnit, TranslatedUnit, Unit
from overrun_hitch.fmu.unpacking import check_library, unpacked
from overrun_hitch.foreign.mapping import Names
from overrun_hitch.parameters import HitchError, Parameters
from overrun_hitch.results import VARIABLES


@contextmanager
def opened_unit(fmu: Path) -> Iterator[HitchUnit]:
    """CarTrailer.fmu, see `opened`. HitchError also for an FMU that has not its variables."""
    needed = [*VARIABLES, *Parameters.model_fields, "brake_torque"]
    with _opened(fmu, needed, "a car and trailer") as (description, slave, messages):
        yield HitchUnit(fmu.name, description, slave, messages)


@contextmanager
def opened_foreign(fmu: Path, names: Names, use: Use | None) -> Iterator[TranslatedUnit]:
    """An FMU of car and trailer by whom it may be, FMI 2 or 3, with its own names and units.

    `use`: None for Co-Simulation where it is offered, else Model Exchange. HitchError for a file that is none, and for
    one without the brake's input or without any of our outputs.
    """
    chosen: list[Use] = []

    def check(fmu: Path, description: Any, library_names: list[str]) -> None:
        chosen.append(_use(fmu, description, use))
        check_library(fmu, description, library_names, chosen[0])

    with unpacked(fmu, check) as (description, folder):
        translated = translation(fmu, description, names)
        with _instance(fmu, description, folder, chosen[0]) as (slave, messages):
            yield TranslatedUnit(fmu.name, description, slave, messages, translated, chosen[0])


def _use(fmu: Path, description: Any, use: Use | None) -> Use:
    if description.fmiVersion not in ("2.0", "3.0"):
        raise HitchError(f"{fmu} has FMI {description.fmiVersion}; allowed: 2.0 and 3.0")
    parts = {"cs": description.coSimulation, "me": description.modelExchange}
    offered = [kind for kind in USES if parts[kind] is not None]
    if not offered or (use and use not in offered):
        there = " and ".join(USES[kind] for kind in offered) or "neither Co-Simulation nor Model Exchange"
        raise HitchError(f"{fmu} offers no {USES[use] if use else 'use that is known'}; it offers {there}")
    return use or offered[0]


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
        with _instance(fmu, description, folder, "cs") as (slave, messages):
            yield description, slave, messages


@contextmanager
def _instance(fmu: Path, description: Any, folder: str, use: Use) -> Iterator[tuple[Any, list[str]]]:
    """An instance of the FMU. What goes wrong in the FMU becomes a HitchError with the unit's last message."""
    messages: list[str] = []
    callbacks = callbacks_for(messages)
    slave = _loaded(fmu, description, folder, use, messages)
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


def _loaded(fmu: Path, description: Any, folder: str, use: Use, messages: list[str]) -> Any:
    """The FMU's shared library with the functions of its FMI for this use."""
    here = os.getcwd()
    try:
        return loaded_slave(description, folder, use, messages)
    except Exception as error:  # fmpy raises bare Exception
        raise HitchError(f"{fmu} does not load: {one_line(error)}") from None
    finally:
        os.chdir(here)  # fmpy changes to the library's folder to load it, and stays there if that fails
