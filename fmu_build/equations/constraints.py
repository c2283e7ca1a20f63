"""What an equation among states says: which of them follows from the others, and how they move together."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence, Set

import sympy

from ..errors import BuildError
from ..ir.equations import Equation, Variable
from ..ir.symbols import TIME, der, derivative_of, symbol


def is_unknown(name: str, variables: Mapping[str, Variable]) -> bool:
    """Whether it changes in time by the equations: a continuous variable but an input, or a derivative of one."""
    variable = variables.get(derivative_of(name)[0])
    return variable is not None and variable.variability == "continuous" and variable.causality != "input"


def least_wanted_first(names: Iterable[str], fixed: Set[str], variables: Mapping[str, Variable]) -> list[str]:
    """Candidates for being computed from the others: those that nobody prefers, with a start value that is not
    ``fixed``, then with none; of equals the last one declared."""
    place = {name: position for position, name in enumerate(variables)}

    def wanted(name: str) -> tuple[int, bool, bool, int]:
        v = variables[name]
        return (v.state_select, name in fixed, v.start is not None, -place[name])

    return sorted(names, key=wanted)


def follower(candidates: Iterable[str], equations: Sequence[Equation], variables: Mapping[str, Variable]) -> str | None:
    """The first state that the others give by factors that are constant in all of the equations; None if none is."""

    def varies(factor: sympy.Expr) -> bool:
        return any(s.name == TIME or is_unknown(s.name, variables) for s in factor.free_symbols)

    return next((n for n in candidates if not any(varies(e.residual.diff(symbol(n))) for e in equations)), None)


def total_derivative(equation: Equation, variables: Mapping[str, Variable]) -> sympy.Expr:
    """The derivative of the residual by time, in derivatives of what varies; BuildError where that is an input."""
    residual = equation.residual
    terms = [residual.diff(symbol(TIME))]
    for s in sorted(residual.free_symbols, key=str):
        if s.name in variables and variables[s.name].causality == "input":
            raise BuildError(f"{equation.origin}: this needs the time derivative of the input {s.name}: not supported")
        if is_unknown(s.name, variables):
            terms.append(residual.diff(s) * symbol(der(s.name)))
    return sympy.Add(*terms)
