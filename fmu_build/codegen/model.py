"""A SortedModel to C: variables.h and model.c, a line for each equation with the place it comes from."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import fields, replace
from itertools import groupby

import sympy

from ..ir.dependencies import needed_for, start_value, steady, tunable_parameters
from ..ir.equations import Variable
from ..ir.models import (
    DEFAULT_TOLERANCE,
    TOKEN_PLACEHOLDER,
    Across,
    Coupling,
    CSources,
    JacobianModel,
    LoopGradient,
    LoopPartials,
    Partials,
    SortedModel,
    Through,
)
from ..ir.symbols import TIME
from .early import Early
from .events import event_sizes, print_events
from .inputs import print_inputs
from .loops import adjoint_statement, check_stack, declare_loops, gradient_lines, numbered, tangent_statement
from .text import (
    LONGEST_FUNCTION,
    PIECE,
    Printer,
    assignment_lines,
    braced,
    comment,
    function,
    identifiers,
    in_pieces,
    string,
    whole,
)

MOST_SHARED = 8_000  # doubles on the stack, 64 KB, beside those of loops


def print_c(model: SortedModel, jacobian: JacobianModel, identifier: str, coupling: Coupling | None = None) -> CSources:
    """variables.h and model.c of ``model``, with the all-zero placeholder where the content hash will stand."""
    check_stack(model, jacobian)
    names = identifiers(model.value_references)
    printer = Printer(names, _locals(jacobian), steady(model), numbered(model))
    early = Early(model, jacobian, printer)
    text = _model(model, jacobian, printer, early) + "\n" + print_inputs(model, early)
    text += _coupling(coupling, model) + print_events(model, printer)
    header = _header(model, identifier, names, coupling, early.size)
    return CSources({"variables.h": header, "model.c": text})


def _locals(jacobian: JacobianModel) -> dict[str, str]:
    """The C names of the local derivatives: of many, which take pieces, elements of the array that these share."""
    names = [target for a in jacobian.assignments for target in a.targets]
    is_long = len(jacobian.assignments) + len(jacobian.entries) > LONGEST_FUNCTION
    if is_long and len(names) <= MOST_SHARED:
        return {name: f"local[{i}]" for i, name in enumerate(names)}
    return identifiers(names)


def _header(
    model: SortedModel, identifier: str, names: dict[str, str], coupling: Coupling | None, n_steady: int
) -> str:
    tolerance = model.experiment.tolerance or DEFAULT_TOLERANCE
    fields = "\n".join(f"        double {c}; {comment(name)}" for name, c in names.items())
    fields += f"\n        double steady[{n_steady}]; /* see model_steady */" if n_steady else ""
    return f"""{comment(f"Generated from {model.name}: the table of variables. Its order is the FMI value reference.")}
#ifndef VARIABLES_H
#define VARIABLES_H

#include "unit.h"

#define MODEL_NAME {string(identifier)}
#define MODEL_TOKEN "{TOKEN_PLACEHOLDER}"
#define DEFAULT_TOLERANCE {tolerance!r}
#define N_COUPLINGS {0 if coupling is None else 1}
#define N_LOOPS {len(numbered(model))}
#define HAS_EVENTS {int(not model.schedule.is_empty)}

enum {{
    N_STATES = {len(model.states)},
    N_INPUTS = {len(model.inputs)},
    N_PARAMETERS = {len(model.parameters)},
    N_RELATIONS = {len(model.relations)},
    N_VARIABLES = {len(names)}{event_sizes(model)}{_coupling_sizes(coupling)}
}};

typedef union {{
    struct {{
{fields}
    }};
    double at[N_VARIABLES];
}} Variables;

#endif
"""


def _model(model: SortedModel, jacobian: JacobianModel, printer: Printer, early: Early) -> str:
    relations = ", ".join(string(f"{r.text} ({r.origin})") for r in model.relations) or '""'
    kinds = _kinds(model)
    rows = "\n".join(_info(name, kinds[name], model) for name in model.value_references)
    outputs = assignment_lines(early.others(model.assignments), early.printer)
    derivatives = assignment_lines(early.others(needed_for(model.derivatives, model)), early.printer)
    references = [str(model.value_references[name]) for name in model.residuals] or ["0"]
    sections = [
        declare_loops(model, printer.text, lambda assignments: assignment_lines(assignments, printer)),
        function("model_parameters(Variables *v)", assignment_lines(model.parameter_assignments, printer)),
        early.text(printer),
        function("model_start(Variables *v, const bool holds[])", assignment_lines(model.start_assignments, printer)),
        function("model_derivatives(Variables *v, const bool holds[])", derivatives),
        function("model_outputs(Variables *v, const bool holds[])", outputs),
        _jacobian(model, jacobian, early.printer),
        function("model_relations(Variables *v, const bool holds[], double z[])", _relations(model, early)),
        _chain("model_tangent", jacobian, printer, _tangent),
        function(
            "model_input_tangent(const Variables *v, const bool holds[], Variables *d)",
            _tangent(_moved_by_inputs(model, jacobian), printer),
        ),
        _chain("model_adjoint", jacobian, printer, _adjoint),
    ]
    return f"""{comment(f"Generated from {model.name}. Each line bears the place in the source that it comes from.")}
#include "model.h"

#include <math.h>

#include "elementary.h"
#include "event_time.h"
#include "loops.h"

const VariableInfo variable_info[N_VARIABLES] = {{
{rows}
}};

const char *const relation_text[AT_LEAST_ONE(N_RELATIONS)] = {{{relations}}};

const unsigned relation_reference[AT_LEAST_ONE(N_RELATIONS)] = {{{", ".join(references)}}};

""" + "\n".join(sections)


def _coupling_sizes(coupling: Coupling | None) -> str:
    if coupling is None:
        return ""
    return f",\n    N_ACROSS = {len(coupling.across)},\n    N_THROUGH = {len(coupling.through)}"


def _coupling(coupling: Coupling | None, model: SortedModel) -> str:
    """The table of the coupling's variables, if there is one."""
    if coupling is None:
        return ""
    return "\n".join(["", "const CouplingInfo coupling_info = {", ",\n".join(_fields(coupling, model)), "};", ""])


def _fields(record: Coupling | Across | Through, model: SortedModel) -> list[str]:
    """The initializers of a record's fields: names as value references, what is None left out."""
    lines = []
    for field in fields(record):
        value = getattr(record, field.name)
        if isinstance(value, str):
            lines.append(f"    .{field.name} = {model.value_references[value]} {comment(value)}")
        elif isinstance(value, tuple):
            rows = ",\n".join(f"        {{{', '.join(map(str.strip, _fields(one, model)))}}}" for one in value)
            lines.append(f"    .{field.name} = {{\n{rows}}}")
        elif value is not None:
            lines.append(f"    .{field.name} = {value!r}")
    return lines


Direction = Callable[[Iterable[Partials | LoopPartials], Printer], list[str]]


def _chain(name: str, jacobian: JacobianModel, printer: Printer, lines: Direction) -> str:
    """The chain rule through all assignments, in one direction."""
    blocks = [
        lines(jacobian.parameter_partials, printer),
        _at_start(lines(jacobian.start_partials, printer)),
        lines(jacobian.partials, printer),
    ]
    ordered = blocks if lines is _tangent else blocks[::-1]
    signature = f"{name}(const Variables *v, const bool holds[], bool at_start, Variables *d)"
    return function(signature, [line for block in ordered for line in block])


def _at_start(statements: list[str]) -> list[str]:
    """The statements, for the start alone: few in one block, many each by itself."""
    if not statements or len(statements) > PIECE:
        return [f"if (at_start) {statement}" for statement in statements]
    lines = [f"    {line}" for statement in statements for line in statement.split("\n")]
    return ["\n".join(["if (at_start) {", *lines, "}"])]


def _tangent(partials: Iterable[Partials | LoopPartials], printer: Printer) -> list[str]:
    """``d->y = dy/da d->a + dy/db d->b``"""
    lines = []
    for p in partials:
        if isinstance(p, LoopPartials):
            lines.append(tangent_statement(printer.loop_name(p.loop), p, printer.text, printer.seed))
            continue
        terms = [_product(value, printer.seed(name), printer) for name, value in p.by_argument]
        lines.append(f"{printer.seed(p.target)} = {' + '.join(terms) or '0.0'}; {comment(p.origin)}")
    return lines


def _adjoint(partials: Iterable[Partials | LoopPartials], printer: Printer) -> list[str]:
    """In the reverse order ``d->a += dy/da d->y``, ``d->b += dy/db d->y``"""
    lines = []
    for p in reversed(list(partials)):
        if isinstance(p, LoopPartials):
            lines.append(adjoint_statement(printer.loop_name(p.loop), p, printer.text, printer.seed))
            continue
        lines += [
            f"{printer.seed(name)} += {_product(value, printer.seed(p.target), printer)}; {comment(p.origin)}"
            for name, value in p.by_argument
        ]
    return lines


def _moved_by_inputs(model: SortedModel, jacobian: JacobianModel) -> Iterator[Partials | LoopPartials]:
    """On the way to the derivatives: what the time and inputs move while states and parameters stay."""
    moved = {TIME, *model.inputs}
    needed = {name for block in needed_for(model.derivatives, model) for name in block.targets}
    for p in jacobian.partials:
        if isinstance(p, LoopPartials):
            if needed & {*p.loop.targets} and moved & {name for row in p.by_argument for name, _ in row}:
                moved |= {*p.loop.targets}
                yield p
        elif p.target in needed and (terms := tuple(term for term in p.by_argument if term[0] in moved)):
            moved.add(p.target)
            yield replace(p, by_argument=terms)


def _product(value: sympy.Expr, factor: str, printer: Printer) -> str:
    return factor if value == 1 else f"-{factor}" if value == -1 else f"({printer.text(value)})*{factor}"


def _relations(model: SortedModel, early: Early) -> list[str]:
    """Each residual goes to z as soon as it is known: read back later, in pairs, it would stall (1 % of a run)."""
    index = {name: i for i, name in enumerate(model.residuals)}
    lines = []
    for block in needed_for(list(index), model):
        lines += assignment_lines(early.others([block]), early.printer)
        lines += [f"z[{index[name]}] = v->{early.printer.names[name]};" for name in block.targets if name in index]
    return lines


def _chained(jacobian: JacobianModel, printer: Printer) -> list[str]:
    """The local derivatives, in their order; those of one loop, which share its factors, stand together."""
    statements: list[str] = []
    results = (*jacobian.entries.values(), *jacobian.time_entries.values())
    used = set().union(*(a.arguments for a in jacobian.assignments), *(value.free_symbols for value in results))
    left = {s.name: printer.left(s.name) for s in used if s.name in printer.locals}
    numbers = {a.targets: number for number, a in enumerate(jacobian.assignments)}
    for loop, group in groupby(jacobian.assignments, key=lambda a: a.loop if isinstance(a, LoopGradient) else None):
        lines: list[str] = []
        for a in group:
            if isinstance(a, LoopGradient):
                name = printer.loop_name(a.loop)
                lines += gradient_lines(name, a, numbers[a.targets], not lines, printer.text, left)
            else:
                lines.append(f"{left[a.target]} = {printer.text(a.expression)}; {comment(a.origin)}")
        statements += lines if loop is None or not printer.shares_locals else [braced(lines, loop.origin)]
    return statements


def _jacobian(model: SortedModel, jacobian: JacobianModel, printer: Printer) -> str:
    lines = _chained(jacobian, printer)
    lines.append("for (int i = 0; i < N_STATES; i++) time_derivative[i] = 0.0;" if model.states else "")
    for index, ((row, column), value) in enumerate(jacobian.entries.items()):
        what = f"{model.derivatives[row]} by {model.states[column]}"
        lines.append(f"jacobian[{index}] = {printer.text(value)}; {comment(what)}")
    lines += [f"time_derivative[{row}] = {printer.text(value)};" for row, value in jacobian.time_entries.items()]
    signature = "model_jacobian(const Variables *v, const bool holds[], double jacobian[], double time_derivative[])"
    statements = [line for line in lines if line]
    return (
        in_pieces(signature, statements, len(printer.locals)) if printer.shares_locals else whole(signature, statements)
    )


def _info(name: str, kind: str, model: SortedModel) -> str:
    variable = model.variables.get(name, Variable(name, unit="s" if name == TIME else ""))
    numbers = ", ".join(
        _number(value)
        for value in (
            start_value(name, model),
            -float("inf") if variable.min is None else variable.min,
            float("inf") if variable.max is None else variable.max,
            1.0 if variable.nominal is None else abs(variable.nominal),
        )
    )
    return f"    {{{string(name)}, {string(variable.unit)}, {variable.type.upper()}, {kind}, {numbers}}},"


def _kinds(model: SortedModel) -> dict[str, str]:
    """The VariableKind of every variable; where two apply, the later one."""
    kinds: dict[str, Iterable[str]] = {
        "OTHER": model.value_references,
        "TIME": (TIME,),
        "STATE": model.states,
        "STATE_CALCULATED": model.calculated_states,
        "DERIVATIVE": model.derivatives,
        "INPUT": model.inputs,
        "FIXED_PARAMETER": model.parameters,
        "PARAMETER": tunable_parameters(model),
        "CALCULATED_PARAMETER": (*(a.target for a in model.parameter_assignments), *model.free_parameters),
    }
    return {name: kind for kind, names in kinds.items() for name in names}


def _number(value: float) -> str:
    if value in (float("inf"), -float("inf")):
        return "(double)INFINITY" if value > 0 else "-(double)INFINITY"
    return repr(float(value))
