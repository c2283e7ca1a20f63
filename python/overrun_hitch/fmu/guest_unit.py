"""Units opened in a process of their own, see guest.py."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Concatenate, ParamSpec, TypeVar

from overrun_hitch.fmu.guest import Guest
from overrun_hitch.fmu.identity import Identity
from overrun_hitch.fmu.settings import TIME_LIMIT, Use, checked_time_limit
from overrun_hitch.foreign.mapping import NO_NAMES, Names

if TYPE_CHECKING:  # fmpy is for guests: a host need not wait until it is loaded
    from overrun_hitch.fmu.unit import AnyUnit, HitchUnit

P = ParamSpec("P")
R = TypeVar("R")


class GuestUnit:
    """A unit in a guest, an AnyUnit: runs are performed there."""

    def __init__(self, name: str, guest: Guest) -> None:
        self.name = name
        self._guest = guest

    @property
    def identity(self) -> Identity:
        """As AnyUnit's."""
        found: Identity = self._guest.call(_identity)
        return found

    def perform(self, run: Callable[Concatenate[HitchUnit, P], R], *args: P.args, **kwargs: P.kwargs) -> R:
        """`run(unit, ...)`, there. Raises what `run` raises; GuestLost where it takes too long or crashes."""
        done: R = self._guest.call(_performed, run, args, kwargs)
        return done


@contextmanager
def guest_unit(fmu: Path, time_limit: float = TIME_LIMIT) -> Iterator[GuestUnit]:
    """CarTrailer.fmu, or another tool's export of it, in its own process, which starts now and gets ready meanwhile.

    `time_limit` in s, for each run. HitchError as `opened_unit`, from the first run on.
    """
    with Guest(str(fmu), checked_time_limit(time_limit), _unit, fmu) as guest:
        yield GuestUnit(fmu.name, guest)


@contextmanager
def guest_file(
    fmu: Path, time_limit: float = TIME_LIMIT, names: Names = NO_NAMES, use: Use | None = None
) -> Iterator[GuestUnit]:
    """An FMU of car and trailer by whom it may be (see opened_foreign), in its own process as `guest_unit`.

    Every run has an instance of its own: what others do in a reset is another question.
    """
    with Guest(str(fmu), checked_time_limit(time_limit), _file, fmu, dict(names), use) as guest:
        yield GuestUnit(fmu.name, guest)


@contextmanager
def _unit(fmu: Path) -> Iterator[HitchUnit]:
    from overrun_hitch.fmu.opening import opened_unit

    with opened_unit(fmu) as unit:
        yield unit


class _File:
    """An AnyUnit that is opened for each run."""

    def __init__(self, fmu: Path, names: Names, use: Use | None) -> None:
        self.name = fmu.name
        self.identity = Identity("", "", "")
        self._how = fmu, names, use

    def perform(self, run: Callable[Concatenate[HitchUnit, P], R], *args: P.args, **kwargs: P.kwargs) -> R:
        from overrun_hitch.fmu.opening import opened_foreign

        with opened_foreign(*self._how) as unit:
            self.identity = unit.identity
            return run(unit, *args, **kwargs)


@contextmanager
def _file(fmu: Path, names: Names, use: Use | None) -> Iterator[_File]:
    yield _File(fmu, names, use)


def _performed(unit: AnyUnit, run: Callable[..., R], args: tuple[Any, ...], kwargs: dict[str, Any]) -> R:
    return unit.perform(run, *args, **kwargs)


def _identity(unit: AnyUnit) -> Identity:
    return unit.identity
