"""The declared start values as a point, and what the slopes of equations there tell.

Which states keep their start values, and which follow from a constraint, has to be chosen: of a pendulum that starts
level, ``x^2 + y^2 = L^2`` gives x from y, and not y from x.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from graphlib import CycleError, TopologicalSorter

import numpy as np
import sympy
from numpy.typing import NDArray

from ..ir.equations import Equation, Variable, symbols_of
from ..ir.symbols import TIME, symbol

TOLERANCE = 1e-6  # of equations that start values should meet
RANK = 1e-9  # singular values below this share of the largest are zero
UNDECLARED = 0.1  # weight of a state without a start value: such a one should rather follow from the others


def value_at_start(expression: sympy.Expr, variables: Iterable[Variable]) -> float | None:
    """The value with all start values and parameters as declared; None where it contains anything else."""
    value = expression.xreplace(_point(expression.free_symbols, {v.name: v for v in variables}))
    return float(value) if value.is_number and value.is_finite else None


def starts_fit(equations: Sequence[Equation], states: Iterable[str], variables: Mapping[str, Variable]) -> bool:
    """Whether the equations, linear in what is no state, have a solution with the start values of the states as they
    are, as where all are zero."""
    kept = {*states, *(name for name, v in variables.items() if v.variability == "parameter")}
    point = _point((s for s in symbols_of(equations) if s.name in kept), variables) | {symbol(TIME): sympy.Integer(0)}
    residuals = [equation.residual.xreplace(point) for equation in equations]
    unknowns = sorted(set().union(*(r.free_symbols for r in residuals)), key=str)
    slopes = [[r.diff(s) for s in unknowns] for r in residuals]
    values = [r.xreplace(dict.fromkeys(unknowns, sympy.Integer(0))) for r in residuals]
    if not all(x.is_number and x.is_finite for row in (*slopes, values) for x in row):
        return False
    matrix = np.array(slopes, float).reshape(len(residuals), len(unknowns))
    offsets = np.array(values, float)
    solution = np.linalg.lstsq(matrix, -offsets, rcond=None)[0]
    return bool(np.abs(matrix @ solution + offsets).max() < TOLERANCE)


def free_coordinates(
    states: Sequence[str], equations: Sequence[Equation], unknowns: Sequence[str], variables: Mapping[str, Variable]
) -> list[str]:
    """The states, first those that the equations leave free at the start, best determined by their slopes there."""
    slopes = _slopes(equations, unknowns, _point(symbols_of(equations), variables))
    _, singular_values, directions = np.linalg.svd(slopes)
    rank = int((singular_values > RANK * singular_values.max(initial=0.0)).sum())
    weights = [1.0 if variables[name].start is not None else UNDECLARED for name in states]
    motions = directions[rank:, [list(unknowns).index(name) for name in states]] * weights
    if motions.size == 0:
        return list(states)
    from scipy.linalg import qr  # here, because it takes a quarter of a second, and few models need it

    _, order = qr(motions, mode="r", pivoting=True)
    return [states[i] for i in order]


def _slopes(
    equations: Sequence[Equation], unknowns: Sequence[str], point: Mapping[sympy.Symbol, sympy.Expr]
) -> NDArray[np.float64]:
    """Partial derivatives, 1 where they are no numbers."""
    columns = {symbol(name): column for column, name in enumerate(unknowns)}
    slopes = np.zeros((len(equations), len(unknowns)))
    for row, equation in enumerate(equations):
        for s in equation.residual.free_symbols & columns.keys():
            value = equation.residual.diff(s).xreplace({**dict.fromkeys(columns, sympy.Integer(0)), **point})
            slopes[row, columns[s]] = float(value) if value.is_number and value.is_finite else 1.0
    return slopes


def _point(symbols: Iterable[sympy.Symbol], variables: Mapping[str, Variable]) -> dict[sympy.Symbol, sympy.Expr]:
    """Start values of variables and values of parameters, as far as they follow as numbers.

    Numbers alone are put in, in the order in which they follow: nested conditional expressions, put into each other as
    they are, grow exponentially.
    """
    declared: dict[sympy.Symbol, sympy.Expr] = {}
    waiting = list(symbols)
    while waiting:
        s = waiting.pop()
        value = None if s in declared else _declared(variables.get(s.name))
        if value is not None:
            declared[s] = value
            waiting += value.free_symbols
    order = TopologicalSorter({s: value.free_symbols for s, value in declared.items()})
    point: dict[sympy.Symbol, sympy.Expr] = {}
    with suppress(CycleError):  # what is outside the cycle follows all the same
        order.prepare()
    while order.is_active():
        for s in order.get_ready():
            value = declared[s].xreplace(point) if s in declared else s
            if value.is_number:
                point[s] = value
            order.done(s)
    return point


def _declared(variable: Variable | None) -> sympy.Expr | None:
    """What a declaration says of the value at the start."""
    if variable is None or variable.variability not in {"continuous", "parameter"}:
        return None
    if variable.variability == "continuous":
        return sympy.Float(variable.guess)
    value = variable.start if variable.binding is None else variable.binding
    return sympy.Integer(0) if value is None else value
