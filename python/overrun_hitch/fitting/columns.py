"""A trace from a file: which column is what, in which unit."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from overrun_hitch.fitting.trace import UNITS, Trace
from overrun_hitch.foreign.trace_file import read_table
from overrun_hitch.foreign.units import factor

OPTIONAL = ("v_rel", "trailer_brake_torque")


def read_trace(path: Path, columns: Mapping[str, str], units: Mapping[str, str]) -> tuple[Trace, list[str]]:
    """The trace in a file, and what had to be guessed, a sentence each.

    `columns` says for variables of trace.UNITS what their columns are called, with or without the unit in the header;
    without, they bear the variable's name. `units` go before those of the header. HitchError, naming file and column,
    where one is missing or holds no numbers, or its unit does not fit.
    """
    table = read_table(path)
    guesses, channels = [], {}
    for name, si in UNITS.items():
        asked = columns.get(name, name)
        if name in OPTIONAL and name not in columns and asked not in table.columns:
            continue
        samples, unit = table.column(asked)
        if name not in units and unit is None:
            guesses.append(f"{asked}: no unit given, taken as {si}")
        channels[name] = factor(name, units.get(name) or unit or si, si) * samples
    return Trace(**channels), guesses
