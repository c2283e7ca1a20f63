"""CarTrailer.fmu opened in a process of its own, see guest.py."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Concatenate, ParamSpec, TypeVar

from overrun_hitch.fmu.guest import Guest
from overrun_hitch.fmu.opening import opened_unit
from overrun_hitch.fmu.settings import TIME_LIMIT, checked_time_limit
from overrun_hitch.fmu.unit import AnyUnit, HitchUnit

P = ParamSpec("P")
R = TypeVar("R")


class GuestUnit:
    """A unit in a guest, an AnyUnit: runs are performed there."""

    def __init__(self, name: str, guest: Guest) -> None:
        self.name = name
        self._guest = guest

    @property
    def guid(self) -> str:
        """Of the FMU's description."""
        return str(self._guest.call(_guid))

    def perform(self, run: Callable[Concatenate[HitchUnit, P], R], *args: P.args, **kwargs: P.kwargs) -> R:
        """`run(unit, ...)`, there. Raises what `run` raises; GuestLost where it takes too long or crashes."""
        done: R = self._guest.call(_performed, run, args, kwargs)
        return done


@contextmanager
def guest_unit(fmu: Path, time_limit: float = TIME_LIMIT) -> Iterator[GuestUnit]:
    """CarTrailer.fmu, or another tool's export of it, in its own process, which starts now and gets ready meanwhile.

    `time_limit` in s, for each run. HitchError as `opened_unit`, from the first run on.
    """
    with Guest(str(fmu), checked_time_limit(time_limit), opened_unit, fmu) as guest:
        yield GuestUnit(fmu.name, guest)


@contextmanager
def guest_file(fmu: Path, time_limit: float = TIME_LIMIT) -> Iterator[GuestUnit]:
    """As `guest_unit`, but every run has an instance of its own: what others do in a reset is another question."""
    with Guest(str(fmu), checked_time_limit(time_limit), _file, fmu) as guest:
        yield GuestUnit(fmu.name, guest)


class _File:
    """An AnyUnit that is opened for each run."""

    def __init__(self, fmu: Path) -> None:
        self.name = fmu.name
        self.guid = ""
        self._fmu = fmu

    def perform(self, run: Callable[Concatenate[HitchUnit, P], R], *args: P.args, **kwargs: P.kwargs) -> R:
        with opened_unit(self._fmu) as unit:
            self.guid = unit.guid
            return run(unit, *args, **kwargs)


@contextmanager
def _file(fmu: Path) -> Iterator[_File]:
    yield _File(fmu)


def _performed(unit: AnyUnit, run: Callable[..., R], args: tuple[Any, ...], kwargs: dict[str, Any]) -> R:
    return unit.perform(run, *args, **kwargs)


def _guid(unit: AnyUnit) -> str:
    return unit.guid
