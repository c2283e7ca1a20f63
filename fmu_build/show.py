"""Values between stages as text for a person: expressions as in Modelica, as far as they go, each with its place."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

import sympy
from sympy.printing.str import StrPrinter

from .ir.equations import Assignment, Block, Equation, Loop, Relation, Variable
from .ir.events import Algorithm, Check, Choice, Reinit, Statement, Together, When
from .ir.models import FlatModel, JacobianModel, LoopGradient, LoopPartials, Partials, SortedModel
from .ir.symbols import holds, partial_name

STATE_SELECT = {-2: "never", -1: "avoid", 0: "default", 1: "prefer", 2: "always"}
Section = tuple[str, Iterable[str]]


class _Printer(StrPrinter):  # type: ignore[misc]
    """Conditions and conditionals in Modelica's words, numbers with the digits that give them back."""

    def _print_Float(self, expr: sympy.Float) -> str:
        return repr(float(expr))

    def _print_Piecewise(self, expr: sympy.Piecewise) -> str:
        *branches, (last, _) = expr.args
        chosen = " else".join(f"if {self._print(truth)} then {self._print(value)}" for value, truth in branches)
        return f"({chosen} else {self._print(last)})"

    def _print_And(self, expr: sympy.And) -> str:
        return self._joined(" and ", expr)

    def _print_Or(self, expr: sympy.Or) -> str:
        return self._joined(" or ", expr)

    def _print_Not(self, expr: sympy.Not) -> str:
        return f"not {self._print(expr.args[0])}"

    def _joined(self, word: str, expr: sympy.And | sympy.Or) -> str:
        return f"({word.join(map(self._print, sorted(expr.args, key=sympy.default_sort_key)))})"

    def _print_BooleanTrue(self, expr: sympy.Basic) -> str:
        return "true"

    def _print_BooleanFalse(self, expr: sympy.Basic) -> str:
        return "false"


_text = _Printer().doprint


def show_flat(flat: FlatModel) -> str:
    """Variables with their attributes, equations, what happens at events."""
    choices = (equation.assignments for equation in flat.discrete)
    return _sections(
        f"{flat.name}: {flat.description}",
        ("variables", (_placed(_declaration(v), v.origin) for v in flat.variables)),
        ("equations", map(_equation, flat.equations)),
        ("equations between discrete variables", (" or ".join(map(_assignment, one)) for one in choices)),
        ("initial equations", map(_equation, flat.initial_equations)),
        ("relations", _relations(flat.relations)),
        ("rounded", map(_assignment, flat.rounded)),
        ("samples", (_placed(f"sample({_text(s.start)}, {_text(s.interval)})", s.origin) for s in flat.samples)),
        ("when-clauses", _statements(flat.whens)),
        ("algorithms", _algorithms(flat.algorithms)),
        ("initial algorithms", _algorithms(flat.initial_algorithms)),
        ("assertions", _statements(flat.checks)),
    )


def show_sorted(model: SortedModel) -> str:
    """States, and every assignment in the order of computation."""
    schedule = model.schedule
    values = {name: f"{name} = {value!r}" for name, value in model.start_values.items()}
    return _sections(
        f"{model.name}: {model.description}",
        ("inputs", model.inputs),
        ("parameters", (_declaration(model.variables[name]) for name in model.parameters)),
        ("calculated parameters", _blocks(model.parameter_assignments)),
        ("states", (values.get(name, f"{name}, whose start is calculated") for name in model.states)),
        ("at the start", _blocks(model.start_assignments)),
        ("relations", _relations(model.relations)),
        ("at any time", _blocks(model.assignments)),
        ("at events", _blocks(schedule.assignments)),
        ("to be checked", _blocks(schedule.check_assignments)),
        ("reinit", (f"{r.state} := {r.value} where {r.active}" for r in schedule.reinits)),
        ("time events", schedule.time_events),
        ("kept at events", (f"{m.before} := {m.name}" for m in schedule.memories)),
    )


def show_jacobian(model: SortedModel, jacobian: JacobianModel) -> str:
    """The partial derivatives of each assignment, and those of the states' derivatives by the chain rule."""
    rates, columns = model.derivatives, model.states
    entries = [(partial_name(rates[i], columns[j]), value) for (i, j), value in jacobian.entries.items()]
    entries += [(partial_name(rates[i], "time"), value) for i, value in jacobian.time_entries.items()]
    return _sections(
        f"{model.name}: {model.description}",
        ("calculated parameters", _partials(jacobian.parameter_partials)),
        ("at the start", _partials(jacobian.start_partials)),
        ("at any time", _partials(jacobian.partials)),
        ("chained", _blocks(jacobian.assignments)),
        ("derivatives of the states by the states and the time", (f"{name} = {_text(v)}" for name, v in entries)),
    )


def _sections(title: str, *sections: Section) -> str:
    """The title, and those sections that have lines."""
    parts = [f"{title}\n"]
    for heading, lines in sections:
        if body := "".join(f"  {line}\n" for line in lines):
            parts.append(f"{heading}\n{body}")
    return "\n".join(parts)


def _placed(text: str, origin: str) -> str:
    return f"{text}   // {origin}" if origin else text


def _declaration(v: Variable) -> str:
    words = {"protected": v.hidden, "final": v.final, v.causality: v.causality != "local"}
    words |= {v.variability: v.variability != "continuous", v.enumeration.name if v.enumeration else v.type: True}
    attributes: Mapping[str, str | None] = {
        "unit": f'"{v.unit}"' if v.unit else None,
        "quantity": f'"{v.quantity}"' if v.quantity else None,
        "start": None if v.start is None else _text(v.start),
        "fixed": None if v.fixed == (v.variability == "parameter") else str(v.fixed).lower(),
        **{key: None if number is None else repr(number) for key, number in _limits(v)},
        "stateSelect": STATE_SELECT[v.state_select] if v.state_select else None,
    }
    given = ", ".join(f"{key}={value}" for key, value in attributes.items() if value is not None)
    binding = "" if v.binding is None else f" = {_text(v.binding)}"
    description = f' "{v.description}"' if v.description else ""
    kind = " ".join(word for word, is_said in words.items() if is_said)
    return f"{kind} {v.name}{f'({given})' if given else ''}{binding}{description}"


def _limits(v: Variable) -> Sequence[tuple[str, float | None]]:
    return ("min", v.min), ("max", v.max), ("nominal", v.nominal)


def _equation(equation: Equation) -> str:
    return _placed(f"0 = {_text(equation.residual)}", equation.origin)


def _assignment(a: Assignment) -> str:
    return _placed(f"{a.target} := {_text(a.expression)}", a.origin)


def _relations(relations: Iterable[Relation]) -> Iterator[str]:
    for index, relation in enumerate(relations):
        yield _placed(f"{holds(index)}: {_text(relation.residual)} > 0", f"{relation.text} ({relation.origin})")


def _blocks(blocks: Iterable[Block | LoopGradient]) -> Iterator[str]:
    """A line for each assignment; those of a loop below each other."""
    for block in blocks:
        if isinstance(block, Loop):
            yield f"{', '.join(block.iterated)} such that"
            yield from (f"  {_assignment(a)}" for a in block.explicit)
            needed = block.residuals[: len(block.iterated)]
            yield from (f"  {_equation(residual)}" for residual in needed)
        elif isinstance(block, LoopGradient):
            yield _placed(f"{', '.join(block.targets)} from the loop's slopes", block.loop.origin)
        else:
            yield _assignment(block)


def _partials(partials: Iterable[Partials | LoopPartials]) -> Iterator[str]:
    """A line for each derivative; those of a loop are of its residuals."""
    for p in partials:
        if isinstance(p, LoopPartials):
            for residual, row in zip(p.loop.residuals, p.by_argument, strict=True):
                of = f"0 = {_text(residual.residual)}"
                yield from (_placed(f"{of} by {name}: {_text(value)}", residual.origin) for name, value in row)
        else:
            for name, value in p.by_argument:
                yield _placed(f"{partial_name(p.target, name)} = {_text(value)}", p.origin)


def _algorithms(algorithms: Iterable[Algorithm]) -> Iterator[str]:
    for algorithm in algorithms:
        yield _placed("algorithm", algorithm.origin)
        yield from _indented(_statements(algorithm.statements))


def _statements(statements: Iterable[Statement]) -> Iterator[str]:
    for statement in statements:
        if isinstance(statement, Assignment):
            yield _assignment(statement)
        elif isinstance(statement, Together):
            yield from map(_assignment, statement.assignments)
        elif isinstance(statement, Reinit):
            yield _placed(f"reinit({statement.state}, {_text(statement.value)})", statement.origin)
        elif isinstance(statement, Check):
            text = f'{statement.kind} where {_text(statement.violated)}: "{statement.message.format}"'
            yield _placed(text, statement.origin)
        elif isinstance(statement, Choice):
            for condition, inner in statement.branches:
                yield f"if {_text(condition)}"
                yield from _indented(_statements(inner))
        else:
            yield from _when(statement)


def _when(when: When) -> Iterator[str]:
    for branch in when.branches:
        yield _placed(f"when {', '.join(map(_text, branch.conditions))}", branch.origin)
        yield from _indented(_statements(branch.statements))


def _indented(lines: Iterable[str]) -> Iterator[str]:
    return (f"  {line}" for line in lines)
