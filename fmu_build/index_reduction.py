"""Constraints among states that other equations hide, such as a gear between two inertias.

The equations that leave one of them without an unknown (Pantelides 1988) are differentiated, and one of the states in
them is computed from the others from then on. Which one is decided here once and for all.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import networkx as nx
import sympy

from .errors import BuildError
from .ir_equations import Equation, Variable
from .symbols import TIME, der, symbol

MAX_ROUNDS = 200


def reduce_index(
    equations: Sequence[Equation],
    differentiated: Iterable[Equation],
    states: Sequence[str],
    variables: Mapping[str, Variable],
) -> tuple[list[str], list[Equation]]:
    """The states that are left, and the equations with derivatives of those that tie them; BuildError if that fails.

    The derivatives of the equations ``differentiated`` are among the equations already.
    """
    result, remaining = list(equations), list(states)
    done = {result.index(equation) for equation in differentiated}
    for _ in range(MAX_ROUNDS):
        singular = _singular_set(result, set(remaining), variables)
        if singular is None:
            return remaining, result
        first = result[singular[0]]
        tied = [n for n in remaining if any(symbol(n) in result[i].residual.free_symbols for i in singular)]
        if not tied or done >= set(singular):
            raise BuildError(
                f"{first.origin}: this equation determines nothing that is not determined already"
                " (one equation too many, or a constraint that takes more than differentiating equations)"
            )
        remaining.remove(_demoted(tied, [result[i] for i in singular], variables))
        new = [result[i] for i in singular if i not in done]
        result += [Equation(_total_derivative(equation, variables), equation.origin) for equation in new]
        done |= set(singular)
    raise BuildError(f"{first.origin}: this constraint takes too many differentiations: index reduction gives up here")


def _singular_set(equations: list[Equation], states: set[str], variables: Mapping[str, Variable]) -> list[int] | None:
    """Equations, one more than their unknowns, the one that is left over first; None if there are none."""
    graph = nx.Graph()
    unknowns = [
        {s.name for s in e.residual.free_symbols if s.name not in states and _is_unknown(s.name, variables)}
        for e in equations
    ]
    graph.add_nodes_from(range(len(equations)))
    graph.add_edges_from((i, name) for i, names in enumerate(unknowns) for name in sorted(names))
    matching = nx.bipartite.hopcroft_karp_matching(graph, top_nodes=range(len(equations)))
    left = next((i for i in range(len(equations)) if i not in matching), None)
    if left is None:
        return None
    found, stack = [left], [left]
    while stack:
        for name in sorted(unknowns[stack.pop()]):
            other = matching[name]
            if other not in found:
                found.append(other)
                stack.append(other)
    return found


def _is_unknown(name: str, variables: Mapping[str, Variable]) -> bool:
    while name.startswith("der("):
        name = name[4:-1]
    return name in variables and variables[name].variability == "continuous" and variables[name].causality != "input"


def _demoted(tied: list[str], equations: list[Equation], variables: Mapping[str, Variable]) -> str:
    """The state that the others will give: one that nobody prefers, with a start value that is not fixed."""

    def wanted(name: str) -> tuple[int, bool, bool, int]:
        v = variables[name]
        return (v.state_select, v.fixed, v.start is not None, -tied.index(name))

    best = min(tied, key=wanted)
    if variables[best].fixed and not _starts_fit(equations, variables):
        raise BuildError(
            f"{equations[0].origin}: this equation ties the states {', '.join(tied)} to each other, and each has a"
            " fixed start value: drop fixed=true from the one that follows from the others"
        )
    return best


def _starts_fit(equations: list[Equation], variables: Mapping[str, Variable]) -> bool:
    """Whether all are true with the start values as they are, as where all are zero."""
    for equation in equations:
        symbols = equation.residual.free_symbols
        value = equation.residual.xreplace(
            {s: sympy.Float(variables[s.name].guess) for s in symbols if s.name in variables}
        )
        if value.is_number and abs(value) > 1e-9:
            return False
    return True


def _total_derivative(equation: Equation, variables: Mapping[str, Variable]) -> sympy.Expr:
    """The derivative by time, in derivatives of what varies."""
    residual = equation.residual
    terms = [residual.diff(symbol(TIME))]
    for s in sorted(residual.free_symbols, key=str):
        if s.name in variables and variables[s.name].causality == "input":
            raise BuildError(f"{equation.origin}: this needs the time derivative of the input {s.name}: not supported")
        if _is_unknown(s.name, variables):
            terms.append(residual.diff(s) * symbol(der(s.name)))
    return sympy.Add(*terms)
