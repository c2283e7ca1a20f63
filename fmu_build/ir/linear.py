"""Equations that are linear in an unknown: its slope, and what is left without it."""

from __future__ import annotations

from collections.abc import Sequence, Set

import sympy

from .equations import Equation
from .functions import round_down
from .symbols import symbol

ZERO = sympy.Integer(0)


def slope(equation: Equation, unknown: str) -> sympy.Expr | None:
    """The slope of the residual, if it is linear in ``unknown``."""
    s = symbol(unknown)
    result = equation.residual.diff(s)
    return None if result.has(s) or s in switching_symbols(equation.residual) else result


def slopes_by(expression: sympy.Expr, unknowns: Set[sympy.Symbol]) -> dict[sympy.Symbol, sympy.Expr]:
    """The derivatives by those unknowns that occur, term by term: SymPy's own look at every term for each unknown."""
    terms: dict[sympy.Symbol, list[sympy.Expr]] = {}
    for term in sympy.Add.make_args(expression):
        for s in term.free_symbols & unknowns:
            terms.setdefault(s, []).append(term.diff(s))
    return {s: sympy.Add(*slopes) for s, slopes in terms.items()}


def rest(equation: Equation, unknowns: Sequence[str]) -> sympy.Expr:
    """The residual where the unknowns are zero."""
    return equation.residual.xreplace({symbol(name): ZERO for name in unknowns})


def switching_symbols(expression: sympy.Expr) -> set[sympy.Symbol]:
    """What an expression depends on by conditions or rounding, which its derivative does not tell."""
    conditions = (condition for p in expression.atoms(sympy.Piecewise) for _, condition in p.args)
    parts = (*conditions, *expression.atoms(round_down))
    return set().union(*(part.free_symbols for part in parts if part not in (sympy.true, sympy.false)))
