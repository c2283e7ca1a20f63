"""A FlatModel to an EquationSystem: bindings become equations, aliases go, states are chosen (states.py), constraints
among them differentiated (index_reduction.py)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import sympy

from ..errors import BuildError
from ..ir.equations import Assignment, Equation, Relation, Variable, is_free, symbols_of
from ..ir.events import DiscreteEquations
from ..ir.models import EquationSystem, FlatModel
from ..ir.substitution import substitute
from ..ir.symbols import der, derivative_of, holds, pre, symbol
from .aliases import Names, constants_and_roots, find_aliases, with_starts_of_aliases
from .index_reduction import Reduced, reduce_index
from .states import choose_states


def derive(model: FlatModel) -> EquationSystem:
    """The equation system of ``model``; BuildError where it is not balanced or index reduction fails."""
    equations = (*model.equations, *_bindings(model))
    aliases = find_aliases(equations, {v.name: v for v in model.variables})
    model = replace(model, variables=with_starts_of_aliases(model.variables, aliases))
    variables = {v.name: v for v in model.variables}
    values = constants_and_roots(variables, aliases)
    relations, truths = _unique_relations(model.relations, values)
    replacements = {**values, **truths}
    parameters, bound = _parameters(variables, aliases, replacements)
    inputs = tuple(v.name for v in model.variables if v.causality == "input")
    algebraics = [
        v.name
        for v in model.variables
        if v.variability == "continuous" and v.name not in aliases and v.causality != "input"
    ]
    reduced = [e for e in substitute(equations, replacements) if e.residual != 0]
    _refuse_input_derivatives(reduced, inputs)
    chosen, extended, starts, differentiated = choose_states(reduced, algebraics, variables)
    index_one = reduce_index(extended, differentiated, chosen, variables)
    given = (*_fixed_algebraics(reduced, algebraics, variables), *index_one.given)
    initial = substitute((*model.initial_equations, *given), replacements)
    return EquationSystem(
        model=model,
        states=tuple(index_one.states),
        invariants=tuple(index_one.invariants),
        inputs=inputs,
        unknowns=_unknowns(index_one, algebraics),
        equations=tuple(index_one.equations),
        relations=relations,
        parameters=parameters,
        bound_parameters=bound,
        starts={name: starts[name].xreplace(values) for name in index_one.states if name in starts},
        aliases=aliases,
        events=_events(substitute(model.events, replacements), tuple(index_one.states), aliases),
        initial_equations=tuple(e for e in initial if e.residual != 0),
        starts_before=_starts_before(model, values),
    )


def _bindings(model: FlatModel) -> list[Equation]:
    """Declarations ``Real x = expression`` as equations."""
    return [
        Equation(symbol(v.name) - v.binding, v.origin)
        for v in model.variables
        if v.variability == "continuous" and v.binding is not None
    ]


def _fixed_algebraics(
    equations: Iterable[Equation], algebraics: Iterable[str], variables: Mapping[str, Variable]
) -> list[Equation]:
    """Fixed start values of what is not differentiated."""
    occurring = symbols_of(equations)
    return [
        Equation(symbol(n) - start, variables[n].origin)
        for n in algebraics
        if variables[n].fixed and (start := variables[n].start) is not None and symbol(der(n)) not in occurring
    ]


def _unknowns(reduced: Reduced, algebraics: Sequence[str]) -> tuple[str, ...]:
    """Derivatives, of first order first, then the algebraic variables."""
    occurring, states = symbols_of(reduced.equations), set(reduced.states)
    rates = [rate for rate in map(der, algebraics) if symbol(rate) in occurring]
    higher = sorted(s.name for s in occurring if derivative_of(s.name)[1] > 1)
    return (*rates, *higher, *(n for n in algebraics if n not in states))


def _starts_before(model: FlatModel, values: Mapping[sympy.Symbol, sympy.Expr]) -> tuple[Assignment, ...]:
    """The values of discrete variables before the start."""
    return tuple(
        Assignment(pre(v.name), v.start.xreplace(values), v.origin)
        for v in model.variables
        if v.variability == "discrete" and v.start is not None
    )


def _events(events: DiscreteEquations, states: tuple[str, ...], aliases: Names) -> DiscreteEquations:
    """What happens at events, in states: they have no other value before an event than that which reinit replaces."""
    reinits = [replace(r, state=aliases.get(r.state, r.state)) for r in events.reinits]
    for reinit in reinits:
        if reinit.state not in states:
            raise BuildError(
                f"{reinit.origin}: reinit({reinit.state}, ...): it is no state, give it an equation with der()"
            )
    before = {symbol(pre(state)): symbol(state) for state in states}
    return substitute(replace(events, reinits=tuple(reinits)), before)


def _refuse_input_derivatives(equations: Iterable[Equation], inputs: Iterable[str]) -> None:
    rates = {symbol(der(name)): name for name in inputs}
    for equation in equations:
        for s in equation.residual.free_symbols & rates.keys():
            raise BuildError(
                f"{equation.origin}: this needs the time derivative of the input {rates[s]}: not supported; make the"
                " derivative an input of its own, or put a filter behind the input"
            )


def _unique_relations(
    relations: tuple[Relation, ...], values: Mapping[sympy.Symbol, sympy.Expr]
) -> tuple[tuple[Relation, ...], dict[sympy.Symbol, sympy.Symbol]]:
    """Relations with equal residuals are one, so that they switch together. A residual may contain earlier truths."""
    unique: dict[sympy.Expr, Relation] = {}
    positions: dict[sympy.Expr, int] = {}
    truths: dict[sympy.Symbol, sympy.Symbol] = {}
    for index, relation in enumerate(relations):
        residual = relation.residual.xreplace({**values, **truths})
        until = None if relation.until is None else relation.until.xreplace({**values, **truths})
        unique.setdefault(residual, Relation(residual, relation.text, relation.origin, until))
        truths[holds(index)] = holds(positions.setdefault(residual, len(positions)))
    return tuple(unique.values()), truths


def _parameters(
    variables: Mapping[str, Variable], aliases: Names, replacements: Mapping[sympy.Symbol, sympy.Expr]
) -> tuple[tuple[str, ...], dict[str, Equation]]:
    """Names of the parameters that can be set, and the equations of those that follow from others."""
    settable: list[str] = []
    bound: dict[str, Equation] = {}
    for v in variables.values():
        if v.variability != "parameter" or v.name in aliases or symbol(v.name) in replacements or is_free(v):
            continue
        if v.binding is None or v.binding.is_number:
            settable.append(v.name)
        else:
            bound[v.name] = Equation(symbol(v.name) - v.binding.xreplace(replacements), v.origin)
    return tuple(settable), bound
