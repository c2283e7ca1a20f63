"""Exact partial derivatives of a SortedModel, assignment by assignment (forward accumulation).

Each assignment on the way from a state to a derivative contributes the chain rule over its own arguments. What comes
out as a number or a single name is passed on as it is; the rest becomes a local assignment, so that the C stays
readable.
"""

from __future__ import annotations

from collections.abc import Mapping

import sympy

from ..ir.dependencies import needed_for, reaching
from ..ir.equations import Assignment, Block, Loop
from ..ir.models import JacobianModel, LoopGradient, LoopPartials, Partials, SortedModel
from ..ir.symbols import TIME, partial_name, relation_of, symbol


def differentiate(model: SortedModel) -> JacobianModel:
    """The derivatives of ``model.derivatives`` by each state and by time, between events."""
    seeds = {name: number for number, name in enumerate((*model.states, TIME))}
    gradients: dict[str, dict[str, sympy.Expr]] = {seed: {seed: sympy.Integer(1)} for seed in seeds}
    locals_: list[Assignment | LoopGradient] = []
    partials = _of_blocks(model.assignments)
    partials_of = {block.targets: p for block, p in zip(model.assignments, partials, strict=True)}
    for block in needed_for(model.derivatives, model):
        p = partials_of[block.targets]
        if isinstance(p, LoopPartials):
            gradients |= loop_gradients(p, gradients, seeds, locals_)
        else:
            gradients[p.target] = _gradient(p, gradients, seeds, locals_)
    states = {name: column for column, name in enumerate(model.states)}
    entries, time_entries = {}, {}
    for row, name in enumerate(model.derivatives):
        for seed, value in gradients[name].items():
            if seed == TIME:
                time_entries[row] = value
            else:
                entries[row, states[seed]] = value
    results = (*entries.values(), *time_entries.values())
    return JacobianModel(
        parameter_partials=_partials(model.parameter_assignments),
        start_partials=_of_blocks(model.start_assignments),
        partials=partials,
        assignments=reaching(set().union(*(value.free_symbols for value in results)), locals_),
        entries=entries,
        time_entries=time_entries,
    )


def _of_blocks(blocks: tuple[Block, ...]) -> tuple[Partials | LoopPartials, ...]:
    return tuple(loop_partials(block) if isinstance(block, Loop) else _partials((block,))[0] for block in blocks)


def _partials(assignments: tuple[Assignment, ...]) -> tuple[Partials, ...]:
    return tuple(
        Partials(
            a.target,
            tuple(
                (s.name, partial)
                for s in sorted(a.expression.free_symbols, key=str)
                if relation_of(s) is None and (partial := a.expression.diff(s)) != 0
            ),
            a.origin,
        )
        for a in assignments
    )


def _gradient(
    of: Partials,
    gradients: dict[str, dict[str, sympy.Expr]],
    seeds: dict[str, int],
    locals_: list[Assignment | LoopGradient],
) -> dict[str, sympy.Expr]:
    partials = {name: value for name, value in of.by_argument if name in gradients}
    result: dict[str, sympy.Expr] = {}
    reached = set().union(*(gradients[n] for n in partials))
    for seed in sorted(reached, key=seeds.__getitem__):
        value = sum((p * gradients[n][seed] for n, p in partials.items() if seed in gradients[n]), sympy.Integer(0))
        if value == 0:
            continue
        if not (value.is_number or value.is_Symbol):
            name = partial_name(of.target, seed)
            locals_.append(Assignment(name, value, of.origin))
            value = symbol(name)
        result[seed] = value
    return result


def loop_partials(loop: Loop) -> LoopPartials:
    """The partial derivatives of the residuals by the loop's arguments."""
    arguments = sorted((s for s in loop.arguments if relation_of(s) is None), key=str)
    return LoopPartials(
        loop,
        tuple(
            tuple((s.name, r.residual.diff(s)) for s in arguments if s in r.residual.free_symbols)
            for r in loop.residuals
        ),
    )


def loop_gradients(
    of: LoopPartials,
    gradients: Mapping[str, Mapping[str, sympy.Expr]],
    seeds: Mapping[str, int],
    locals_: list[Assignment | LoopGradient],
) -> dict[str, dict[str, sympy.Expr]]:
    """The derivatives of the unknowns by the seeds, as new locals, from those of the arguments."""
    loop = of.loop
    partials = [[(value, gradients[name]) for name, value in row if name in gradients] for row in of.by_argument]
    touched = set().union(*(gradient for row in partials for _, gradient in row))
    result: dict[str, dict[str, sympy.Expr]] = {name: {} for name in loop.unknowns}
    for seed in sorted(touched, key=seeds.__getitem__):
        right = tuple(
            sympy.Add(*(value * gradient[seed] for value, gradient in row if seed in gradient)) for row in partials
        )
        targets = tuple(partial_name(name, seed) for name in loop.unknowns)
        locals_.append(LoopGradient(loop, targets, right))
        for name, target in zip(loop.unknowns, targets, strict=True):
            result[name][seed] = symbol(target)
    return result
