"""A trace from a CSV file: which column is what, in which unit."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from overrun_hitch.fitting.trace import UNITS, Floats, Trace
from overrun_hitch.parameters import HitchError, unknown

OPTIONAL = ("v_rel", "trailer_brake_torque")
HEADER = re.compile(r"(?P<name>.*?)\s*[\[(](?P<unit>[^\])]*)[\])]\s*")  # "travel [mm]", "travel (mm)"


def read_trace(path: Path, columns: Mapping[str, str], units: Mapping[str, str]) -> tuple[Trace, list[str]]:
    """The trace in a CSV file, and what had to be guessed, a sentence each.

    `columns` says for variables of trace.UNITS what their columns are called, with or without the unit in the header;
    without, they bear the variable's name. `units` go before those of the header. HitchError, naming file and column,
    where one is missing or holds no numbers, or its unit does not fit.
    """
    try:
        frame = pd.read_csv(path, skipinitialspace=True, dtype=str, keep_default_na=False, encoding="utf-8-sig")
    except OSError as error:
        raise HitchError(f"cannot read {path}: {error.strerror or error}") from None
    except (ValueError, pd.errors.ParserError) as error:
        raise HitchError(f"{path} is no table under one line of names: {' '.join(str(error).split())}") from None
    headers = _headers(frame)
    guesses, channels = [], {}
    for name, si in UNITS.items():
        asked = columns.get(name, name)
        if asked not in headers:
            if name in OPTIONAL and name not in columns:
                continue
            raise HitchError(f"{path}: {unknown('column', asked, dict.fromkeys(frame.columns))}")
        place, unit = headers[asked]
        if name not in units and unit is None:
            guesses.append(f"{asked}: no unit given, taken as {si}")
        channels[name] = factor(name, units.get(name) or unit or si) * _numbers(path, frame, place)
    return Trace(**channels), guesses


def _headers(frame: pd.DataFrame) -> dict[str, tuple[int, str | None]]:
    """Header, with and without its unit, to place and unit; the first of equal ones counts."""
    found: dict[str, tuple[int, str | None]] = {}
    for place, header in enumerate(map(str, frame.columns)):
        parts = HEADER.fullmatch(header)
        unit = parts["unit"].strip() if parts else None
        found.setdefault(header, (place, unit))
        if parts:
            found.setdefault(parts["name"], (place, unit))
    return found


def _numbers(path: Path, frame: pd.DataFrame, place: int) -> Floats:
    column = frame.iloc[:, place]
    numbers = np.asarray(pd.to_numeric(column, errors="coerce"), dtype=np.float64)
    wrong = np.flatnonzero(~np.isfinite(numbers))
    if wrong.size:
        first = int(wrong[0])
        raise HitchError(
            f"{path}: column {str(frame.columns[place])!r:.40}, line {first + 2}: "
            f"{column.iloc[first]!r:.20} is not a finite number"
        )
    return numbers


def factor(name: str, unit: str) -> float:
    """What a value of the variable in this unit is to be multiplied by for the FMU's; HitchError if it does not fit."""
    si = UNITS[name]
    if unit == si:
        return 1.0
    registry = _registry()
    # As Modelica and engineers write products: N.m, Nm.
    asked, wanted = (re.sub(r"Nm\b", "N*m", text.replace(".", "*")) for text in (unit, si))
    try:
        return float(registry.Quantity(1.0, asked).to(wanted).magnitude)
    except Exception:  # pint raises its parser's and the tokenizer's errors as well as its own
        raise HitchError(f"{unit!r:.20} is no unit of {name}; allowed: {si} and what can be converted to it") from None


@cache
def _registry() -> Any:
    # Imported here, because it takes half a second that a trace in SI need not wait for.
    import pint

    return pint.UnitRegistry()
