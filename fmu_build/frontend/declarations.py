"""Declarations of rumoca's flat form as variables: types, attributes, start values, which names stand for values."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import sympy

from ..errors import BuildError
from ..ir.equations import EnumerationType, Variable
from .clauses import assigned_names
from .components import element_names, spread
from .event_expressions import Declared, EventReader, enumeration_types
from .expressions import unwrap
from .values import elements

Node = dict[str, Any]


STATE_SELECT = {"Never": -2, "Avoid": -1, "Default": 0, "Prefer": 1, "Always": 2}


def fixed_names(flat: Node) -> frozenset[str]:
    """Names that are put in as values: constants, and parameters that rumoca has already put in somewhere."""
    chosen = {".".join(reference) for s in flat.get("parameter_branch_selections", ()) for reference in s["references"]}
    return frozenset(
        name
        for name, node in flat["variables"].items()
        if node["binding"] is not None and flat["variable_type_names"].get(name) != "String"
        if unwrap(node["variability"]) == "Constant" or (unwrap(node["variability"]) == "Parameter" and name in chosen)
    )


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
        names = [name, *(element_names(name, node["dims"]) if node["dims"] else ())]
        types.update(dict.fromkeys(names, types[name]))
        if variability in {"Parameter", "Constant"}:
            constant.update(names)
        if variability == "Discrete" or kind != "Real" or name in assigned:
            discrete.update(names)
    return Declared(types, frozenset(discrete), frozenset(constant), flat["enum_literal_ordinals"])


def _variability(node: Node, declared: Declared) -> str:
    named = {"Parameter": "parameter", "Constant": "constant"}.get(unwrap(node["variability"]))
    return named or ("discrete" if node["name"] in declared.discrete else "continuous")


def variables_of(node: Node, flat: Node, reader: EventReader, kinds: dict[str, EnumerationType]) -> list[Variable]:
    """A variable, or one for each element of an array."""
    name, origin, dims = node["name"], reader.sources.place(node["source_span"]), node["dims"]
    kind = reader.declared.types[name]
    variability = _variability(node, reader.declared)
    if kind not in {"Real", "Integer", "Boolean", "Enumeration"}:
        raise BuildError(f"{origin}: {name} is of type {kind}: supported are Real, Integer, Boolean and enumerations")

    def expressions(key: str) -> list[sympy.Expr | None]:
        if node[key] is None:
            return [None] * len(names)
        if key == "binding" and variability == "continuous":
            with reader.equation(origin):
                value = reader.read(node[key])
        else:
            value = (reader.read if key == "binding" and variability == "discrete" else reader.read_event_free)(
                node[key]
            )
        return elements(spread(value, dims)) if dims else [value]

    def numbers(key: str) -> list[float | None]:
        return [None if v is None else _number(v, key, name, origin, reader) for v in expressions(key)]

    names = element_names(name, dims) if dims else [name]
    is_open = variability == "continuous" and _has_no_start(node)
    is_of_type = any(reader.sources.is_in_type(span) for span in _spans(node["start"]))
    is_top_level = "." not in name
    causality = unwrap(node["causality"]).lower()
    given = node["fixed"] if isinstance(node["fixed"], list) else [node["fixed"]]
    fixed = [variability == "parameter" if f is None else bool(f) for f in given or [None]]
    attributes = zip(
        names,
        expressions("start"),
        fixed * len(names) if len(fixed) == 1 else fixed,
        expressions("binding"),
        numbers("min"),
        numbers("max"),
        numbers("nominal"),
        strict=True,
    )
    variables = [
        Variable(
            name=element,
            description=node["description"] or "",
            unit=node["unit"] or "",
            quantity=node["quantity"] or "",
            causality=causality if is_top_level and causality in {"input", "output"} else "local",
            variability=variability,
            type=kind,
            enumeration=kinds.get(flat["variable_type_names"].get(name, "")),
            start=None if is_open and not is_fixed else start,
            has_start_of_type=is_of_type,
            fixed=is_fixed,
            binding=binding,
            min=lowest,
            max=highest,
            nominal=nominal,
            guess=_guess(start, reader),
            hidden=bool(node["is_protected"]),
            final=bool(flat["variable_final_flags"].get(name, False)),
            state_select=STATE_SELECT[unwrap(node["state_select"])],
            origin=origin,
        )
        for element, start, is_fixed, binding, lowest, highest, nominal in attributes
    ]
    return [_with_value(v) if v.causality == "input" and v.binding is not None else v for v in variables]


def _with_value(variable: Variable) -> Variable:
    """An input that is declared with a number starts from it; one with another expression is none of the unit's."""
    if variable.binding is not None and variable.binding.is_number:
        return replace(variable, start=variable.binding, binding=None)
    return replace(variable, causality="local")


def _spans(node: Any) -> list[dict[str, int]]:
    """The place of an expression, as far as it is known."""
    body = next(iter(node.values())) if node else {}
    return [body["span"]] if "span" in body else []


def _has_no_start(node: Node) -> bool:
    """Whether no start value is declared: rumoca then puts in a zero that stands where the component does."""
    literal = node["start"] and node["start"].get("Literal")
    place = node["component_ref"]["span"]
    return literal is None or (literal["span"]["start"], literal["span"]["end"]) == (place["start"], place["end"])


def _guess(start: sympy.Expr | None, reader: EventReader) -> float:
    number = sympy.Integer(0) if start is None else reader.components.number(start)
    return float(number) if number.is_number else 0.0


def _number(value: sympy.Expr, key: str, name: str, origin: str, reader: EventReader) -> float:
    number = reader.components.number(value)
    if not number.is_number:
        raise BuildError(f"{origin}: {key} of {name} is {value}: give it a number, or an expression of parameters")
    return float(number)
