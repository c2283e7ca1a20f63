"""Modelica's built-in functions that are conditionals in disguise: abs, min, sign and their like.

Each is told how to ask whether a residual is positive, so that the reader of expressions decides what is an event.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import sympy
from sympy.logic.boolalg import Boolean

from .values import ONE, ZERO, Value, each, elements

Holds = Callable[[sympy.Expr], Boolean]  # whether a residual is positive


def _either(value: sympy.Expr, truth: Boolean, otherwise: sympy.Expr) -> sympy.Expr:
    return sympy.Piecewise((value, truth), (otherwise, True), evaluate=False)


def _largest(holds: Holds, *operands: Value) -> sympy.Expr:
    """max(a, b) is a where a - b > 0."""
    first, *others = elements(tuple(operands))
    for other in others:
        first = _either(first, holds(first - other), other)
    return first


def _smallest(holds: Holds, *operands: Value) -> sympy.Expr:
    first, *others = elements(tuple(operands))
    for other in others:
        first = _either(first, holds(other - first), other)
    return first


def _absolute(holds: Holds, operand: sympy.Expr) -> sympy.Expr:
    return _either(-operand, holds(-operand), operand)


def _sign(holds: Holds, operand: sympy.Expr) -> sympy.Expr:
    return _either(ONE, holds(operand), _either(-ONE, holds(-operand), ZERO))


# Conditionals in the guise of functions.
CHOICES: Mapping[str, Callable[..., Value]] = {
    "Abs": lambda holds, a: each(lambda x: _absolute(holds, x), a),
    "Sign": lambda holds, a: each(lambda x: _sign(holds, x), a),
    "Min": _smallest,
    "Max": _largest,
    "SemiLinear": lambda holds, x, above, below: _either(below * x, holds(-x), above * x),
}
