"""What follows from the dependencies in a SortedModel: slices, what is steady, which parameters have an effect."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TypeVar

import sympy

from .equations import Assignment, Block
from .models import LoopGradient, SortedModel
from .symbols import symbol


def needed_for(targets: Iterable[str], model: SortedModel) -> tuple[Block, ...]:
    """The assignments, in order, that computing ``targets`` takes."""
    return reaching({symbol(name) for name in targets}, model.assignments)


def tunable_parameters(model: SortedModel) -> frozenset[str]:
    """The parameters, calculated ones included, that more than start values depend on: changing them has an effect."""
    sources, schedule = model.sources, model.schedule
    used = (*model.assignments, *schedule.assignments, *schedule.check_assignments)
    effective = frozenset().union(*(sources.get(name, frozenset()) for block in used for name in block.targets))
    effective &= {*model.parameters}
    calculated = {a.target for a in model.parameter_assignments if sources[a.target] & effective}
    return effective | calculated


def steady(model: SortedModel) -> frozenset[str]:
    """What follows from parameters and inputs alone: it does not change while the states do.

    What a loop, a condition or an event gives its value is left out: it is computed when these are.
    """
    found = {*model.parameters, *model.inputs} - {name for b in model.start_assignments for name in b.targets}
    for block in (*model.parameter_assignments, *model.assignments):
        if isinstance(block, Assignment) and {s.name for s in block.arguments} <= found:
            found.add(block.target)
    return frozenset(found)


def start_value(name: str, model: SortedModel) -> float:
    """The start value of a state, parameter or input as a number; 0 where it is calculated or not given."""
    if name in model.start_values:
        return model.start_values[name]
    variable = model.variables.get(name)
    if variable is None or name not in {*model.parameters, *model.inputs}:
        return 0.0
    value = variable.start if variable.binding is None else variable.binding
    return 0.0 if value is None else float(value)


Computed = TypeVar("Computed", Assignment, Block, Assignment | LoopGradient)


def reaching(wanted: set[sympy.Symbol], blocks: Sequence[Computed]) -> tuple[Computed, ...]:
    """Those of the sorted ``blocks`` that computing ``wanted`` takes, in their order."""
    kept: list[Computed] = []
    wanted = set(wanted)
    for block in reversed(blocks):
        if any(symbol(target) in wanted for target in block.targets):
            kept.append(block)
            wanted |= block.arguments
    return tuple(reversed(kept))
