"""An EquationSystem to a SortedModel: which equation gives which unknown, and in which order.

Matching (Hopcroft and Karp 1973), then the strongly connected components of the dependencies (Tarjan 1972): each is a
block that must be solved together. A block of one equation that is linear in its unknown is solved for it here; what
is left are loops (see loops.py), which are solved at run time.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TypeGuard

import networkx as nx
import sympy

from ..errors import BuildError
from ..ir.dependencies import reaching
from ..ir.equations import Assignment, Block, Equation, Loop, Relation, Variable
from ..ir.linear import rest, slope
from ..ir.models import EquationSystem, SortedModel
from ..ir.symbols import INITIAL, TERMINAL, Kind, derivative, derivative_of, kind_of, residual_names, symbol
from ..ir.units import per_second
from .loops import guess_variables, make_loop
from .schedule import Scheduled, schedule


def sort(system: EquationSystem) -> SortedModel:
    """The sorted model; BuildError where unknowns cannot be computed one after another."""
    model = system.model
    variables = _with_derivatives(system)
    solved = _blocks(list(system.equations), list(system.unknowns))
    events = schedule(system, solved)
    variables |= _for_events(events, variables)
    names = residual_names(len(system.relations), variables)
    residuals = [
        Assignment(name, residual, relation.origin)
        for name, residual, relation in zip(names, events.residuals, system.relations, strict=True)
    ]
    starts = _starts(system)
    variables |= {
        r.target: _residual_variable(r, relation, variables)
        for r, relation in zip(residuals, system.relations, strict=True)
    }
    loops = [block for block in (*solved, *starts) if isinstance(block, Loop)]
    guesses = {
        guess: variables[name].guess for loop in loops for guess, name in zip(loop.guesses, loop.iterated, strict=False)
    }
    for loop in loops:
        variables |= guess_variables(loop, variables)
    return SortedModel(
        name=model.name,
        description=model.description,
        experiment=model.experiment,
        variables=variables,
        states=system.states,
        inputs=system.inputs,
        parameters=system.parameters,
        parameter_assignments=_parameter_assignments(system),
        start_assignments=tuple(block for block in starts if not _is_start_value(block, system)),
        start_values={a.target: float(a.expression) for a in starts if _is_start_value(a, system)} | guesses,
        assignments=(*solved, *residuals, *_copies(system, variables)),
        relations=system.relations,
        residuals=tuple(names),
        free_parameters=system.free_parameters,
        schedule=events.schedule,
    )


def _for_events(events: Scheduled, variables: dict[str, Variable]) -> dict[str, Variable]:
    """The variables that events bring along."""
    if events.schedule.is_empty:
        return {}
    own = {v.name: v for v in events.variables}
    for memory in events.schedule.memories:
        of = variables[memory.name]
        own[memory.before] = replace(of, name=memory.before, hidden=True, causality="local", variability="discrete")
    flags = [Variable(name, type="Boolean", variability="discrete", hidden=True) for name in (INITIAL, TERMINAL)]
    return own | {flag.name: flag for flag in flags}


def _starts(system: EquationSystem) -> tuple[Block, ...]:
    """What states, free parameters and discrete variables before the start are set to, and what that takes."""
    origins = {v.name: v.origin for v in system.model.variables}
    if system.initial_unknowns:
        ordered = _blocks(list(system.initial_equations), list(system.initial_unknowns))
        known = [block for block in ordered if _is_start_value(block, system)]
        others = [block for block in ordered if not any(block is one for one in known)]
        wanted = {*system.states, *system.free_parameters} - {a.target for a in known}
        continuous: tuple[Block, ...] = (*known, *reaching({symbol(name) for name in wanted}, others))
    else:
        continuous = tuple(Assignment(state, start, origins[state]) for state, start in system.starts.items())
    return (*continuous, *system.starts_before)


def _is_start_value(block: Block, system: EquationSystem) -> TypeGuard[Assignment]:
    """Whether it is a number that can be set instead, or that a discrete variable has before the start."""
    if isinstance(block, Loop):
        return False
    is_kept = block.target in system.states or kind_of(block.target) is Kind.BEFORE
    return bool(is_kept and block.expression.is_number)


def _parameter_assignments(system: EquationSystem) -> tuple[Assignment, ...]:
    bound = system.bound_parameters
    result: list[Assignment] = []
    for block in _blocks(list(bound.values()), list(bound)):
        if isinstance(block, Loop):
            raise BuildError(f"{block.origin}: the parameters {', '.join(block.unknowns)} depend on each other")
        result.append(block)
    return tuple(result)


def _with_derivatives(system: EquationSystem) -> dict[str, Variable]:
    variables = {v.name: v for v in system.model.variables}
    for unknown in sorted(system.unknowns, key=lambda name: derivative_of(name)[1]):
        if unknown not in variables:
            base, order = derivative_of(unknown)
            of = variables[derivative(base, order - 1)]
            variables[unknown] = Variable(
                unknown, f"Time derivative of {of.name}", per_second(of.unit), hidden=of.hidden
            )
    return variables


def _copies(system: EquationSystem, variables: dict[str, Variable]) -> list[Assignment]:
    """Aliases that users see, as variables of their own: sharing a value reference is lawful, but some importers, and
    FMPy's validation of FMI 3, expect each variable to have its own."""
    visible = [name for name in system.aliases if variables[name].variability == "continuous"]
    return [
        Assignment(name, symbol(system.aliases[name]), variables[name].origin)
        for name in visible
        if not variables[name].hidden
    ]


def _residual_variable(residual: Assignment, relation: Relation, variables: dict[str, Variable]) -> Variable:
    """The residual of a relation as a variable; its unit is that of one of the things compared."""
    text = f"Positive where {relation.text} ({residual.origin})"
    if relation.until is not None:  # the nominal value tells the runtime that the residual is exact
        return Variable(residual.target, text, "s", hidden=True, nominal=0.0)
    terms = sympy.Add.make_args(residual.expression)
    names = [str(s) for term in terms for s in (term, -term) if s.is_Symbol and str(s) in variables]
    unit = variables[names[0]].unit if names else ""
    return Variable(residual.target, text, unit, hidden=True)


def _blocks(equations: list[Equation], unknowns: list[str]) -> tuple[Block, ...]:
    matched = _match(equations, unknowns)
    order = {name: position for position, name in enumerate(unknowns)}
    needs = nx.DiGraph()
    needs.add_nodes_from(unknowns)
    for name, equation in matched.items():
        needed = sorted(s.name for s in equation.residual.free_symbols if s.name in matched and s.name != name)
        needs.add_edges_from((other, name) for other in needed)
    blocks = nx.condensation(needs)
    members = {node: sorted(blocks.nodes[node]["members"], key=order.__getitem__) for node in blocks}
    result: list[Block] = []
    for node in nx.lexicographical_topological_sort(blocks, key=lambda n: order[members[n][0]]):
        result.append(_solve(members[node], matched))
    return tuple(result)


def _match(equations: list[Equation], unknowns: list[str]) -> dict[str, Equation]:
    graph = nx.Graph()
    graph.add_nodes_from(range(len(equations)))
    graph.add_nodes_from(unknowns)
    known = set(unknowns)
    for index, equation in enumerate(equations):
        names = sorted(s.name for s in equation.residual.free_symbols)
        graph.add_edges_from((index, name) for name in names if name in known)
    matching = nx.bipartite.hopcroft_karp_matching(graph, top_nodes=range(len(equations)))
    for index, equation in enumerate(equations):
        if index not in matching:
            raise BuildError(
                f"{equation.origin}: this equation determines nothing that is not determined already"
                " (a constraint among states, which would need index reduction, or one equation too many)"
            )
    for name in unknowns:
        if name not in matching:
            raise BuildError(f"no equation determines {name}")
    return {name: equations[matching[name]] for name in unknowns}


def _solve(names: list[str], matched: dict[str, Equation]) -> Block:
    if len(names) == 1:
        name, equation = names[0], matched[names[0]]
        value = slope(equation, name)
        if value is not None and value != 0:
            return Assignment(name, -rest(equation, names) / value, equation.origin)
    return make_loop(names, matched)
