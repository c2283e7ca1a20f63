"""Our variables in an FMU of other people's: their names, and factors for their units and signs."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from overrun_hitch.foreign.mapping import OURS, Names, Theirs
from overrun_hitch.foreign.units import factor
from overrun_hitch.parameters import COUNTS_FROM, DATUM, HitchError, Parameters, unknown, with_unit
from overrun_hitch.results import VARIABLES

REALS = ("Real", "Float64")
KINDS = {
    "output": (("output", "local", "calculatedParameter"), "read"),
    "input": (("input",), "an input"),
    "parameter": (("parameter", "input"), "set"),
}


@dataclass(frozen=True)
class Channel:
    """One of our variables in the FMU: a value in ours is `factor` times theirs."""

    reference: int
    factor: float  # 1 or -1 included for the sign


@dataclass(frozen=True)
class Translation:
    """What there is of our variables, by our names."""

    channels: Mapping[str, Channel]
    missing: tuple[str, ...]  # outputs that the FMU has not
    notes: tuple[str, ...]  # what had to be guessed, a sentence each

    def settings(self, name: str, values: Mapping[str, float]) -> tuple[list[int], list[float]]:
        """References and their values of inputs and parameters in our units; `name` is the FMU's, for messages.

        A parameter that is not there counts as having the default. HitchError for one that has not, and counts.
        """
        for key in values.keys() - self.channels.keys():
            default = getattr(DATUM, key, None)
            limit = COUNTS_FROM.get(key, key)
            is_out_of_reach = limit != key and values[limit] == getattr(DATUM, limit)
            if values[key] != default and not is_out_of_reach:
                value, rest = (with_unit(v, OURS[key]) for v in (values[key], default or 0.0))
                raise HitchError(f"{name} has no {key}, which is {value} in this run; without it allowed: {rest}")
        found = {key: self.channels[key] for key in values if key in self.channels}
        references = [channel.reference for channel in found.values()]
        return references, [values[key] / channel.factor for key, channel in found.items()]


def translation(fmu: Path, description: Any, names: Names) -> Translation:
    """HitchError where a mapping names what is not there, a unit does not fit, or nothing can be braked or compared."""
    table = {variable.name: variable for variable in description.modelVariables}
    units = {unit.name: unit.baseUnit for unit in description.unitDefinitions}
    channels, without_unit = {}, []
    for ours, kind in _wanted():
        theirs = names.get(ours, Theirs(ours))
        variable = table.get(theirs.name)
        if variable is None or variable.type not in REALS or variable.causality not in KINDS[kind][0]:
            if ours in names:
                raise HitchError(f"{fmu}: {_wrong(ours, kind, theirs.name, table)}")
            continue
        if theirs.unit is None and not variable.unit:
            without_unit.append(ours)
        size = _factor(fmu, ours, theirs, variable.unit, units)
        channels[ours] = Channel(variable.valueReference, theirs.sign * size)
    missing = tuple(name for name in VARIABLES if name not in channels)
    if "brake_torque" not in channels or len(missing) == len(VARIABLES):
        absent = "brake_torque" if "brake_torque" not in channels else ", ".join(missing)
        raise HitchError(f"{fmu} is not a car and trailer: it has no variable {absent}; or name theirs with --map")
    return Translation(channels, missing, tuple(_notes(channels, without_unit)))


def _wanted() -> Iterator[tuple[str, str]]:
    yield from (("brake_torque", "input"), ("grade", "input"))
    yield from ((name, "output") for name in VARIABLES)
    yield from ((name, "parameter") for name in Parameters.model_fields)


def _wrong(ours: str, kind: str, theirs: str, table: Mapping[str, Any]) -> str:
    causalities, words = KINDS[kind]
    if theirs in table:
        found = table[theirs]
        return f"{theirs!r:.80} cannot be {ours}: it is no real number that can be {words} ({found.causality})"
    fitting = sorted(name for name, variable in table.items() if variable.causality in causalities)
    return unknown("variable", theirs, fitting)


def _factor(fmu: Path, ours: str, theirs: Theirs, declared: str | None, units: Mapping[str, Any]) -> float:
    """Ours over theirs, without the sign: by the mapping's unit, else by the FMU's own definition of its unit."""
    unit = theirs.unit or declared or OURS[ours]
    base = units.get(unit) if theirs.unit is None else None
    try:
        if base is None:
            return factor(ours, unit, OURS[ours])
        if unit == OURS[ours] and base.factor == 1.0 and base.offset == 0.0:
            return 1.0
        if base.offset != 0.0 or not 0.0 < base.factor < math.inf:
            raise HitchError(f"{unit!r:.20} is no unit of {ours}: factor {base.factor:g}, offset {base.offset:g}")
        powers = "*".join(f"{key}**{getattr(base, key)}" for key in ("kg", "m", "s", "A", "K", "mol", "cd"))
        return float(base.factor) * factor(ours, powers, OURS[ours])
    except HitchError as error:
        raise HitchError(f"{fmu}: {theirs.name:.80}: {error}") from None


def _notes(channels: Mapping[str, Channel], without_unit: list[str]) -> Iterator[str]:
    if without_unit:
        listed = "all of them" if len(without_unit) == len(channels) else ", ".join(without_unit)
        yield f"declares no unit, taken as ours: {listed}"
    absent = [name for name in Parameters.model_fields if name not in channels]
    if absent:
        yield f"has no parameter {', '.join(absent)}: taken as at their defaults"
