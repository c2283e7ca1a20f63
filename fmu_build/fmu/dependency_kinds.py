"""How an unknown depends on what it depends on: FMI's dependenciesKind, from the partial derivatives.

The factor of a known is the sum over all ways of the product of the partial derivatives along it, so it varies at most
as the most variable of them. Where a known acts through a condition alone, or through a loop, nothing is said:
dependent.
"""

from __future__ import annotations

from collections.abc import Mapping

import sympy

from ..ir.dependencies import tunable_parameters
from ..ir.models import JacobianModel, LoopPartials, SortedModel
from ..ir.symbols import TIME, relation_of

DEPENDENT = "dependent"
KINDS = ("constant", "fixed", "tunable", "discrete", DEPENDENT)  # the factor is a number, ..., may be anything


def dependency_kinds(model: SortedModel, jacobian: JacobianModel) -> dict[str, dict[str, str]]:
    """For each variable that is computed at all times, the kind by the state, input or time that it depends on."""
    factors = _Factors(model)
    known = {name: {name: 0} for name in (*model.states, *model.inputs, TIME)}
    for partials in jacobian.partials:
        if isinstance(partials, LoopPartials):
            continue  # what is not in the table is dependent
        ways: dict[str, int] = {}
        for argument, partial in partials.by_argument:
            for source in model.sources.get(argument, {argument}):
                kind = max(factors.kind(partial), known.get(argument, {}).get(source, len(KINDS) - 1))
                ways[source] = max(kind, ways.get(source, 0))
        known[partials.target] = ways
    return {name: {source: KINDS[kind] for source, kind in ways.items()} for name, ways in known.items()}


class _Factors:
    """What kind an expression is of, as a factor."""

    def __init__(self, model: SortedModel) -> None:
        tunable = tunable_parameters(model)
        discrete = {name for name, variable in model.variables.items() if variable.variability == "discrete"}
        parameters = {name for name, variable in model.variables.items() if variable.variability == "parameter"}
        parameters |= {a.target for a in model.parameter_assignments}
        self._kinds: Mapping[str, int] = {
            **dict.fromkeys(discrete, KINDS.index("discrete")),
            **{name: KINDS.index("tunable" if name in tunable else "fixed") for name in parameters},
        }

    def kind(self, factor: sympy.Expr) -> int:
        """Its number in KINDS."""
        return max((self._of(s) for s in factor.free_symbols), default=0)

    def _of(self, symbol: sympy.Symbol) -> int:
        if relation_of(symbol) is not None:
            return KINDS.index("discrete")
        return self._kinds.get(symbol.name, len(KINDS) - 1)
