"""Traces from files as runs of a stated scenario."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from overrun_hitch.foreign.mapping import OURS, Names, Theirs
from overrun_hitch.foreign.table import Table
from overrun_hitch.foreign.trace_file import read_table
from overrun_hitch.foreign.units import factor
from overrun_hitch.measure.resampling import jumps, resampled
from overrun_hitch.parameters import HitchError, Scenario
from overrun_hitch.results import VARIABLES, dataset, scenario_attributes

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class TraceFile:
    """Samples (n,) at `time` (n,) in s, which does not decrease; equal times are jumps. In our units and signs."""

    path: Path
    time: Floats
    columns: dict[str, Floats]  # of results.VARIABLES, those that there are
    notes: tuple[str, ...]  # what had to be guessed

    def times(self, end: float) -> Floats:
        """Its own times from 0 to `end`, each once, in s. HitchError where there are not two."""
        own = np.delete(self.time, jumps(self.time) - 1)
        found: Floats = own[(own >= 0.0) & (own <= end)]
        if len(found) < 2:
            span = f"{self.time[0]:g} to {self.time[-1]:g} s"
            raise HitchError(f"{self.path} has fewer than two samples in the run's 0 to {end:g} s; it has {span}")
        return found

    def run(self, scenario: Scenario, at: Floats) -> xr.Dataset:
        """As a run of this scenario, at times (m,) in s within its own (see results.dataset)."""
        nothing = np.full_like(at, np.nan)
        given = {name: resampled(self.time, column, at) for name, column in self.columns.items()}
        absent = ", ".join(name for name in VARIABLES if name not in given)
        attributes = {**scenario_attributes(scenario), "fmu": str(self.path), "missing": absent, "ended": "duration"}
        return dataset(at, {name: given.get(name, nothing) for name in VARIABLES}, attributes)

    def shifted(self, late: float) -> TraceFile:
        """The same, earlier by `late` s."""
        return TraceFile(self.path, self.time - late, self.columns, self.notes)


def read_trace_file(path: Path, names: Names) -> TraceFile:
    """The trace, by the mapping's names and units, else by ours. HitchError where it is none of a car and trailer."""
    table = read_table(path)
    time, guessed = in_our_unit(table, "time", names.get("time", Theirs("time")))
    guesses = ["time"] if guessed else []
    columns = {}
    for name in VARIABLES:
        if name in names or name in table.columns:
            columns[name], guessed = in_our_unit(table, name, names.get(name, Theirs(name)))
            guesses += [name] if guessed else []
    if not columns:
        wanted = ", ".join(VARIABLES)
        raise HitchError(f"{path} has none of {wanted}; name theirs with --map, which --propose writes")
    if len(time) < 2 or (np.diff(time) < 0.0).any():
        place = int((np.diff(time) < 0.0).argmax()) + 1
        raise HitchError(f"{path}: time must not decrease, over two samples at least; see sample {place}")
    note = f"gives no unit, taken as ours: {', '.join(guesses)}"
    return TraceFile(path, time, columns, (note,) if guesses else ())


def in_our_unit(table: Table, name: str, theirs: Theirs) -> tuple[Floats, bool]:
    """Samples (n,) of `name` in our unit and sign, and whether the unit was guessed. HitchError, naming the file."""
    samples, unit = table.column(theirs.name)
    unit = theirs.unit or unit
    try:
        size = factor(name, unit or OURS[name], OURS[name])
    except HitchError as error:
        raise HitchError(f"{table.path}: {theirs.name:.80}: {error}") from None
    return theirs.sign * size * samples, unit is None
