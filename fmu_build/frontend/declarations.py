"""Declarations of rumoca's flat form as variables: types, attributes, start values, which names stand for values."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import sympy

from ..errors import BuildError
from ..ir.equations import EnumerationType, Variable, is_free
from .clauses import assigned_names
from .components import element_names, spread
from .event_expressions import Declared, EventReader, enumeration_types
from .expressions import unwrap
from .sources import readable
from .standard_tables import is_table
from .values import elements

Node = dict[str, Any]
STATE_SELECT = {"Never": -2, "Avoid": -1, "Default": 0, "Prefer": 1, "Always": 2}


def fixed_names(flat: Node) -> frozenset[str]:
    """Names that are put in as values: constants, parameters that rumoca has already put in somewhere, and tables."""
    chosen = {".".join(reference) for s in flat.get("parameter_branch_selections", ()) for reference in s["references"]}
    return frozenset(
        name
        for name, node in flat["variables"].items()
        if node["binding"] is not None and flat["variable_type_names"].get(name) != "String"
        if unwrap(node["variability"]) == "Constant"
        or (unwrap(node["variability"]) == "Parameter" and name in chosen)
        or _is_table(node["binding"], flat)
    )


def _is_table(binding: Node, flat: Node) -> bool:
    call = binding.get("FunctionCall")
    return call is not None and is_table(flat["functions"].get(call["name"]["name"]))


def is_text(node: Node, flat: Node) -> bool:
    """A String parameter or constant: there is nothing to compute with it."""
    return flat["variable_type_names"].get(node["name"]) == "String" and unwrap(node["variability"]) in {
        "Parameter",
        "Constant",
    }


def declared_names(flat: Node) -> Declared:
    """Which names are discrete, and which are constant."""
    types, discrete, constant, assigned = {}, set(), set(), assigned_names(flat)
    enumerations = enumeration_types(flat)
    for name, node in flat["variables"].items():
        kind = flat["variable_type_names"].get(name, "Real")
        variability = unwrap(node["variability"])
        types[name] = "Enumeration" if kind in enumerations else kind
        names = [name, *_names(node)]
        types.update(dict.fromkeys(names, types[name]))
        if variability in {"Parameter", "Constant"}:
            constant.update(names)
        if variability == "Discrete" or kind != "Real" or name in assigned:
            discrete.update(names)
    return Declared(types, frozenset(discrete), frozenset(constant), flat["enum_literal_ordinals"])


def _names(node: Node) -> list[str]:
    """The names of all elements; its own if it is no array."""
    return element_names(node["name"], node["dims"]) if node["dims"] else [node["name"]]


def _variability(node: Node, declared: Declared) -> str:
    named = {"Parameter": "parameter", "Constant": "constant"}.get(unwrap(node["variability"]))
    return named or ("discrete" if node["name"] in declared.discrete else "continuous")


def variables_of(node: Node, flat: Node, reader: EventReader, kinds: dict[str, EnumerationType]) -> list[Variable]:
    """A variable, or one for each element of an array."""
    whole = _whole(node, flat, reader, kinds)
    names = _names(node)
    is_open = whole.variability == "continuous" and _has_no_start(node)
    given = node["fixed"] if isinstance(node["fixed"], list) else [node["fixed"]]
    fixed = [whole.variability == "parameter" if f is None else bool(f) for f in given or [None]]
    attributes = zip(
        names,
        _expressions("start", node, whole, reader),
        fixed * len(names) if len(fixed) == 1 else fixed,
        _expressions("binding", node, whole, reader),
        *(_numbers(key, node, whole, reader) for key in ("min", "max", "nominal")),
        strict=True,
    )
    variables = [
        replace(
            whole,
            name=element,
            start=None if is_open and not is_fixed else start,
            fixed=is_fixed,
            binding=binding,
            min=lowest,
            max=highest,
            nominal=nominal,
            guess=_guess(start, reader),
        )
        for element, start, is_fixed, binding, lowest, highest, nominal in attributes
    ]
    return [_from_outside(v, reader) for v in variables]


def _whole(node: Node, flat: Node, reader: EventReader, kinds: dict[str, EnumerationType]) -> Variable:
    """What a declaration says of all elements; BuildError where its type is not supported."""
    name, origin = node["name"], reader.sources.place(node["source_span"])
    kind = reader.declared.types[name]
    if kind not in {"Real", "Integer", "Boolean", "Enumeration"}:
        raise BuildError(f"{origin}: {name} is of type {kind}: supported are Real, Integer, Boolean and enumerations")
    causality = unwrap(node["causality"]).lower()
    is_port = "." not in name and causality in {"input", "output"}
    return Variable(
        name=name,
        description=readable(node["description"]),
        unit=node["unit"] or "",
        display_unit=node["display_unit"] or "",
        quantity=node["quantity"] or "",
        causality=causality if is_port else "local",
        variability=_variability(node, reader.declared),
        type=kind,
        enumeration=kinds.get(flat["variable_type_names"].get(name, "")),
        has_start_of_type=any(reader.sources.is_in_type(span) for span in _spans(node["start"])),
        hidden=bool(node["is_protected"]),
        final=bool(flat["variable_final_flags"].get(name, False)),
        state_select=STATE_SELECT[unwrap(node["state_select"])],
        origin=origin,
    )


def _expressions(key: str, node: Node, whole: Variable, reader: EventReader) -> list[sympy.Expr | None]:
    """The values of an attribute, one for each element; None where it is not given."""
    if node[key] is None:
        return [None] * len(_names(node))
    if key == "binding" and whole.variability == "continuous":
        with reader.equation(whole.origin):
            value = reader.read(node[key])
    elif key == "binding" and whole.variability == "discrete":
        value = reader.read(node[key])
    else:
        value = reader.read_event_free(node[key])
    return elements(spread(value, node["dims"])) if node["dims"] else [value]


def _numbers(key: str, node: Node, whole: Variable, reader: EventReader) -> list[float | None]:
    """The same as numbers."""
    values = _expressions(key, node, whole, reader)
    return [None if value is None else _number(value, key, whole, reader) for value in values]


def _from_outside(variable: Variable, reader: EventReader) -> Variable:
    """The variable; what is set from outside starts from a number. An input that is declared with one starts from that;
    one with another expression is none of the unit's."""
    if variable.causality == "input" and variable.binding is not None:
        if not variable.binding.is_number:
            return replace(variable, causality="local")
        variable = replace(variable, start=variable.binding, binding=None)
    is_parameter = variable.variability == "parameter" and variable.binding is None and not is_free(variable)
    if variable.start is None or not (variable.causality == "input" or is_parameter):
        return variable
    return replace(variable, start=sympy.sympify(_number(variable.start, "start", variable, reader)))


def _spans(node: Any) -> list[dict[str, int]]:
    """The place of an expression, as far as it is known."""
    body = next(iter(node.values())) if node else {}
    return [body["span"]] if "span" in body else []


def _has_no_start(node: Node) -> bool:
    """Whether no start value is declared: rumoca then puts in a zero that stands where the component does."""
    return node["start"] is None or _spans(node["start"]) == [node["component_ref"]["span"]]


def _guess(start: sympy.Expr | None, reader: EventReader) -> float:
    number = sympy.Integer(0) if start is None else reader.components.number(start)
    return float(number) if number.is_number else 0.0


def _number(value: sympy.Expr, key: str, whole: Variable, reader: EventReader) -> float:
    number = reader.components.number(value)
    if not number.is_number:
        raise BuildError(
            f"{whole.origin}: {key} of {whole.name} is {value}: give it a number, or an expression of parameters"
        )
    return float(number)
