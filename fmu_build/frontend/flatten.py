"""Modelica text to a FlatModel. rumoca is touched in this folder alone.

rumoca (pinned exactly, see docs/dependencies.md) parses, resolves, checks and flattens. We read its flat form, a JSON
tree.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import sympy

from ..errors import BuildError
from ..ir.equations import Assignment, Equation, Variable
from ..ir.events import Alternatives
from ..ir.models import FlatModel
from ..ir.symbols import is_continuous, symbol
from .annotations import (
    class_text,
    read_claims,
    read_couplings,
    read_documentation,
    read_examples,
    read_experiment,
    read_icon,
    read_terminals,
)
from .audit import refuse_lost_modifiers
from .clauses import assigned_names, read_algorithms, read_checks, read_whens
from .clocked_equations import without_clocks
from .components import elements_for
from .declarations import Node, declared_names, fixed_names, is_text, variables_of
from .event_expressions import EventReader, enumeration_types
from .loading import load
from .modifiers import with_modifiers
from .outer import with_inner
from .scopes import rescoped
from .sources import Sources, readable
from .used_classes import UsedClasses
from .values import Value, elements


def flatten(path: Path, class_name: str, libraries: Sequence[Path] = ()) -> FlatModel:
    """The class ``class_name`` of the Modelica file or library folder ``path``, flattened; ``libraries`` as load() has
    them.

    Raises BuildError, with file and line, where the Modelica does not compile or uses what is not supported.
    """
    flat, sources = load(path, class_name, libraries)
    classes = UsedClasses(sources.texts_by_number(), class_name)
    refuse_lost_modifiers(flat, sources, classes)
    flat = rescoped(flat, sources, classes)
    flat = with_inner(with_modifiers(flat, fixed_names(flat)), sources)
    flat = without_clocks(flat, sources)
    fixed = fixed_names(flat)  # with outer constants, which have their values now
    declared = declared_names(flat)
    reader = EventReader(sources, declared, flat, fixed)
    kinds = enumeration_types(flat)
    variables = [
        variable
        for name, node in flat["variables"].items()
        if name not in fixed and not is_text(node, flat)
        for variable in variables_of(node, flat, reader, kinds)
    ]
    text = class_text(class_name, sources.texts())
    flat_model = FlatModel(
        name=class_name,
        description=readable(flat["model_description"]),
        variables=tuple(variables),
        equations=(),
        relations=(),
        experiment=read_experiment(text),
        documentation=read_documentation(text),
        icon=read_icon(text),
        couplings=read_couplings(text),
        terminals=read_terminals(text),
        claims=read_claims(class_name, sources.texts()),
        examples=read_examples(text),
    )
    return _with_equations(flat_model, flat, reader)


def _with_equations(model: FlatModel, flat: Node, reader: EventReader) -> FlatModel:
    discrete = [
        Alternatives((Assignment(v.name, v.binding, v.origin),))
        for v in model.variables
        if v.variability == "discrete" and v.binding is not None and v.causality != "input"
    ]
    equations: list[Equation] = []
    taken = assigned_names(flat) | reader.declared.constant
    for residual, origin, names in _residuals(flat, reader):
        if alternatives := _discrete_equation(residual, origin, taken, reader, names):
            discrete += alternatives
        else:
            equations += _scalars(residual, origin, reader, names)
    complete = replace(
        model,
        equations=tuple(equations),
        discrete=tuple(discrete),
        whens=read_whens(flat, reader),
        algorithms=read_algorithms(flat["algorithms"], reader),
        checks=(*read_checks(flat, reader), *reader.asserted),
        initial_algorithms=read_algorithms(flat["initial_algorithms"], reader),
        initial_equations=tuple(
            Equation(scalar, _equation_origin(node, reader.sources))
            for node in flat["initial_equations"]
            for scalar in elements(reader.read_event_free(node["residual"]))
        ),
    )
    return replace(
        complete,
        variables=(*_structural(model, reader), *_shared_variables(reader)),
        equations=(*equations, *(Equation(symbol(a.target) - a.expression, a.origin) for a in reader.shared)),
        relations=tuple(reader.relations),
        samples=tuple(reader.samples),
        rounded=tuple(reader.rounded),
    )


def _shared_variables(reader: EventReader) -> list[Variable]:
    return [Variable(a.target, "Part of an expression", hidden=True, origin=a.origin) for a in reader.shared]


def _structural(model: FlatModel, reader: EventReader) -> tuple[Variable, ...]:
    """The variables; parameters that subscripts or sizes have been calculated from cannot be set any more."""
    names = reader.components.structural
    return tuple(
        replace(v, final=True, binding=reader.components.number(v.binding))
        if v.name in names and v.binding is not None
        else v
        for v in model.variables
    )


def _residuals(flat: Node, reader: EventReader) -> Iterator[tuple[Node, str, dict[str, Value]]]:
    """All equations, with their loop variables. rumoca leaves most of a long `for` to a template, and zeros in its
    place."""
    templates = {s["first_equation_index"]: s for s in flat["structured_equations"] if not s["interiors_materialized"]}
    nodes = flat["equations"]
    index = 0
    while index < len(nodes):
        origin = _equation_origin(nodes[index], reader.sources)
        if loop := templates.get(index):
            for names in _points(loop["domain"]["binders"]):
                for residual in loop["template"]["body"]:
                    yield residual, origin, names
                    index += 1
        else:
            yield nodes[index]["residual"], origin, {}
            index += 1


def _points(binders: list[dict[str, Any]]) -> Iterator[dict[str, Value]]:
    """The values of the loop variables, the last one changing fastest."""
    ranges = [range(b["lower"], b["upper"] + (1 if b["step"] > 0 else -1), b["step"]) for b in binders]
    for point in itertools.product(*ranges):
        yield {b["display_name"]: sympy.Integer(i) for b, i in zip(binders, point, strict=True)}


def _scalars(residual: dict[str, Any], origin: str, reader: EventReader, names: dict[str, Value]) -> Iterator[Equation]:
    with reader.equation(origin, names):
        value = reader.read(residual)
    yield from (Equation(scalar, origin) for scalar in elements(value) if scalar is not None)


def _discrete_equation(
    residual: Node, origin: str, taken: frozenset[str], reader: EventReader, names: dict[str, Value]
) -> list[Alternatives]:
    """An equation between discrete variables as the assignments that it may be, one for each element of an array;
    none if it is another equation, such as ``der(x) = k``: what changes in between events gives no Integer its value.
    """
    body = residual.get("Binary")
    if body is None or body["op"] != "Sub":
        return []
    if "Tuple" in body["lhs"]:
        return _discrete_outputs(body, origin, taken, reader)
    options = []
    determines_other = False
    with reader.equation(origin, names), reader.inside_branch():
        for one, other in ((body["lhs"], body["rhs"]), (body["rhs"], body["lhs"])):
            target = reader.read(one) if "VarRef" in one else ()
            known = {s.name if s.is_Symbol else "" for s in elements(target)}
            if known and known <= reader.declared.discrete and not known & taken:
                values = elements_for(target, reader.read(other))
                if any(is_continuous(value, reader.declared.still) for value in values):
                    determines_other = True
                    continue
                pairs = zip(elements(target), values, strict=True)
                options.append([Assignment(s.name, value, origin) for s, value in pairs])
    if options:
        return [Alternatives(alternatives) for alternatives in zip(*options, strict=True)]
    if reader.is_discrete_valued(body["lhs"]) and not determines_other:
        text = reader.sources.text(body["span"]) if "span" in body else ""
        raise BuildError(f"{origin}: {text}: an equation between discrete variables must read: name = expression")
    return []


def _discrete_outputs(body: Node, origin: str, taken: frozenset[str], reader: EventReader) -> list[Alternatives]:
    """``(a, b) = f(x)`` between discrete variables as assignments; none if it is another equation."""
    with reader.equation(origin), reader.inside_branch():
        pairs = [
            pair
            for part, value in reader.parts(body)
            for pair in zip(elements(part), elements_for(part, value), strict=True)
        ]
    names = {s.name if s.is_Symbol else "" for s, _ in pairs}
    if not names <= reader.declared.discrete or names & taken:
        return []
    return [Alternatives((Assignment(s.name, value, origin),)) for s, value in pairs]


def _equation_origin(node: dict[str, Any], sources: Sources) -> str:
    kind, detail = next(iter(node["origin"].items())) if isinstance(node["origin"], dict) else (node["origin"], {})
    if kind == "Connection":
        return f"connect({detail['lhs']}, {detail['rhs']})"
    if kind == "FlowSum":
        return str(detail["description"])
    return sources.place(node["span"])
