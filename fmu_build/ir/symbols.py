"""Names of variables inside expressions: those of the model, and our own.

A variable is ``symbol(name)``, the time derivative of ``x`` is ``symbol(der(x))``, its value before an event
``symbol(pre(x))`` and the truth value of relation ``i`` is ``holds(i)``. Real literals are SymPy Floats of double
precision. A Boolean variable is 0 or 1, and true as a condition where it is above 0.5 (``is_true``). An enumeration is
the number of its literal, from 1.

A name of ours is a word that tells its kind, and a bracket: ``pre(x)``, ``fires{1}``. No name in Modelica begins so,
where round and curly brackets stand in quotes alone, so that none is taken for one of ours.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Set
from enum import Enum

import sympy

TIME = "time"
INITIAL = "initial()"  # Boolean variables: true while the model is initialized, and at its end
TERMINAL = "terminal()"


class Kind(Enum):
    """What a name of ours is for, with the word that it begins with."""

    DERIVATIVE = "der"
    BEFORE = "pre"
    GUESS = "guess"
    PARTIAL = "d"
    HOLDS = "holds"
    WHEN = "when"  # the condition of a when-clause
    FIRES = "fires"  # whether a branch of a when-clause is carried out
    SAMPLE = "sample"  # whether a clock ticks; its start and interval
    ROUNDED = "floor"  # what has been rounded down
    TIME_EVENT = "time_event"  # when it is
    REINIT = "reinit"  # whether it is active; its value
    CHECK = "check"  # whether it is violated


_OURS = re.compile(rf"({'|'.join(kind.value for kind in Kind)})[({{]")


def symbol(name: str) -> sympy.Symbol:
    """The SymPy symbol of the variable ``name``."""
    return sympy.Symbol(name, real=True)


def kind_of(name: str) -> Kind | None:
    """The kind of a name of ours; None for names of the model."""
    found = _OURS.match(name)
    return Kind(found.group(1)) if found else None


def numbered(kind: Kind, index: int, part: str = "") -> str:
    """Name of number ``index``, from zero, of a kind, or of a part of it: ``fires{1}``, ``reinit{1}.value``."""
    return f"{kind.value}{{{index + 1}}}{part and '.'}{part}"


def der(name: str) -> str:
    """Name of the time derivative of ``name``."""
    base, order = derivative_of(name)
    return derivative(base, order + 1)


def derivative(name: str, order: int) -> str:
    """Name of a derivative as FMI's structured naming convention writes it: ``der(x)``, ``der(x,2)``."""
    return f"der({name},{order})" if order > 1 else f"der({name})" if order else name


def derivative_of(name: str) -> tuple[str, int]:
    """The variable that ``name`` is a time derivative of, and how often it has been differentiated."""
    found = re.fullmatch(r"der\((.*?)(?:,(\d+))?\)", name)
    return (found.group(1), int(found.group(2) or 1)) if found else (name, 0)


def pre(name: str) -> str:
    """Name of the value of ``name`` just before an event."""
    return f"pre({name})"


def guess_name(name: str) -> str:
    """Name of where the search for ``name`` starts."""
    return f"guess({name})"


def partial_name(name: str, by: str) -> str:
    """Name of a partial derivative."""
    return f"d({name})/d({by})"


def shared_name(name: str, index: int) -> str:
    """Name of number ``index``, from zero, of the parts of expressions that are variables; this one belongs to
    ``name``."""
    return f"{name}#{index + 1}"


def residual_names(count: int, taken: Iterable[str]) -> list[str]:
    """Names of the residuals of ``count`` relations, none of them ``taken``. Users see them: FMI 3 lists them as event
    indicators, so they have the form of Modelica's."""
    word, taken = "relation", tuple(taken)
    while any(name.startswith(f"{word}[") for name in taken):
        word += "_"
    return [f"{word}[{i + 1}]" for i in range(count)]


def holds(index: int) -> sympy.Symbol:
    """The truth value of relation ``index``, constant between events."""
    return sympy.Symbol(f"holds{{{index}}}")


def relation_of(truth: sympy.Symbol) -> int | None:
    """The index of the relation whose truth value it is; None if it is a variable."""
    return int(truth.name.rpartition("{")[2][:-1]) if kind_of(truth.name) is Kind.HOLDS else None


def is_continuous(value: sympy.Expr, others: Set[str]) -> bool:
    """Whether a value changes in between events, by more than conditions. ``others``: variables that do not."""
    if isinstance(value, sympy.Piecewise):
        return any(is_continuous(branch, others) for branch, condition in value.args if not is_momentary(condition))
    if value.is_Symbol:
        is_derivative = kind_of(value.name) is Kind.DERIVATIVE
        return is_derivative or (kind_of(value.name) is None and value.name not in {*others, INITIAL, TERMINAL})
    return any(is_continuous(argument, others) for argument in value.args)


def is_momentary(condition: sympy.Basic) -> bool:
    """Whether a condition holds during events alone: ``edge(b)``, ``change(b)``, or one of several such ones."""
    if isinstance(condition, sympy.Or):
        return all(map(is_momentary, condition.args))
    if isinstance(condition, sympy.Ne):
        return str(condition.rhs) == pre(str(condition.lhs)) or str(condition.lhs) == pre(str(condition.rhs))
    parts = condition.args if isinstance(condition, sympy.And) else ()
    return any(
        sympy.Not(is_true(pre(name))) in parts for name in map(str, condition.free_symbols) if is_true(name) in parts
    )


def is_true(name: str) -> sympy.Expr:
    """The condition that the Boolean variable ``name`` is true."""
    return symbol(name) > sympy.Float(0.5)


def truth(condition: sympy.Expr) -> sympy.Expr:
    """1 where ``condition`` is true, else 0: what a Boolean variable is set to."""
    return sympy.Piecewise((sympy.Integer(1), condition), (sympy.Integer(0), True), evaluate=False)
