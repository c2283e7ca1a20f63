"""What can be compared: FMUs, each in a process of its own, traces in files, and linear theory."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import asdict, dataclass, field
from pathlib import Path
from string import ascii_uppercase
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from overrun_hitch.comparison.traces import TraceFile, in_our_unit, read_trace_file
from overrun_hitch.experiments.step_brake import brake
from overrun_hitch.experiments.torque import Torque
from overrun_hitch.fmu.guest import GuestLost
from overrun_hitch.fmu.guest_unit import guest_file
from overrun_hitch.fmu.identity import Identity
from overrun_hitch.fmu.settings import Settings, Use, checked_time_limit
from overrun_hitch.foreign.mapping import Names, Theirs
from overrun_hitch.foreign.trace_file import read_table
from overrun_hitch.parameters import HitchError, Scenario

if TYPE_CHECKING:
    from overrun_hitch.fmu.unit import AnyUnit

Floats = NDArray[np.float64]

OURS, THEORY = Path("ours"), Path("theory")  # stand for our own FMU and for linear theory among the files
FMU = ".fmu"


@dataclass(frozen=True)
class Manoeuvre:
    """What all are asked for."""

    scenario: Scenario
    settings: Settings
    torque: Torque | None = None  # instead of a step of the scenario's


class Source(Protocol):
    """One of those that are compared."""

    @property
    def name(self) -> str:
        """For people."""

    @property
    def notes(self) -> tuple[str, ...]:
        """What had to be guessed, a sentence each."""

    def run(self, asked: Manoeuvre, times: Floats | None = None) -> xr.Dataset:
        """See results.dataset. At `times` (n,) in s, else at those that suit it. HitchError where it can't."""

    def provenance(self) -> dict[str, Any]:
        """What it is, for the record."""


@dataclass
class UnitSource:
    """An FMU, run for every scenario."""

    unit: AnyUnit
    path: Path | None = None
    lost: HitchError | None = None  # why it is not run any more
    identity: Identity | None = field(default=None, init=False)

    @property
    def name(self) -> str:
        """Of the file."""
        return str(self.path or self.unit.name)

    @property
    def notes(self) -> tuple[str, ...]:
        """By its description."""
        return self.identity.notes if self.identity else ()

    def run(self, asked: Manoeuvre, times: Floats | None = None) -> xr.Dataset:
        """See step_brake.brake. A unit that has crashed or was late is not run again."""
        if self.lost:
            raise self.lost
        try:
            result = brake(self.unit, asked.scenario, asked.settings, times, asked.torque).dataset()
            self.identity = self.unit.identity
        except GuestLost as error:
            self.lost = error
            raise
        return result

    def provenance(self) -> dict[str, Any]:
        """Path, digest, and what the FMU says of itself."""
        content = {"path": self.name, "sha256": digest(self.path) if self.path else None}
        return {**content, **(asdict(self.identity) if self.identity else {})}


@dataclass(frozen=True)
class TraceSource:
    """A trace, whatever is asked for: that it shows this scenario is the user's word."""

    trace: TraceFile

    @property
    def name(self) -> str:
        """Of the file."""
        return str(self.trace.path)

    @property
    def notes(self) -> tuple[str, ...]:
        """On units."""
        return self.trace.notes

    def run(self, asked: Manoeuvre, times: Floats | None = None) -> xr.Dataset:
        """At its own times as far as the scenario goes."""
        own = self.trace.times(asked.scenario.duration) if times is None else times
        return self.trace.run(asked.scenario, own)

    def provenance(self) -> dict[str, Any]:
        """Path, digest and span."""
        span = [float(self.trace.time[0]), float(self.trace.time[-1])]
        return {"path": self.name, "sha256": digest(self.trace.path), "span": span, "notes": self.notes}


class TheorySource:
    """Linear theory, which knows no trajectories; see comparison.theory."""

    name = "linear theory"
    notes = ()

    def run(self, asked: Manoeuvre, times: Floats | None = None) -> xr.Dataset:
        """It has none."""
        raise HitchError("linear theory has no traces; allowed as the reference, A, alone")

    def provenance(self) -> dict[str, Any]:
        """Its name."""
        return {"path": None, "sha256": None, "name": self.name}


def digest(path: Path) -> str:
    """SHA-256 of a file, in hexadecimal digits. HitchError where it cannot be read."""
    try:
        with path.open("rb") as file:
            whole = hashlib.sha256()
            while piece := file.read(2**20):
                whole.update(piece)
            return whole.hexdigest()
    except OSError as error:
        raise HitchError(f"cannot read {path}: {error.strerror or error}") from None


@dataclass(frozen=True)
class Asked:
    """A file as it was given."""

    path: Path
    names: Names
    use: Use | None


def is_trace(path: Path) -> bool:
    """Whether it is taken for a trace: anything but an FMU, by its name."""
    return path not in (OURS, THEORY) and path.suffix.lower() != FMU


def read_profile(path: Path) -> Torque:
    """A brake torque over time, columns `time` and `brake_torque`. HitchError where there is none in the file."""
    table = read_table(path)
    time, torque = (in_our_unit(table, name, Theirs(name))[0] for name in ("time", "brake_torque"))
    try:
        return Torque(time, torque)
    except HitchError as error:
        raise HitchError(f"{path}: {error}") from None


@contextmanager
def opened_sources(files: Sequence[Asked], time_limit: float) -> Iterator[list[Source]]:
    """All of them, for as long as they are needed. HitchError for a file that is not there or no trace."""
    checked_time_limit(time_limit)
    _check_number(files)
    for asked in files:
        if asked.path != THEORY and not asked.path.is_file():
            raise HitchError(f"{asked.path} is not there: an FMU file or a trace is needed")
    with ExitStack() as stack:
        yield [_opened(asked, time_limit, stack) for asked in files]


def _check_number(files: Sequence[Asked]) -> None:
    if len(files) < 2:
        alone = f"{files[0].path} alone" if files else "nothing"
        raise HitchError(f"{alone} cannot be compared: two files at least are needed, the reference first")
    if len(files) > len(ascii_uppercase):
        raise HitchError(f"{len(files)} files are too many: {len(ascii_uppercase)} at most")


def _opened(asked: Asked, time_limit: float, stack: ExitStack) -> Source:
    if asked.path == THEORY:
        return TheorySource()
    if is_trace(asked.path):
        return TraceSource(read_trace_file(asked.path, asked.names))
    return UnitSource(stack.enter_context(guest_file(asked.path, time_limit, asked.names, asked.use)), asked.path)
