"""What depends on what: slices and dependencies of a SortedModel."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import sympy

from .ir import Assignment, SortedModel, holds, symbol


def needed_for(targets: Iterable[str], model: SortedModel) -> tuple[Assignment, ...]:
    """The assignments, in order, that computing ``targets`` takes."""
    return reaching({symbol(name) for name in targets}, model.assignments)


def dependencies(model: SortedModel) -> dict[str, frozenset[str]]:
    """For each computed variable the states, inputs, parameters and time that it depends on at a fixed time.

    A conditional depends on what its condition depends on.
    """
    leaves = (*model.states, *model.inputs, *model.parameters, *model.free_parameters, "time")
    known = {name: frozenset((name,)) for name in leaves}
    result: dict[str, frozenset[str]] = dict(known)
    for assignment in (*model.parameter_assignments, *model.schedule.assignments, *model.assignments):
        result[assignment.target] = _sources(assignment.expression, model, result)
    for assignment in model.schedule.check_assignments:
        result[assignment.target] = _sources(assignment.expression, model, result)
    return {name: sources for name, sources in result.items() if name not in known}


def tunable_parameters(model: SortedModel) -> frozenset[str]:
    """The parameters, calculated ones included, that more than start values depend on: changing them has an effect."""
    sources = dependencies(model)
    schedule = model.schedule
    used = (*model.assignments, *schedule.assignments, *schedule.check_assignments)
    effective = frozenset().union(*(sources.get(a.target, frozenset()) for a in used)) & {*model.parameters}
    calculated = {a.target for a in model.parameter_assignments if sources[a.target] & effective}
    return effective | calculated


def steady(model: SortedModel) -> frozenset[str]:
    """What follows from parameters and inputs alone: it does not change while the states do."""
    sources = dependencies(model)
    moving = {*model.states, "time"}
    return frozenset((*model.parameters, *model.inputs)) | {name for name in sources if not sources[name] & moving}


def start_value(name: str, model: SortedModel) -> float:
    """The start value of a state, parameter or input as a number; 0 where it is calculated or not given."""
    if name in model.start_values:
        return model.start_values[name]
    variable = model.variables.get(name)
    if variable is None or name not in {*model.parameters, *model.inputs}:
        return 0.0
    value = variable.start if variable.binding is None else variable.binding
    return 0.0 if value is None else float(value)


def _sources(expression: sympy.Expr, model: SortedModel, result: dict[str, frozenset[str]]) -> frozenset[str]:
    symbols = set(expression.free_symbols)
    for index, relation in enumerate(model.relations):
        if holds(index) in symbols:
            symbols |= relation.residual.free_symbols
    return frozenset().union(*(result.get(s.name, frozenset()) for s in symbols))


def reaching(wanted: set[sympy.Symbol], assignments: Sequence[Assignment]) -> tuple[Assignment, ...]:
    """Those of the sorted ``assignments`` that computing ``wanted`` takes, in their order."""
    kept: list[Assignment] = []
    wanted = set(wanted)
    for assignment in reversed(assignments):
        if symbol(assignment.target) in wanted:
            kept.append(assignment)
            wanted |= assignment.expression.free_symbols
    return tuple(reversed(kept))
