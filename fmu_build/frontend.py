"""Modelica text to a FlatModel. Every touch of rumoca is in this module and in loading.py.

rumoca (pinned exactly, see docs/dependencies.md) parses, resolves, checks and flattens. We read its flat form, a JSON
tree.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
import rumoca
import sympy
from numpy.typing import NDArray

from .annotations import (
    class_text,
    read_couplings,
    read_documentation,
    read_examples,
    read_experiment,
    read_icon,
    read_terminals,
)
from .clauses import assigned_names, read_algorithms, read_checks, read_whens
from .components import element_names, elements_for, spread
from .errors import BuildError
from .event_expressions import Declared, EventReader, enumeration_types
from .expressions import unwrap
from .ir import FlatModel, Simulation
from .ir_equations import Assignment, EnumerationType, Equation, Variable
from .ir_events import Alternatives
from .loading import load
from .sources import Sources
from .symbols import symbol
from .values import Value, elements

Node = dict[str, Any]
REFERENCE_TOLERANCES = (1e-9, 1e-11)  # relative; the difference between the two tells the accuracy
STATE_SELECT = {"Never": -2, "Avoid": -1, "Default": 0, "Prefer": 1, "Always": 2}


def flatten(path: Path, class_name: str) -> FlatModel:
    """The class ``class_name`` of the Modelica file or library folder ``path``, flattened.

    Raises BuildError, with file and line, where the Modelica does not compile or uses what is not supported.
    """
    model, sources = load(path, class_name)
    flat = model.to_dict("flat")
    declared = _declared(flat)
    fixed = _fixed(flat)
    reader = EventReader(sources, declared, flat, fixed)
    kinds = enumeration_types(flat)
    variables = [
        variable
        for name, node in flat["variables"].items()
        if name not in fixed and not _is_text(node, flat)
        for variable in _variables(node, flat, reader, kinds)
    ]
    text = class_text(class_name, sources.texts())
    flat_model = FlatModel(
        name=class_name,
        description=flat["model_description"] or "",
        variables=tuple(variables),
        equations=(),
        relations=(),
        experiment=read_experiment(text),
        documentation=read_documentation(text),
        icon=read_icon(text),
        couplings=read_couplings(text),
        terminals=read_terminals(text),
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
    for residual, origin, names in _residuals(flat, reader):
        if alternatives := _discrete_equation(residual, origin, flat, reader, names):
            discrete += alternatives
        else:
            equations += _scalars(residual, origin, reader, names)
    complete = replace(
        model,
        equations=tuple(equations),
        discrete=tuple(discrete),
        whens=read_whens(flat, reader),
        algorithms=read_algorithms(flat["algorithms"], reader),
        checks=read_checks(flat, reader),
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
    residual: Node, origin: str, flat: Node, reader: EventReader, names: dict[str, Value]
) -> list[Alternatives]:
    """An equation between discrete variables as the assignments that it may be, one for each element of an array;
    none if it is another equation."""
    body = residual.get("Binary")
    if body is None or body["op"] != "Sub":
        return []
    taken = assigned_names(flat) | reader.declared.constant
    options = []
    with reader.equation(origin, names), reader.inside_branch():
        for one, other in ((body["lhs"], body["rhs"]), (body["rhs"], body["lhs"])):
            target = reader.read(one) if "VarRef" in one else ()
            known = {s.name if s.is_Symbol else "" for s in elements(target)}
            if known and known <= reader.declared.discrete and not known & taken:
                values = elements_for(target, reader.read(other))
                pairs = zip(elements(target), values, strict=True)
                options.append([Assignment(s.name, value, origin) for s, value in pairs])
    if options:
        return [Alternatives(alternatives) for alternatives in zip(*options, strict=True)]
    if reader.is_discrete_valued(body["lhs"]):
        text = reader.sources.text(body["span"]) if "span" in body else ""
        raise BuildError(f"{origin}: {text}: an equation between discrete variables must read: name = expression")
    return []


def simulate(path: Path, class_name: str) -> Simulation:
    """rumoca's own simulation of the class ``class_name`` over the time of its experiment annotation.

    Raises BuildError where it does not compile, does not run, or has no experiment annotation.
    """
    model, sources = load(path, class_name)
    experiment = read_experiment(class_text(class_name, sources.texts()))
    if experiment.stop_time is None or experiment.interval is None:
        raise BuildError(
            f"{class_name}: a reference needs StopTime and Interval in an experiment annotation of its own"
        )
    start = experiment.start_time or 0.0
    count = round((experiment.stop_time - start) / experiment.interval)
    times = np.linspace(start, experiment.stop_time, count + 1)
    coarse, fine = (_columns(model, times, tolerance) for tolerance in REFERENCE_TOLERANCES)
    return Simulation(
        class_name=class_name,
        tool=f"rumoca {version('rumoca')}",
        tolerances=REFERENCE_TOLERANCES,
        times=tuple(times.tolist()),
        columns={name: tuple(values.tolist()) for name, values in fine.items()},
        accuracy={name: float(np.abs(fine[name] - coarse[name]).max()) for name in fine},
        parameters={p.name: float(p.value) for p in model.parameters if p.value is not None},
    )


def _columns(model: rumoca.Model, times: NDArray[np.float64], tolerance: float) -> dict[str, NDArray[np.float64]]:
    """Every variable at ``times``. rumoca adds rows at its events, so rows are chosen by their time."""
    config = rumoca.SimConfig(solver="rk-like", rtol=tolerance, atol=tolerance, max_wall_seconds=60)
    try:
        result = model.simulate(t=(times[0], times[-1]), dt=times[1] - times[0], config=config)
    except rumoca.RumocaError as error:
        raise BuildError(f"{model.name}: its simulation failed: {str(error).splitlines()[0]}") from None
    rows = np.abs(np.asarray(result.time)[:, None] - times).argmin(axis=0)
    if np.abs(np.asarray(result.time)[rows] - times).max() > 1e-9 * (times[-1] - times[0]):
        raise BuildError(f"{model.name}: its simulation ended early, at {result.time[-1]:g} s")
    return {name: np.asarray(result[name])[rows] for name in result.names}


def _fixed(flat: Node) -> frozenset[str]:
    """Names that are put in as values: constants, and parameters that rumoca has already put in somewhere."""
    chosen = {".".join(reference) for s in flat.get("parameter_branch_selections", ()) for reference in s["references"]}
    return frozenset(
        name
        for name, node in flat["variables"].items()
        if node["binding"] is not None and flat["variable_type_names"].get(name) != "String"
        if unwrap(node["variability"]) == "Constant" or (unwrap(node["variability"]) == "Parameter" and name in chosen)
    )


def _is_text(node: Node, flat: Node) -> bool:
    """A String parameter or constant: there is nothing to compute with it."""
    return flat["variable_type_names"].get(node["name"]) == "String" and unwrap(node["variability"]) in {
        "Parameter",
        "Constant",
    }


def _declared(flat: Node) -> Declared:
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


def _variables(node: Node, flat: Node, reader: EventReader, kinds: dict[str, EnumerationType]) -> list[Variable]:
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


def _equation_origin(node: dict[str, Any], sources: Sources) -> str:
    kind, detail = next(iter(node["origin"].items())) if isinstance(node["origin"], dict) else (node["origin"], {})
    if kind == "Connection":
        return f"connect({detail['lhs']}, {detail['rhs']})"
    if kind == "FlowSum":
        return str(detail["description"])
    return sources.place(node["span"])
