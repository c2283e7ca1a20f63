"""A FlatModel to an EquationSystem: bindings become equations, aliases go, states are chosen.

A variable that is differentiated is a state, unless an equation ties it to other states alone, as
``compression = x_t - x_c`` does. Then one of them, that with the least stateSelect, is computed from the others, and
one more derivative follows from the total time derivative of that equation. A fixed start value of the one that is
computed is passed on to one whose start value is free.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace

import sympy

from .errors import BuildError
from .index_reduction import reduce_index, varies
from .ir import EquationSystem, FlatModel
from .ir_equations import Assignment, Equation, Relation, Variable
from .ir_events import DiscreteEquations
from .start_point import starts_fit
from .substitution import substitute
from .symbols import TIME, der, derivative_of, holds, pre, symbol

Names = dict[str, str]


def derive(model: FlatModel) -> EquationSystem:
    """The equation system of ``model``; BuildError where it is not balanced or needs index reduction."""
    variables = {variable.name: variable for variable in model.variables}
    bindings = [
        Equation(symbol(v.name) - v.binding, v.origin)
        for v in model.variables
        if v.variability == "continuous" and v.binding is not None
    ]
    equations = [*model.equations, *bindings]
    aliases = _aliases(equations, variables)
    model = replace(model, variables=_with_starts_of_aliases(model.variables, aliases))
    variables = {variable.name: variable for variable in model.variables}
    values = _constants_and_roots(variables, aliases)
    relations, truths = _unique_relations(model.relations, values)
    replacements = {**values, **truths}
    reduced = [Equation(e.residual.xreplace(replacements), e.origin) for e in equations]
    reduced = [e for e in reduced if e.residual != 0]
    parameters, bound = _parameters(variables, aliases, replacements)
    inputs = tuple(v.name for v in model.variables if v.causality == "input")
    algebraics = [
        v.name
        for v in model.variables
        if v.variability == "continuous" and v.name not in aliases and v.causality != "input"
    ]
    _refuse_input_derivatives(reduced, inputs)
    before = _symbols(reduced)
    given = [
        Equation(symbol(n) - start, variables[n].origin)
        for n in algebraics
        if variables[n].fixed and (start := variables[n].start) is not None and symbol(der(n)) not in before
    ]  # fixed start values of what is no state
    chosen, reduced, starts, differentiated = _choose_states(reduced, algebraics, variables)
    index_one = reduce_index(reduced, differentiated, chosen, variables)
    given += index_one.given
    states, reduced = index_one.states, index_one.equations
    occurring, state_names = _symbols(reduced), set(states)
    derivatives = [name for name in (der(n) for n in algebraics) if symbol(name) in occurring]
    initial = substitute((*model.initial_equations, *given), replacements)
    derivatives += sorted(s.name for s in occurring if derivative_of(s.name)[1] > 1)
    unknowns = (*derivatives, *(n for n in algebraics if n not in state_names))
    return EquationSystem(
        model=model,
        states=tuple(states),
        invariants=tuple(index_one.invariants),
        inputs=inputs,
        unknowns=unknowns,
        equations=tuple(reduced),
        relations=relations,
        parameters=parameters,
        bound_parameters=bound,
        starts={name: starts[name].xreplace(values) for name in states if name in starts},
        aliases=aliases,
        events=_events(substitute(model.events, replacements), tuple(states), aliases),
        initial_equations=tuple(e for e in initial if e.residual != 0),
        starts_before=tuple(
            Assignment(pre(v.name), v.start.xreplace(values), v.origin)
            for v in model.variables
            if v.variability == "discrete" and v.start is not None
        ),
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


def _symbols(equations: Iterable[Equation]) -> set[sympy.Symbol]:
    return set().union(*(e.residual.free_symbols for e in equations))


def _aliases(equations: Iterable[Equation], variables: Mapping[str, Variable]) -> Names:
    """Each alias to the name that stands for it. Aliases are what ``a = b`` makes of two variables, nothing else."""
    sets: dict[str, set[str]] = {}
    pairs = [names for e in equations if (names := _equal_names(e.residual, variables))]
    pairs += [
        (v.name, v.binding.name)
        for v in variables.values()
        if v.variability == "parameter" and v.binding is not None and v.binding.is_Symbol
    ]
    for a, b in pairs:
        merged = sets.get(a, {a}) | sets.get(b, {b})
        sets.update(dict.fromkeys(merged, merged))
    order = list(variables)

    def rank(name: str) -> tuple[bool, int, bool, bool, int, int]:
        v = variables[name]
        is_free = v.binding is None or not v.binding.is_Symbol
        dots = name.count(".")
        return (v.causality != "input", -v.state_select, not v.fixed, not is_free, dots, order.index(name))

    roots = {name: min(members, key=rank) for name, members in sets.items()}
    return {name: roots[name] for name in order if name in roots and roots[name] != name}


def _with_starts_of_aliases(variables: tuple[Variable, ...], aliases: Names) -> tuple[Variable, ...]:
    """The variables; one that stands for others has the start value of the first of them that has one, best a fixed
    one, where its own is none, or not fixed."""
    starts: dict[str, Variable] = {}

    def weight(v: Variable, root: str) -> tuple[bool, bool, bool]:
        return v.fixed, not v.has_start_of_type, v.name == root

    for v in variables:
        root = aliases.get(v.name, v.name)
        best = starts.get(root)
        own = v.start is not None and v.variability == "continuous"
        if own and (best is None or weight(v, root) > weight(best, root)):
            starts[root] = v
    return tuple(
        replace(v, start=giver.start, fixed=giver.fixed, guess=giver.guess)
        if (giver := starts.get(v.name)) is not None and giver is not v
        else v
        for v in variables
    )


def _equal_names(residual: sympy.Expr, variables: Mapping[str, Variable]) -> tuple[str, str] | None:
    symbols = sorted(residual.free_symbols, key=str)
    if len(symbols) != 2 or residual not in (symbols[0] - symbols[1], symbols[1] - symbols[0]):
        return None
    first, second = (s.name for s in symbols)
    is_continuous = all(n in variables and variables[n].variability == "continuous" for n in (first, second))
    return (first, second) if is_continuous else None


def _constants_and_roots(variables: Mapping[str, Variable], aliases: Names) -> dict[sympy.Symbol, sympy.Expr]:
    """What to put in place of names: the value of a final parameter that has one, the root of an alias."""
    values: dict[sympy.Symbol, sympy.Expr] = {
        symbol(v.name): v.binding
        for v in variables.values()
        if v.variability == "parameter" and v.final and v.binding is not None and v.binding.is_number
    }
    for name, root in aliases.items():
        values[symbol(name)] = values.get(symbol(root), symbol(root))
        values[symbol(der(name))] = symbol(der(root))
        values[symbol(pre(name))] = symbol(pre(root))
    return values


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


def is_free(variable: Variable) -> bool:
    """Whether it is a parameter that the initial equations determine."""
    return variable.variability == "parameter" and not variable.fixed and variable.binding is None


def _choose_states(
    equations: list[Equation], algebraics: list[str], variables: Mapping[str, Variable]
) -> tuple[tuple[str, ...], list[Equation], dict[str, sympy.Expr], list[Equation]]:
    """The states, the equations with those that are added, the start values of the states, and what was
    differentiated."""
    differentiated: list[Equation] = []
    names = {symbol(n): n for n in algebraics}
    present = _symbols(equations)
    states = [n for n in algebraics if symbol(der(n)) in present]
    starts = {n: sympy.Integer(0) if (start := variables[n].start) is None else start for n in states}
    fixed = {n for n in states if variables[n].fixed}
    derivatives = {symbol(der(n)) for n in algebraics}
    result = list(equations)
    for equation in equations:
        symbols = equation.residual.free_symbols
        occurring = [names[s] for s in symbols if s in names]
        if not occurring or symbols & derivatives or not set(occurring) <= set(states):
            continue
        candidates = sorted(
            occurring,
            key=lambda n: (variables[n].state_select, n in fixed, variables[n].start is not None, -algebraics.index(n)),
        )
        demoted = next((n for n in candidates if not varies(equation.residual.diff(symbol(n)), variables)), None)
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
        result.append(Equation(_total_derivative(equation, demoted, set(occurring), variables), equation.origin))
    return tuple(states), result, starts, differentiated


def _start_from_others(equation: Equation, name: str, starts: Mapping[str, sympy.Expr]) -> sympy.Expr:
    """The start value that the equation, linear in ``name``, gives it where the others have theirs."""
    slope = equation.residual.diff(symbol(name))
    solution = -equation.residual.xreplace({symbol(name): sympy.Integer(0)}) / slope
    return solution.xreplace({symbol(n): start for n, start in starts.items() if n != name})


def _total_derivative(
    equation: Equation, demoted: str, occurring: set[str], variables: Mapping[str, Variable]
) -> sympy.Expr:
    """der(demoted) less what the chain rule makes of it."""
    residual = equation.residual
    moving = {name for name in occurring if name != demoted}
    for s in residual.free_symbols:
        if s.name in variables and variables[s.name].causality == "input":
            raise BuildError(f"{equation.origin}: this needs the time derivative of the input {s.name}: not supported")
    rates = sum((residual.diff(symbol(n)) * symbol(der(n)) for n in sorted(moving)), residual.diff(symbol(TIME)))
    return symbol(der(demoted)) + rates / residual.diff(symbol(demoted))
