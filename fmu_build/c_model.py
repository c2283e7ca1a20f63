"""A SortedModel to C: variables.h and model.c, a line for each equation with the place it comes from."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import fields
from typing import Any

import sympy
from sympy.printing.c import C11CodePrinter

from .ir import (
    DEFAULT_TOLERANCE,
    TIME,
    TOKEN_PLACEHOLDER,
    Assignment,
    Coupling,
    CSources,
    JacobianModel,
    Partials,
    SortedModel,
    Variable,
    relation_name,
)
from .slices import needed_for, start_value, tunable_parameters

C_KEYWORDS = frozenset(C11CodePrinter.reserved_words) | {"inline", "restrict", "bool", "true", "false", "at"}


def print_c(model: SortedModel, jacobian: JacobianModel, identifier: str, coupling: Coupling | None = None) -> CSources:
    """variables.h and model.c of ``model``, with the all-zero placeholder where the content hash will stand."""
    names = _identifiers(model.value_references)
    header = _header(model, identifier, names, n_couplings=0 if coupling is None else 1)
    text = _model(model, jacobian, _Printer(names))
    return CSources({"variables.h": header, "model.c": text + _coupling(coupling, model)})


def _identifiers(names: Iterable[str]) -> dict[str, str]:
    """Modelica names to distinct C names: ``der(car.body.v)`` to ``der_car_body_v``."""
    result: dict[str, str] = {}
    taken: set[str] = set()
    for name in names:
        identifier = re.sub(r"\W+", "_", name).strip("_")
        while identifier in taken or identifier in C_KEYWORDS:
            identifier += "_"
        taken.add(identifier)
        result[name] = identifier
    return result


class _Printer(C11CodePrinter):  # type: ignore[misc]
    """C expressions over ``v->name``; doubles with the digits that give them back exactly."""

    def __init__(self, names: dict[str, str]) -> None:
        super().__init__()
        self.names = names

    def _print_Symbol(self, expr: sympy.Symbol) -> str:
        if expr.name in self.names:
            return f"v->{self.names[expr.name]}"
        return expr.name if expr.name.startswith("holds[") else local_name(expr.name)

    def _print_Float(self, expr: sympy.Float) -> str:
        return repr(float(expr))

    def _print_Integer(self, expr: sympy.Integer) -> str:
        return f"{int(expr)}.0"

    def _print_Rational(self, expr: sympy.Rational) -> str:
        return f"{expr.p}.0/{expr.q}.0"

    def _print_Pow(self, expr: sympy.Pow) -> str:
        base, exponent = expr.as_base_exp()
        if exponent.is_Integer and 2 <= abs(int(exponent)) <= 4:
            factor = self.parenthesize(base, sympy.printing.precedence.PRECEDENCE["Atom"])
            product = "*".join([factor] * abs(int(exponent)))
            return f"({product})" if exponent > 0 else f"1.0/({product})"
        return str(super()._print_Pow(expr))

    def _print_Piecewise(self, expr: sympy.Piecewise) -> str:
        *branches, (last, _) = expr.args
        text = str(self._print(last))
        for value, condition in reversed(branches):
            text = f"({self._print(condition)} ? {self._print(value)} : {text})"
        return text

    def text(self, expression: sympy.Expr) -> str:
        return str(self.doprint(expression))


def local_name(name: str) -> str:
    """The C name of a partial derivative: ``d(car.tyre.F)/d(car.body.v)`` to ``d_car_tyre_F__d_car_body_v``."""
    return "__".join(re.sub(r"\W+", "_", part).strip("_") for part in name.split("/"))


def _header(model: SortedModel, identifier: str, names: dict[str, str], n_couplings: int) -> str:
    tolerance = model.experiment.tolerance or DEFAULT_TOLERANCE
    fields = "\n".join(f"        double {c}; /* {name} */" for name, c in names.items())
    return f"""/* Generated from {model.name}: the table of variables. Its order is the FMI value reference. */
#ifndef VARIABLES_H
#define VARIABLES_H

#define MODEL_NAME "{identifier}"
#define MODEL_TOKEN "{TOKEN_PLACEHOLDER}"
#define DEFAULT_TOLERANCE {tolerance!r}
#define N_COUPLINGS {n_couplings}

enum {{
    N_STATES = {len(model.states)},
    N_INPUTS = {len(model.inputs)},
    N_PARAMETERS = {len(model.parameters)},
    N_RELATIONS = {len(model.relations)},
    N_VARIABLES = {len(names)}
}};

typedef union {{
    struct {{
{fields}
    }};
    double at[N_VARIABLES];
}} Variables;

#endif
"""


def _model(model: SortedModel, jacobian: JacobianModel, printer: _Printer) -> str:
    relations = ", ".join(_string(f"{r.text} ({r.origin})") for r in model.relations) or '""'
    kinds = _kinds(model)
    rows = "\n".join(_info(name, kinds[name], model) for name in model.value_references)
    outputs = _lines(model.assignments, printer)
    derivatives = _lines(needed_for(model.derivatives, model), printer)
    residuals = [relation_name(i) for i in range(len(model.relations))]
    references = [str(model.value_references[name]) for name in residuals] or ["0"]
    sections = [
        _function("model_parameters(Variables *v)", _lines(model.parameter_assignments, printer)),
        _function("model_start(Variables *v)", _lines(model.start_assignments, printer)),
        _function("model_derivatives(Variables *v, const bool holds[])", derivatives),
        _function("model_outputs(Variables *v, const bool holds[])", outputs),
        _jacobian(model, jacobian, printer),
        _function("model_relations(Variables *v, const bool holds[], double z[])", _relations(model, printer)),
        _chain("model_tangent", jacobian, printer, _tangent),
        _chain("model_adjoint", jacobian, printer, _adjoint),
    ]
    return f"""/* Generated from {model.name}. Each line bears the place in the Modelica source that it comes from. */
#include "model.h"

#include <math.h>

const VariableInfo variable_info[N_VARIABLES] = {{
{rows}
}};

const char *const relation_text[AT_LEAST_ONE(N_RELATIONS)] = {{{relations}}};

const unsigned relation_reference[AT_LEAST_ONE(N_RELATIONS)] = {{{", ".join(references)}}};

""" + "\n".join(sections)


def _coupling(coupling: Coupling | None, model: SortedModel) -> str:
    """The table of the coupling's variables, if there is one."""
    if coupling is None:
        return ""
    rows = [
        f"    .{field.name} = {model.value_references[name]}, /* {name} */"
        for field in fields(coupling)
        for name in [getattr(coupling, field.name)]
    ]
    return "\n".join(["", "const CouplingInfo coupling_info = {", *rows, "};", ""])


Direction = Callable[[Iterable[Partials], _Printer], list[str]]


def _chain(name: str, jacobian: JacobianModel, printer: _Printer, lines: Direction) -> str:
    """The chain rule through all assignments, in one direction."""
    start = [f"    {line}" for line in lines(jacobian.start_partials, printer)]
    blocks = [
        lines(jacobian.parameter_partials, printer),
        ["if (at_start) {", *start, "}"] if start else [],
        lines(jacobian.partials, printer),
    ]
    ordered = blocks if lines is _tangent else blocks[::-1]
    signature = f"{name}(const Variables *v, const bool holds[], bool at_start, Variables *d)"
    return _function(signature, [line for block in ordered for line in block])


def _tangent(partials: Iterable[Partials], printer: _Printer) -> list[str]:
    """``d->y = dy/da d->a + dy/db d->b``"""
    lines = []
    for p in partials:
        terms = [_product(value, f"d->{printer.names[name]}", printer) for name, value in p.by_argument]
        lines.append(f"d->{printer.names[p.target]} = {' + '.join(terms) or '0.0'}; /* {p.origin} */")
    return lines


def _adjoint(partials: Iterable[Partials], printer: _Printer) -> list[str]:
    """In the reverse order ``d->a += dy/da d->y``, ``d->b += dy/db d->y``"""
    return [
        f"d->{printer.names[name]} += {_product(value, f'd->{printer.names[p.target]}', printer)}; /* {p.origin} */"
        for p in reversed(list(partials))
        for name, value in p.by_argument
    ]


def _product(value: sympy.Expr, factor: str, printer: _Printer) -> str:
    return factor if value == 1 else f"-{factor}" if value == -1 else f"({printer.text(value)})*{factor}"


def _function(signature: str, lines: list[str]) -> str:
    """A C function; parameters that its lines do not use are marked so."""
    body = "\n".join(lines)
    arguments = re.findall(r"(\w+)(?:\[\])?[,)]", signature)
    unused = [f"(void){a};" for a in arguments if not re.search(rf"\b{a}\b", body)]
    text = "\n".join(f"    {line}" for line in [*unused, *lines])
    return f"void {signature}\n{{\n{text}\n}}\n"


def _lines(assignments: Iterable[Assignment], printer: _Printer) -> list[str]:
    return [f"v->{printer.names[a.target]} = {printer.text(a.expression)}; /* {a.origin} */" for a in assignments]


def _relations(model: SortedModel, printer: _Printer) -> list[str]:
    """Each residual goes to z as soon as it is known: read back later, in pairs, it would stall (1 % of a run)."""
    index = {relation_name(i): i for i in range(len(model.relations))}
    lines = []
    for assignment in needed_for(list(index), model):
        lines += _lines([assignment], printer)
        if assignment.target in index:
            lines.append(f"z[{index[assignment.target]}] = v->{printer.names[assignment.target]};")
    return lines


def _jacobian(model: SortedModel, jacobian: JacobianModel, printer: _Printer) -> str:
    arguments = set().union(*(a.expression.free_symbols for a in jacobian.assignments)) | set().union(
        *(value.free_symbols for value in (*jacobian.entries.values(), *jacobian.time_entries.values()))
    )
    needed = needed_for((s.name for s in arguments), model)
    lines = _lines(needed, printer)
    lines += [
        f"const double {local_name(a.target)} = {printer.text(a.expression)}; /* {a.origin} */"
        for a in jacobian.assignments
    ]
    count = len(model.states)
    lines.append("for (int i = 0; i < N_STATES * N_STATES; i++) jacobian[i] = 0.0;" if count else "")
    lines.append("for (int i = 0; i < N_STATES; i++) time_derivative[i] = 0.0;" if count else "")
    for (row, column), value in jacobian.entries.items():
        comment = f"{model.derivatives[row]} by {model.states[column]}"
        lines.append(f"jacobian[{row} * N_STATES + {column}] = {printer.text(value)}; /* {comment} */")
    lines += [f"time_derivative[{row}] = {printer.text(value)};" for row, value in jacobian.time_entries.items()]
    signature = "model_jacobian(Variables *v, const bool holds[], double jacobian[], double time_derivative[])"
    return _function(signature, [line for line in lines if line])


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
    return f"    {{{_string(name)}, {_string(variable.unit)}, {kind}, {numbers}}},"


def _kinds(model: SortedModel) -> dict[str, str]:
    """The VariableKind of every variable; where two apply, the later one."""
    calculated_starts = [a.target for a in model.start_assignments]
    kinds: dict[str, Iterable[str]] = {
        "OTHER": model.value_references,
        "TIME": (TIME,),
        "STATE": model.states,
        "STATE_CALCULATED": calculated_starts,
        "DERIVATIVE": model.derivatives,
        "INPUT": model.inputs,
        "FIXED_PARAMETER": model.parameters,
        "PARAMETER": tunable_parameters(model),
        "CALCULATED_PARAMETER": (a.target for a in model.parameter_assignments),
    }
    return {name: kind for kind, names in kinds.items() for name in names}


def _number(value: float) -> str:
    if value in (float("inf"), -float("inf")):
        return "(double)INFINITY" if value > 0 else "-(double)INFINITY"
    return repr(float(value))


def _string(text: Any) -> str:
    escaped = str(text).replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'
