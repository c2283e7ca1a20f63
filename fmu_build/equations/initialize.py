"""The values at the start: initial equations, and start values where they leave something open.

With initial equations the states, and parameters with fixed=false, are unknowns, together with all that is computed
from them, parameters bound to such parameters too. Fixed start values are equations too. Where that is not enough,
other start values are taken, in the order of the declarations, wherever they determine something.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import networkx as nx
import sympy

from ..errors import BuildError
from ..ir.equations import Assignment, Equation, Variable, is_free
from ..ir.models import EquationSystem
from ..ir.symbols import pre, symbol
from .start_point import TOLERANCE, free_coordinates, value_at_start


def initialize(system: EquationSystem) -> EquationSystem:
    """The system with as many initial equations as unknowns at the start; none where start values say it all."""
    variables = {v.name: v for v in system.model.variables}
    free = tuple(v.name for v in variables.values() if is_free(v) and v.name not in system.aliases)
    following = _following(free, system.bound_parameters)
    discrete, continuous = _split(system, variables)
    before = {a.target: a for a in (*system.starts_before, *discrete.values())}
    system = replace(
        system,
        starts_before=tuple(before.values()),
        free_parameters=(*free, *following),
        bound_parameters={n: e for n, e in system.bound_parameters.items() if n not in following},
    )
    if not continuous and not free and not system.invariants:
        return replace(system, initial_equations=())
    unknowns = (*system.unknowns, *system.states, *system.free_parameters)
    fixed = [_start(n, system, variables) for n in system.states if variables[n].fixed]
    open_ = [n for n in (*system.states, *free) if not variables[n].fixed]
    open_.sort(key=lambda n: variables[n].start is None)  # a declared start value is a better guess than zero
    required = [*system.equations, *following.values(), *continuous, *fixed]
    if system.invariants:
        open_ = free_coordinates(open_, [*required, *system.invariants], unknowns, variables)
    guesses = [_start(name, system, variables) for name in open_]
    equations = _complete(required, [*system.invariants, *guesses], unknowns)
    _refuse_contradictions([e for e in system.invariants if e not in equations], [*fixed, *continuous], system)
    return replace(system, initial_equations=tuple(equations), initial_unknowns=unknowns)


def _following(free: tuple[str, ...], bound: Mapping[str, Equation]) -> dict[str, Equation]:
    """The parameters bound to expressions of those that initial equations determine, directly or not."""
    edges = [(s.name, name) for name, equation in bound.items() for s in equation.residual.free_symbols]
    graph = nx.DiGraph(edges)
    graph.add_nodes_from(free)
    reached = set().union(*(nx.descendants(graph, name) for name in free))
    return {name: equation for name, equation in bound.items() if name in reached}


def _refuse_contradictions(dropped: list[Equation], at_start: list[Equation], system: EquationSystem) -> None:
    """Constraints for which fixed start values and initial equations leave nothing to determine must be true with them,
    as far as these say it one after another."""
    values = _said(at_start, system)
    states = {symbol(name) for name in system.states}
    for equation in dropped:
        residual = equation.residual.xreplace(values)
        error = None if residual.free_symbols & states else value_at_start(residual, system.model.variables)
        if error is not None and abs(error) > TOLERANCE:
            raise BuildError(
                f"{equation.origin}: the fixed start values contradict this equation, by {error:g}: drop fixed=true, or"
                " the initial equation, of the one that follows from the others"
            )


def _said(equations: list[Equation], system: EquationSystem) -> dict[sympy.Symbol, sympy.Expr]:
    """The values of the states that equations give by themselves, or once others have one."""
    states = {symbol(name) for name in system.states}
    values: dict[sympy.Symbol, sympy.Expr] = {}
    for _ in equations:
        for equation in equations:
            residual = equation.residual.xreplace(values)
            unknown = [s for s in residual.free_symbols & states if residual.diff(s).is_number]
            if len(residual.free_symbols & states) == len(unknown) == 1:
                (state,) = unknown
                values[state] = -residual.xreplace({state: sympy.Integer(0)}) / residual.diff(state)
    return values


def _split(system: EquationSystem, variables: dict[str, Variable]) -> tuple[dict[str, Assignment], list[Equation]]:
    """Initial equations that give a discrete variable its value before the start, and the others."""
    discrete: dict[str, Assignment] = {}
    continuous = []
    names = [v.name for v in variables.values() if v.variability == "discrete"]
    targets = {symbol(text): name for name in names for text in (name, pre(name))}
    for equation in system.initial_equations:
        found = sorted(equation.residual.free_symbols & targets.keys(), key=str)
        one = next((s for s in found if abs(equation.residual.diff(s)) == 1), None)
        if one is None or targets[one] in discrete:
            continuous.append(equation)
            continue
        value = -equation.residual.xreplace({one: sympy.Integer(0)}) / equation.residual.diff(one)
        before = {symbol(name): symbol(pre(name)) for name in names}
        discrete[targets[one]] = Assignment(pre(targets[one]), value.xreplace(before), equation.origin)
    return discrete, continuous


def _start(name: str, system: EquationSystem, variables: dict[str, Variable]) -> Equation:
    own = variables[name].start
    start = system.starts.get(name, sympy.Integer(0) if own is None else own)
    return Equation(symbol(name) - start, variables[name].origin)


def _complete(equations: list[Equation], guesses: list[Equation], unknowns: tuple[str, ...]) -> list[Equation]:
    """The equations with those guesses that it takes to determine every unknown."""
    names = {symbol(name) for name in unknowns}
    graph = nx.Graph()
    graph.add_nodes_from(unknowns)
    for index, equation in enumerate([*equations, *guesses]):
        graph.add_edges_from((index, s.name) for s in sorted(equation.residual.free_symbols & names, key=str))
    chosen = list(range(len(equations)))
    size = _matched(graph, unknowns, chosen)
    if size < len(equations):
        matching = nx.bipartite.hopcroft_karp_matching(graph.subgraph([*unknowns, *chosen]), top_nodes=unknowns)
        left = next(i for i in chosen if i not in matching)
        raise BuildError(
            f"{equations[left].origin}: with this equation there are more equations at the start than it has unknowns:"
            " drop it, or fixed=true of a state"
        )
    for index in range(len(equations), len(equations) + len(guesses)):
        if size == len(unknowns):
            break
        if _matched(graph, unknowns, [*chosen, index]) > size:
            chosen.append(index)
            size += 1
    return [[*equations, *guesses][index] for index in chosen]


def _matched(graph: nx.Graph, unknowns: tuple[str, ...], chosen: list[int]) -> int:
    """How many of the chosen equations have an unknown of their own."""
    part = graph.subgraph([*unknowns, *chosen])
    return len(nx.bipartite.hopcroft_karp_matching(part, top_nodes=unknowns)) // 2
