"""What happens at events: as Modelica says it (when, reinit, ...), and as a schedule. All are frozen."""

from __future__ import annotations

from dataclasses import dataclass

import sympy

from .equations import Assignment, Block


@dataclass(frozen=True)
class Alternatives:
    """One equation between discrete variables, as the assignments that it may be: one or, for ``a = b``, two."""

    assignments: tuple[Assignment, ...]


@dataclass(frozen=True)
class Message:
    """A text with a value at each ``%s``; each value has a type (see Variable)."""

    format: str
    values: tuple[tuple[sympy.Expr, str], ...] = ()


@dataclass(frozen=True)
class Check:
    """What must not be: where ``violated``, the message is given, and a warning or an error; or the model ends."""

    violated: sympy.Expr
    message: Message
    kind: str  # WARN, FAIL, END
    origin: str


@dataclass(frozen=True)
class Reinit:
    """``state`` gets a new value where ``active``."""

    state: str
    active: sympy.Expr
    value: sympy.Expr
    origin: str


@dataclass(frozen=True)
class Together:
    """The elements of an array, assigned at once: each value is that before the statement."""

    assignments: tuple[Assignment, ...]


@dataclass(frozen=True)
class Choice:
    """Statements under conditions; the last condition may be true. With several that hold the first one counts."""

    branches: tuple[tuple[sympy.Expr, tuple[Statement, ...]], ...]


@dataclass(frozen=True)
class WhenBranch:
    """Statements for the moments at which one of the conditions becomes true."""

    conditions: tuple[sympy.Expr, ...]
    statements: tuple[Statement, ...]
    origin: str


@dataclass(frozen=True)
class When:
    """A when-clause: the first branch, then those of elsewhen."""

    branches: tuple[WhenBranch, ...]


@dataclass(frozen=True)
class Algorithm:
    """An algorithm section: statements in their order, and the variables that they assign."""

    statements: tuple[Statement, ...]
    targets: tuple[str, ...]
    origin: str


Statement = Assignment | Together | Reinit | Check | Choice | When


@dataclass(frozen=True)
class Sample:
    """A clock that ticks at ``start + i*interval``."""

    start: sympy.Expr
    interval: sympy.Expr
    origin: str


@dataclass(frozen=True)
class DiscreteEquations:
    """What is computed at events. Each assignment is to a discrete variable; the order is none."""

    assignments: tuple[Assignment, ...] = ()
    reinits: tuple[Reinit, ...] = ()
    checks: tuple[Check, ...] = ()  # first those at events, then those at any time
    n_event_checks: int = 0
    samples: tuple[Sample, ...] = ()


@dataclass(frozen=True)
class ScheduledReinit:
    """``state`` gets the value of the variable ``value`` where the Boolean variable ``active`` is true."""

    state: str
    active: str
    value: str


@dataclass(frozen=True)
class ScheduledSample:
    """The Boolean variable ``flag`` is true at the ticks; the others are variables with its times."""

    flag: str
    start: str
    interval: str


@dataclass(frozen=True)
class ScheduledCheck:
    """The Boolean variable ``violated``, and what follows where it is true; see Check."""

    violated: str
    message: Message
    kind: str


@dataclass(frozen=True)
class Memory:
    """The variable ``before`` keeps the value of ``name`` before an event. If it is discrete, a change is an event."""

    name: str
    before: str
    is_discrete: bool


@dataclass(frozen=True)
class Schedule:
    """What happens at events, in the order in which it can be computed."""

    assignments: tuple[Block, ...] = ()
    check_assignments: tuple[Block, ...] = ()  # of checks at any time
    memories: tuple[Memory, ...] = ()
    reinits: tuple[ScheduledReinit, ...] = ()
    samples: tuple[ScheduledSample, ...] = ()
    time_events: tuple[str, ...] = ()  # variables: the times
    checks: tuple[ScheduledCheck, ...] = ()
    n_event_checks: int = 0  # of the checks, the first ones
    asks_phase: bool = False  # whether initial() or terminal() is asked for

    @property
    def is_empty(self) -> bool:
        """Whether there is nothing but relations."""
        return not (self.assignments or self.check_assignments or self.memories or self.asks_phase)
