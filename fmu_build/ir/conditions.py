"""Comparisons, and values put into them, without conditional expressions inside conditions.

SymPy rewrites a condition that has a Piecewise in it, and drops branches in doing so: of ``(-b if h else b) <= 1`` it
makes ``b >= -1``. Here such a comparison becomes ``h and -b <= 1 or not h and b <= 1`` before SymPy sees it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import sympy
from sympy.core.relational import Relational
from sympy.logic.boolalg import Boolean


def compare(operation: Callable[[sympy.Expr, sympy.Expr], Boolean], left: sympy.Expr, right: sympy.Expr) -> Boolean:
    """``operation`` (sympy.Gt, sympy.Eq, ...) of two values."""
    choice = _choice(left) or _choice(right)
    if choice is None:
        return operation(left, right)
    result: Boolean = sympy.false
    for value, condition in reversed(choice.args):
        taken = compare(operation, insert(left, {choice: value}), insert(right, {choice: value}))
        result = sympy.Or(sympy.And(condition, taken), sympy.And(sympy.Not(condition), result))
    return result


def insert(expression: sympy.Basic, values: Mapping[sympy.Basic, sympy.Basic]) -> sympy.Basic:
    """The expression or condition with values in place of symbols."""
    if expression in values:
        return values[expression]
    if not values or not expression.args:
        return expression
    if isinstance(expression, sympy.Piecewise):
        pairs = [(insert(value, values), insert(condition, values)) for value, condition in expression.args]
        return sympy.Piecewise(*pairs, evaluate=False)
    arguments = [insert(argument, values) for argument in expression.args]
    if all(new is old for new, old in zip(arguments, expression.args, strict=True)):
        return expression
    if isinstance(expression, Relational):
        return compare(expression.func, *arguments)
    return expression.func(*arguments)


def _choice(expression: sympy.Expr) -> sympy.Piecewise | None:
    """The first conditional expression in it, one that is inside no other."""
    if isinstance(expression, sympy.Piecewise):
        return expression
    return next((found for argument in expression.args if (found := _choice(argument)) is not None), None)
