"""Variables that are equal by an equation of the form ``a = b``: one of them stands for all."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace

import sympy

from ..ir.equations import Equation, Variable
from ..ir.symbols import der, pre, symbol

Names = dict[str, str]


def find_aliases(equations: Iterable[Equation], variables: Mapping[str, Variable]) -> Names:
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
        is_open = v.variability == "parameter" or not v.fixed  # parameters are fixed by default: it says nothing
        dots = name.count(".")
        return (v.causality != "input", -v.state_select, is_open, not is_free, dots, order.index(name))

    roots = {name: min(members, key=rank) for name, members in sets.items()}
    return {name: roots[name] for name in order if name in roots and roots[name] != name}


def with_starts_of_aliases(variables: tuple[Variable, ...], aliases: Names) -> tuple[Variable, ...]:
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


def constants_and_roots(variables: Mapping[str, Variable], aliases: Names) -> dict[sympy.Symbol, sympy.Expr]:
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
