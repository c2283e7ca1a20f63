"""What can be compared: FMUs, each in a process of its own."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import xarray as xr

from overrun_hitch.experiments.step_brake import brake
from overrun_hitch.fmu.guest import GuestLost
from overrun_hitch.fmu.guest_unit import guest_file
from overrun_hitch.fmu.settings import Settings, Use, checked_time_limit
from overrun_hitch.fmu.unit import AnyUnit, Identity
from overrun_hitch.foreign.mapping import Names
from overrun_hitch.parameters import HitchError, Scenario


@dataclass
class UnitSource:
    """An FMU, run for every scenario."""

    unit: AnyUnit
    path: Path | None = None
    lost: HitchError | None = None  # why it is not run any more
    identity: Identity | None = field(default=None, init=False)

    @property
    def name(self) -> str:
        """For people."""
        return str(self.path or self.unit.name)

    def run(self, scenario: Scenario, settings: Settings) -> xr.Dataset:
        """See step_brake.brake. HitchError where the unit has crashed or was late before: it gets one chance."""
        if self.lost:
            raise self.lost
        try:
            result = brake(self.unit, scenario, settings)
            self.identity = self.unit.identity
        except GuestLost as error:
            self.lost = error
            raise
        return result

    @property
    def notes(self) -> tuple[str, ...]:
        """What had to be guessed."""
        return self.identity.notes if self.identity else ()

    def provenance(self) -> dict[str, Any]:
        """What it is, for the record."""
        content = {"path": self.name, "sha256": digest(self.path) if self.path else None}
        return {**content, **(asdict(self.identity) if self.identity else {})}


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


@contextmanager
def opened_sources(files: list[Asked], time_limit: float) -> Iterator[list[UnitSource]]:
    """All of them, for as long as they are needed. HitchError for a file that is not there."""
    checked_time_limit(time_limit)
    for asked in files:
        if not asked.path.is_file():
            raise HitchError(f"{asked.path} is not there: an FMU file is needed")
    with ExitStack() as stack:
        units = [stack.enter_context(guest_file(one.path, time_limit, one.names, one.use)) for one in files]
        yield [UnitSource(unit, one.path) for unit, one in zip(units, files, strict=True)]
