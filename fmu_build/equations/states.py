"""Which differentiated variables are states, and which follow from those by an equation among them alone.

A variable that is differentiated is a state, unless an equation ties it to other states alone, as
``compression = x_t - x_c`` does. Then one of them, that with the least stateSelect, is computed from the others, and
one more derivative follows from the total time derivative of that equation. A fixed start value of the one that is
computed is passed on to one whose start value is free. (index_reduction.py finds what several equations hide together.)
"""

from __future__ import annotations

from collections.abc import Mapping

import sympy

from ..errors import BuildError
from ..ir.equations import Equation, Variable, symbols_of
from ..ir.symbols import der, symbol
from .constraints import follower, least_wanted_first, total_derivative
from .start_point import starts_fit


def choose_states(
    equations: list[Equation], algebraics: list[str], variables: Mapping[str, Variable]
) -> tuple[tuple[str, ...], list[Equation], dict[str, sympy.Expr], list[Equation]]:
    """The states, the equations with those that are added, the start values of the states, and what was
    differentiated."""
    differentiated: list[Equation] = []
    present = symbols_of(equations)
    states = [n for n in algebraics if symbol(der(n)) in present]
    starts = {n: sympy.Integer(0) if (start := variables[n].start) is None else start for n in states}
    fixed = {n for n in states if variables[n].fixed}
    names, rates = {symbol(n) for n in algebraics}, {symbol(der(n)) for n in algebraics}
    result = list(equations)
    for equation in equations:
        symbols = equation.residual.free_symbols
        tied = {s.name for s in symbols & names}
        if not tied or symbols & rates or not tied <= set(states):
            continue
        candidates = least_wanted_first(tied, fixed, variables)
        demoted = follower(candidates, [equation], variables)
        if demoted is None:
            continue  # reduce_index() keeps all of them
        if demoted in fixed:
            free = next((n for n in reversed(candidates) if n not in fixed), None)
            if free is not None:
                starts[free] = _start_from_others(equation, free, starts)
                fixed.add(free)
            elif not starts_fit([equation], candidates, variables):
                raise BuildError(
                    f"{equation.origin}: this equation ties the states {', '.join(candidates)} to each other, and their"
                    " fixed start values contradict it: drop fixed=true from the one that follows from the others"
                )
        states.remove(demoted)
        differentiated.append(equation)
        result.append(Equation(_rate_from_others(equation, demoted, variables), equation.origin))
    return tuple(states), result, starts, differentiated


def _start_from_others(equation: Equation, name: str, starts: Mapping[str, sympy.Expr]) -> sympy.Expr:
    """The start value that the equation, linear in ``name``, gives it where the others have theirs."""
    slope = equation.residual.diff(symbol(name))
    solution = -equation.residual.xreplace({symbol(name): sympy.Integer(0)}) / slope
    return solution.xreplace({symbol(n): start for n, start in starts.items() if n != name})


def _rate_from_others(equation: Equation, name: str, variables: Mapping[str, Variable]) -> sympy.Expr:
    """der(name) less what the chain rule makes of it."""
    rate, slope = symbol(der(name)), equation.residual.diff(symbol(name))
    return rate + (total_derivative(equation, variables) - slope * rate) / slope
