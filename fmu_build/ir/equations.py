"""Variables, equations, assignments and loops: what all models are made of. All are frozen."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

import sympy

from .symbols import symbol


@dataclass(frozen=True)
class EnumerationType:
    """An enumeration: its literals in order; the first is number 1."""

    name: str
    literals: tuple[str, ...]


@dataclass(frozen=True)
class Variable:
    """A scalar of the flattened model, with the attributes that Modelica gives it."""

    name: str
    description: str = ""
    unit: str = ""
    display_unit: str = ""
    quantity: str = ""
    causality: str = "local"  # local, input, output
    variability: str = "continuous"  # continuous, discrete, parameter, constant
    type: str = "Real"  # Real, Integer, Boolean, Enumeration
    enumeration: EnumerationType | None = None
    start: sympy.Expr | None = None
    has_start_of_type: bool = False  # its type declares the start value: others of an alias count more
    fixed: bool = False
    binding: sympy.Expr | None = None
    min: float | None = None
    max: float | None = None
    nominal: float | None = None
    guess: float = 0.0  # the start value as a number, where a nonlinear loop starts to look for a solution
    hidden: bool = False  # protected
    final: bool = False
    state_select: int = 0  # StateSelect: never -2, avoid -1, default 0, prefer 1, always 2
    origin: str = ""


@dataclass(frozen=True)
class Equation:
    """``residual = 0``, with the place in the Modelica source where it stands."""

    residual: sympy.Expr
    origin: str


def symbols_of(equations: Iterable[Equation]) -> set[sympy.Symbol]:
    """All that occurs in the equations."""
    return set().union(*(e.residual.free_symbols for e in equations))


@dataclass(frozen=True)
class Relation:
    """True where ``residual > 0``. A time event is true before ``until`` alone, which is constant between events."""

    residual: sympy.Expr
    text: str
    origin: str
    until: sympy.Expr | None = None


@dataclass(frozen=True)
class Assignment:
    """``target := expression``."""

    target: str
    expression: sympy.Expr
    origin: str

    @property
    def targets(self) -> tuple[str, ...]:
        """What is computed."""
        return (self.target,)

    @property
    def arguments(self) -> set[sympy.Symbol]:
        """What it is computed from."""
        return set(self.expression.free_symbols)


@dataclass(frozen=True)
class Loop:
    """Unknowns that residuals, as many, determine together; found at run time.

    A linear loop is solved by one elimination. In another one the ``explicit`` unknowns are computed, in their order,
    from the ``iterated`` ones, and Newton's method looks for these, starting from ``guesses``, a variable for each.
    """

    iterated: tuple[str, ...]
    explicit: tuple[Assignment, ...]
    residuals: tuple[Equation, ...]  # those of the explicit ones last, in their order
    slopes: dict[tuple[int, int], sympy.Expr] = field(hash=False)  # residual by unknown
    is_linear: bool
    guesses: tuple[str, ...] = ()

    @property
    def unknowns(self) -> tuple[str, ...]:
        """All that is found: the iterated ones, then the explicit ones."""
        return (*self.iterated, *(a.target for a in self.explicit))

    @property
    def targets(self) -> tuple[str, ...]:
        """What is computed."""
        return (*self.unknowns, *self.guesses)

    @property
    def arguments(self) -> set[sympy.Symbol]:
        """What it is computed from, guesses left out: they decide only where the search starts."""
        symbols = set().union(*(r.residual.free_symbols for r in self.residuals))
        return symbols - {symbol(name) for name in self.unknowns}

    @property
    def origin(self) -> str:
        """The places of its equations."""
        return ", ".join(dict.fromkeys(r.origin for r in self.residuals))


Block = Assignment | Loop


def is_free(variable: Variable) -> bool:
    """Whether it is a parameter that the initial equations determine."""
    return variable.variability == "parameter" and not variable.fixed and variable.binding is None
