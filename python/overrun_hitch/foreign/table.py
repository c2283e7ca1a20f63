"""A table of what was measured or simulated elsewhere: columns with names and units, read when they are asked for."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from overrun_hitch.parameters import HitchError, unknown

Floats = NDArray[np.float64]

HEADER = re.compile(r"(?P<name>.*?)\s*[\[(](?P<unit>[^\])]*)[\])]\s*", re.DOTALL)  # "travel [mm]", "travel (mm)"


@dataclass(frozen=True)
class Table:
    """Columns of one file. They may be asked for by their names, with or without the unit in them."""

    path: Path
    names: tuple[str, ...]  # as in the file
    columns: Mapping[str, tuple[str, str | None]]  # a name that may be asked for: name in the file, unit or None
    read: Callable[[str], Floats]  # (n,), by the name in the file; HitchError if it holds no numbers

    def column(self, name: str) -> tuple[Floats, str | None]:
        """Samples (n,) and unit, None where the file gives none. HitchError, naming the file, where it is not there."""
        if name not in self.columns:
            raise HitchError(f"{self.path}: {unknown('column', name, dict.fromkeys(self.names))}")
        place, unit = self.columns[name]
        return self.read(place), unit


def table(path: Path, columns: Iterable[tuple[str, str | None]], read: Callable[[str], Floats]) -> Table:
    """Of columns by name and unit, which a name may have behind itself. The first of equal ones counts."""
    found: dict[str, tuple[str, str | None]] = {}
    names = []
    for name, unit in columns:
        parts = HEADER.fullmatch(name)
        own = unit if unit is not None else parts["unit"].strip() if parts else None
        found.setdefault(name, (name, own))
        if parts:
            found.setdefault(parts["name"], (name, own))
        names.append(name)
    return Table(path, tuple(names), found, read)
