"""Constraints among states that other equations hide, such as a gear between two inertias or a rod of fixed length.

The equations that leave one of them without an unknown (Pantelides 1988) are differentiated. Where one of the states in
them follows from the others by a constant factor, it is computed from them from then on. Where none does, as in
``x^2 + y^2 = L^2``, any choice would fail somewhere: all remain states, the constraint g is imposed at the start, and
afterwards only its n-th derivative, with the others as a correction of what rounding and integration do to it
(Baumgarte 1972): the sum over k of binomial(n, k) w^(n - k) g^(k) is zero, and so is g, if it was at the start.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import networkx as nx
import sympy

from ..errors import BuildError
from ..ir.equations import Equation, Variable
from ..ir.symbols import symbol
from .constraints import follower, is_unknown, least_wanted_first, total_derivative
from .start_point import starts_fit

MAX_ROUNDS = 200
CORRECTION = 10  # w in 1/s: errors of a constraint fade within some tenths of a second


@dataclass(frozen=True)
class Reduced:
    """States, equations as many as unknowns, and what else holds at the start."""

    states: list[str]
    equations: list[Equation]
    invariants: list[Equation]
    given: list[Equation]  # fixed start values of what is no state any more


def reduce_index(
    equations: Sequence[Equation],
    differentiated: Iterable[Equation],
    states: Sequence[str],
    variables: Mapping[str, Variable],
) -> Reduced:
    """The equations with derivatives of those that tie the states; BuildError if that fails.

    The derivatives of the equations ``differentiated`` are among the equations already.
    """
    result, remaining = list(equations), list(states)
    done = {result.index(equation) for equation in differentiated}
    given: list[Equation] = []
    chains: dict[int, list[sympy.Expr]] = {}  # of constraints that only hold by their derivatives: what these are of
    for _ in range(MAX_ROUNDS):
        singular = _singular_set(result, set(remaining), variables)
        if singular is None:
            return _corrected(result, remaining, chains, given)
        first = result[singular[0]]
        tied = [n for n in remaining if any(symbol(n) in result[i].residual.free_symbols for i in singular)]
        if not tied or done >= set(singular):
            raise BuildError(
                f"{first.origin}: this equation determines nothing that is not determined already"
                " (one equation too many, or a constraint that takes more than differentiating equations)"
            )
        before = [result[i] for i in singular]
        candidates = least_wanted_first(tied, {n for n in tied if variables[n].fixed}, variables)
        demoted = None if chains.keys() & set(singular) else follower(candidates, before, variables)
        kept = None
        if demoted is None:
            kept = min((i for i in singular if i not in done), key=lambda i: i not in chains)
        for i in singular:
            derivative = Equation(total_derivative(result[i], variables), result[i].origin)
            if i == kept:
                chains.setdefault(i, []).append(result[i].residual)
                result[i] = derivative
            elif i not in done:
                result.append(derivative)
                done.add(i)
        if demoted is not None:
            remaining.remove(demoted)
            given += _given(variables[demoted], before, tied, variables)
    raise BuildError(f"{first.origin}: this constraint takes too many differentiations: index reduction gives up here")


def _corrected(
    equations: list[Equation], states: list[str], chains: Mapping[int, list[sympy.Expr]], given: list[Equation]
) -> Reduced:
    invariants = []
    for index, chain in chains.items():
        origin = equations[index].origin
        invariants += [Equation(residual, origin) for residual in chain]
        n = len(chain)
        corrections = [sympy.binomial(n, k) * CORRECTION ** (n - k) * residual for k, residual in enumerate(chain)]
        equations[index] = Equation(sympy.Add(equations[index].residual, *corrections), origin)
    return Reduced(states, equations, invariants, given)


def _singular_set(equations: list[Equation], states: set[str], variables: Mapping[str, Variable]) -> list[int] | None:
    """Equations, one more than their unknowns, the one that is left over first; None if there are none."""
    graph = nx.Graph()
    unknowns = [
        {s.name for s in e.residual.free_symbols if s.name not in states and is_unknown(s.name, variables)}
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


def _given(
    demoted: Variable, equations: list[Equation], tied: list[str], variables: Mapping[str, Variable]
) -> list[Equation]:
    """What a fixed start value says of the states that are left; nothing where it follows from theirs."""
    if not demoted.fixed or starts_fit(equations, tied, variables):
        return []
    start = sympy.Integer(0) if demoted.start is None else demoted.start
    return [Equation(symbol(demoted.name) - start, demoted.origin)]
