"""A FlatModel with when-clauses and algorithms to one with plain assignments to discrete variables.

At an event all discrete variables are computed at once, from their values before it: a when-clause

    when c then v = e; end when;       becomes       v := if c and not pre(c) then e else pre(v)

The condition is a Boolean variable of its own, ``when{1}``, so that it has a value before. What comes out is computed
again and again, each time with the last values as those before, until nothing changes.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import networkx as nx
import sympy

from ..errors import BuildError
from ..ir.conditions import insert
from ..ir.equations import Assignment, Equation, Relation, Variable
from ..ir.events import Algorithm, Alternatives, Check, Choice, DiscreteEquations, Reinit, Statement, Together, When
from ..ir.models import FlatModel
from ..ir.symbols import INITIAL, Kind, holds, is_true, kind_of, numbered, pre, symbol, truth

Values = dict[str, sympy.Expr]


def lower(model: FlatModel) -> FlatModel:
    """The same model without when-clauses and algorithms; ``events`` has what they have become."""
    sections = (model.discrete, model.whens, model.algorithms, model.initial_algorithms)
    if not any((*sections, model.samples, model.rounded, model.checks)):
        return model
    work = _Lowering(model)
    for when in model.whens:
        work.assign(work.when(when, {}), when.branches[0].origin)
    for algorithm in model.algorithms:
        work.run(algorithm)
    work.assignments += model.rounded
    work.resolve(model.discrete)
    for v in model.variables:
        if v.variability == "discrete" and v.causality != "input" and v.name not in work.assigned:
            raise BuildError(f"{v.origin}: no equation determines {v.name}")
    initial = [equation for algorithm in model.initial_algorithms for equation in work.start(algorithm)]
    return replace(
        model,
        variables=(*model.variables, *work.variables, *_collected(model)),
        equations=(*model.equations, *work.equations),
        relations=tuple(work.relations),
        initial_equations=(*model.initial_equations, *initial),
        events=DiscreteEquations(
            assignments=tuple(work.assignments),
            reinits=tuple(work.reinits),
            checks=(*work.checks, *model.checks),
            samples=model.samples,
            n_event_checks=len(work.checks),
        ),
        discrete=(),
        whens=(),
        algorithms=(),
        initial_algorithms=(),
        samples=(),
        rounded=(),
        checks=(),
    )


def _collected(model: FlatModel) -> list[Variable]:
    """The variables that reading expressions has brought along: ticks of clocks, and what is rounded."""
    ticks = [numbered(Kind.SAMPLE, i) for i in range(len(model.samples))]
    return [
        *(Variable(name, type="Boolean", variability="discrete", hidden=True) for name in ticks),
        *(Variable(a.target, type="Integer", variability="discrete", hidden=True) for a in model.rounded),
    ]


class _Lowering:
    def __init__(self, model: FlatModel) -> None:
        self.declared = {v.name: v for v in model.variables}
        self.variables: list[Variable] = []
        self.assignments: list[Assignment] = []
        self.equations: list[Equation] = []
        self.reinits: list[Reinit] = []
        self.checks: list[Check] = []
        self.relations: list[Relation] = list(model.relations)
        self.assigned: set[str] = {a.target for a in model.rounded}
        self._conditions: dict[sympy.Expr, str] = {}

    def assign(self, values: Mapping[str, sympy.Expr], origin: str) -> None:
        """Take values as assignments."""
        for name, value in values.items():
            if name not in self.declared:
                raise BuildError(f"{origin}: {name} is assigned, and it is no scalar variable of the model")
            if name in self.assigned:
                raise BuildError(f"{origin}: {name} is assigned a second time: use elsewhen, or one algorithm section")
            self.assigned.add(name)
            self.assignments.append(Assignment(name, value, origin))

    def resolve(self, equations: Sequence[Alternatives]) -> None:
        """Choose for each equation between discrete variables the one that it assigns."""
        graph = nx.Graph()
        graph.add_nodes_from(range(len(equations)))
        for index, equation in enumerate(equations):
            graph.add_edges_from((index, a.target) for a in equation.assignments if a.target not in self.assigned)
        matching = nx.bipartite.hopcroft_karp_matching(graph, top_nodes=range(len(equations)))
        for index, equation in enumerate(equations):
            first = equation.assignments[0]
            if index not in matching:
                raise BuildError(f"{first.origin}: {first.target} is determined by something else already")
            chosen = next(a for a in equation.assignments if a.target == matching[index])
            self.assign({chosen.target: chosen.expression}, chosen.origin)

    def run(self, algorithm: Algorithm) -> None:
        """An algorithm section: each variable starts from its value before the event, or its start value."""
        targets = dict.fromkeys(algorithm.targets)
        values = {name: self._before(name) for name in targets}
        self._execute(algorithm.statements, values, sympy.true)
        for name in targets:
            if self.declared[name].variability == "discrete":
                self.assign({name: values[name]}, algorithm.origin)
            else:
                self.equations.append(Equation(symbol(name) - values[name], algorithm.origin))

    def start(self, algorithm: Algorithm) -> list[Equation]:
        """The equations that an initial algorithm section amounts to."""
        values: Values = {}
        self._execute(algorithm.statements, values, sympy.true)
        return [Equation(symbol(name) - value, algorithm.origin) for name, value in values.items()]

    def when(self, when: When, values: Values) -> Values:
        """What a when-clause assigns. ``values``: what the statements before it have assigned, in an algorithm."""
        branches: list[tuple[sympy.Expr, Values]] = []
        excluded: list[sympy.Expr] = []
        for branch in when.branches:
            fires = sympy.Or(
                *(self._becomes_true(insert(c, _symbols(values)), branch.origin) for c in branch.conditions)
            )
            active = self._flag(Kind.FIRES, sympy.And(fires, *excluded), branch.origin)
            excluded.append(sympy.Not(fires))
            result = dict(values)
            self._execute(branch.statements, result, active, simultaneous=not values)
            branches.append((active, result))
        names = dict.fromkeys(name for _, result in branches for name in result)
        return {
            name: sympy.Piecewise(
                *((result[name], active) for active, result in branches if name in result),
                (values.get(name, self._before(name)), True),
                evaluate=False,
            )
            for name in names
        }

    def _execute(
        self, statements: Iterable[Statement], values: Values, guard: sympy.Expr, *, simultaneous: bool = False
    ) -> None:
        """Statements, one after another; equations hold simultaneously, with what is assigned nowhere in between."""
        for statement in statements:
            known = {} if simultaneous else _symbols(values)
            if isinstance(statement, Assignment | Together):
                together = statement.assignments if isinstance(statement, Together) else (statement,)
                values.update({a.target: insert(a.expression, known) for a in together})
            elif isinstance(statement, Reinit):
                state, value = statement.state, insert(statement.value, known)
                self.reinits.append(Reinit(state, guard, value, statement.origin))
            elif isinstance(statement, Check):
                violated = sympy.And(guard, insert(statement.violated, known))
                self.checks.append(replace(statement, violated=violated))
            elif isinstance(statement, When):
                values.update(self.when(statement, values))
            else:
                self._choose(statement, values, guard, simultaneous)

    def _choose(self, choice: Choice, values: Values, guard: sympy.Expr, simultaneous: bool) -> None:
        pairs: list[tuple[Values, sympy.Expr]] = []
        excluded: list[sympy.Expr] = []
        for condition, statements in choice.branches:
            known = {} if simultaneous else _symbols(values)
            self._settle_relations(condition, known)
            chosen = insert(condition, known)
            result = dict(values)
            self._execute(statements, result, sympy.And(guard, chosen, *excluded), simultaneous=simultaneous)
            excluded.append(sympy.Not(chosen))
            pairs.append((result, chosen))
        for name in dict.fromkeys(name for result, _ in pairs for name in result):
            old = values.get(name, self._before(name))
            branches = [(result.get(name, old), chosen) for result, chosen in pairs]
            if any(value != old for value, _ in branches):
                values[name] = sympy.Piecewise(*branches, (old, True), evaluate=False)

    def _settle_relations(self, condition: sympy.Expr, known: Mapping[sympy.Symbol, sympy.Expr]) -> None:
        """A relation in an algorithm compares what has been assigned so far."""
        for index, relation in enumerate(self.relations):
            if holds(index) in condition.free_symbols:
                self.relations[index] = replace(relation, residual=insert(relation.residual, known))

    def _before(self, name: str) -> sympy.Expr:
        variable = self.declared.get(name)
        if variable is None or variable.variability == "discrete":
            return symbol(pre(name))
        return sympy.Integer(0) if variable.start is None else variable.start

    def _becomes_true(self, condition: sympy.Expr, origin: str) -> sympy.Expr:
        if condition == is_true(INITIAL):
            return condition
        name = self._conditions.get(condition)
        if name is None:
            name = self._conditions[condition] = self._new(Kind.WHEN, condition, origin, start=1)
        return sympy.And(is_true(name), sympy.Not(is_true(pre(name))))

    def _flag(self, kind: Kind, condition: sympy.Expr, origin: str) -> sympy.Expr:
        return is_true(self._new(kind, condition, origin, start=0))

    def _new(self, kind: Kind, condition: sympy.Expr, origin: str, start: int) -> str:
        name = numbered(kind, sum(kind_of(v.name) is kind for v in self.variables))
        self.variables.append(
            Variable(
                name, type="Boolean", variability="discrete", start=sympy.Integer(start), hidden=True, origin=origin
            )
        )
        self.assignments.append(Assignment(name, truth(condition), origin))
        return name


def _symbols(values: Values) -> dict[sympy.Symbol, sympy.Expr]:
    return {symbol(name): value for name, value in values.items()}
