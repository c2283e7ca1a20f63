"""Algebraic loops: equations that determine their unknowns together.

A nonlinear loop is torn: as many unknowns as a greedy choice finds are computed one after the other from the rest, the
iterated ones, so that only these need a good guess. The matrix of Newton's method is that of the whole loop; as the
residuals of the computed unknowns are zero, its steps are those of the torn system.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import networkx as nx
import numpy as np

from ..ir.equations import Assignment, Equation, Loop, Variable
from ..ir.linear import ZERO, rest, slope, slopes_by, switching_symbols
from ..ir.symbols import guess_name, symbol


def make_loop(names: Sequence[str], matched: Mapping[str, Equation]) -> Loop:
    """The loop of the unknowns ``names``, each with the equation that it is matched with."""
    equations = [matched[name] for name in names]
    unknowns = {symbol(name) for name in names}
    slopes_of = {e.residual: slopes_by(e.residual, unknowns) for e in equations}
    is_linear = not any(
        unknowns & switching_symbols(residual) or any(unknowns & value.free_symbols for value in values.values())
        for residual, values in slopes_of.items()
    )
    if not is_linear:
        names, matched = _rematch(names, equations)
    explicit = [] if is_linear else _tear(names, matched)
    taken = {a.target for a in explicit}
    iterated = [name for name in names if name not in taken]
    order = [*iterated, *(a.target for a in explicit)]
    residuals = [matched[name] for name in order]
    slopes = {
        (row, column): value
        for row, e in enumerate(residuals)
        for column, name in enumerate(order)
        if (value := slopes_of[e.residual].get(symbol(name), ZERO)) != 0
    }
    guesses = () if is_linear else tuple(guess_name(name) for name in iterated)
    return Loop(tuple(iterated), tuple(explicit), tuple(residuals), slopes, is_linear, guesses)


def guess_variables(loop: Loop, variables: Mapping[str, Variable]) -> dict[str, Variable]:
    """The guesses as variables: they are kept from one solution to the next."""
    return {
        guess: Variable(guess, f"Where the search for {name} starts", variables[name].unit, hidden=True)
        for guess, name in zip(loop.guesses, loop.iterated, strict=False)
    }


def _rematch(names: Sequence[str], equations: Sequence[Equation]) -> tuple[list[str], dict[str, Equation]]:
    """For each unknown an equation of its own, as often as possible one that gives it by a slope that is a number.

    Unknowns that stand in nonlinear terms come last: it is those that Newton's method should look for. (Of a diode the
    voltage: the current follows from it by an exponential, and a search for the current would have to invert that.)
    """
    from scipy.optimize import linear_sum_assignment  # here, because it takes a quarter of a second

    slopes = [{s.name: e.residual.diff(s) for s in e.residual.free_symbols} for e in equations]
    bent = {name for row in slopes for name, value in row.items() if value.has(symbol(name))}
    cost = np.full((len(equations), len(names)), 1e6)
    for row, equation in enumerate(equations):
        for column, name in enumerate(names):
            if name in slopes[row]:
                value = slope(equation, name)
                is_easy = value is not None and value.is_number and value != 0
                cost[row, column] = (0.5 if name in bent else 0.0) if is_easy else 1.0
    rows, columns = linear_sum_assignment(cost)
    matched = {names[column]: equations[row] for row, column in zip(rows, columns, strict=True)}
    return sorted(names, key=lambda name: name in bent), matched


def _tear(names: Sequence[str], matched: Mapping[str, Equation]) -> list[Assignment]:
    """Unknowns that their equations, with a slope that is a number, give without a cycle, in order of computation."""
    needs = nx.DiGraph()
    found: dict[str, Assignment] = {}
    for name in names:
        equation = matched[name]
        value = slope(equation, name)
        if value is None or not value.is_number or value == 0:
            continue
        needed = {s.name for s in equation.residual.free_symbols} & set(names) - {name}
        edges = [(other, name) for other in needed]
        needs.add_edges_from(edges)
        torn_out = needs.subgraph({*found, name})
        if nx.is_directed_acyclic_graph(torn_out):
            found[name] = Assignment(name, -rest(equation, [name]) / value, equation.origin)
    order = nx.topological_sort(needs.subgraph(found)) if found else ()
    alone = [name for name in found if name not in needs]
    return [found[name] for name in (*alone, *order)]
