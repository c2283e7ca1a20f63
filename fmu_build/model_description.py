"""A SortedModel to the text of modelDescription.xml, FMI 2.0 (Co-Simulation)."""

from __future__ import annotations

from collections.abc import Iterable

from lxml import etree

from .ir import DEFAULT_TOLERANCE, TIME, SortedModel, Variable
from .slices import dependencies, start_value, tunable_parameters
from .units import base_unit

GENERATION_TOOL = "OverrunHitch fmu_build"
LOG_CATEGORIES = {
    "logStatusError": "Errors: what was refused or failed, and what is allowed",
    "logStatusWarning": "Warnings",
    "logEvents": "Times at which relations switch",
}


Role = tuple[str, str, str | None]  # causality, variability, initial


def describe(model: SortedModel, identifier: str, token: str) -> bytes:
    """modelDescription.xml, with ``token`` as its guid."""
    variables = _listed(model)
    index = {variable.name: position for position, variable in enumerate(variables, start=1)}
    root = etree.Element(
        "fmiModelDescription",
        fmiVersion="2.0",
        modelName=model.name,
        guid=token,
        description=model.description,
        generationTool=GENERATION_TOOL,
        variableNamingConvention="structured",
    )
    etree.SubElement(root, "CoSimulation", modelIdentifier=identifier, canHandleVariableCommunicationStepSize="true")
    _units(root, sorted({v.unit for v in variables if v.unit}))
    categories = etree.SubElement(root, "LogCategories")
    for name, description in LOG_CATEGORIES.items():
        etree.SubElement(categories, "Category", name=name, description=description)
    _default_experiment(root, model)
    listing = etree.SubElement(root, "ModelVariables")
    roles = _roles(variables, model)
    for variable in variables:
        _scalar_variable(listing, variable, roles[variable.name], model, index)
    _structure(root, model, roles, index)
    return bytes(etree.tostring(root, xml_declaration=True, encoding="UTF-8", pretty_print=True))


def _listed(model: SortedModel) -> list[Variable]:
    """What users see: everything public, states in any case; of parameters only those that are not mere copies."""
    references = model.value_references
    result = [Variable(TIME, "Time", unit="s")]
    for variable in model.variables.values():
        name = variable.name
        is_copy = variable.variability == "parameter" and name in model.aliases
        is_known = model.aliases.get(name, name) in references
        if is_known and not is_copy and (not variable.hidden or name in {*model.states, *model.derivatives}):
            result.append(variable)
    return result


def _units(root: etree._Element, names: Iterable[str]) -> None:
    definitions = etree.SubElement(root, "UnitDefinitions")
    for name in names:
        unit = etree.SubElement(definitions, "Unit", name=name)
        if (base := base_unit(name)) is not None:
            attributes = {symbol: str(power) for symbol, power in base.exponents}
            if base.factor != 1.0:
                attributes["factor"] = repr(base.factor)
            if base.offset != 0.0:
                attributes["offset"] = repr(base.offset)
            etree.SubElement(unit, "BaseUnit", attributes)


def _default_experiment(root: etree._Element, model: SortedModel) -> None:
    experiment = model.experiment
    values = {
        "startTime": experiment.start_time,
        "stopTime": experiment.stop_time,
        "tolerance": experiment.tolerance or DEFAULT_TOLERANCE,
        "stepSize": experiment.interval,
    }
    etree.SubElement(root, "DefaultExperiment", {k: repr(v) for k, v in values.items() if v is not None})


def _scalar_variable(
    listing: etree._Element, variable: Variable, role: Role, model: SortedModel, index: dict[str, int]
) -> None:
    name = variable.name
    root = model.aliases.get(name, name)
    attributes = {"name": name, "valueReference": str(model.value_references[root])}
    if variable.description:
        attributes["description"] = variable.description
    causality, variability, initial = role
    attributes |= {"causality": causality, "variability": variability} | ({"initial": initial} if initial else {})
    element = etree.SubElement(listing, "ScalarVariable", attributes)
    real = {"unit": variable.unit, "quantity": variable.quantity}
    real |= {
        key: repr(value)
        for key, value in (("min", variable.min), ("max", variable.max), ("nominal", variable.nominal))
        if value is not None and not (key == "nominal" and value == 0)
    }
    if initial == "exact" or causality == "input":
        real["start"] = repr(start_value(name, model))
    if name in model.derivatives:
        real["derivative"] = str(index[model.states[model.derivatives.index(name)]])
    etree.SubElement(element, "Real", {key: value for key, value in real.items() if value})


def _roles(variables: list[Variable], model: SortedModel) -> dict[str, Role]:
    tunable = tunable_parameters(model)
    exact_starts = {*model.states} - {a.target for a in model.start_assignments}

    def role(variable: Variable) -> Role:
        name = variable.name
        if name == TIME:
            return "independent", "continuous", None
        if name in model.inputs:
            return "input", "continuous", None
        if variable.variability == "parameter":
            variability = "tunable" if name in tunable else "fixed"
            is_settable = name in model.parameters
            return ("parameter" if is_settable else "calculatedParameter"), variability, _initial(is_settable)
        return variable.causality, "continuous", _initial(name in exact_starts)

    return {variable.name: role(variable) for variable in variables}


def _initial(is_exact: bool) -> str:
    return "exact" if is_exact else "calculated"


def _structure(root: etree._Element, model: SortedModel, roles: dict[str, Role], index: dict[str, int]) -> None:
    """ModelStructure: what depends on what, at a fixed time and at the start."""
    structure = etree.SubElement(root, "ModelStructure")
    sources = dependencies(model)
    outputs = [name for name, (causality, _, _) in roles.items() if causality == "output"]
    during = {*model.states, *model.inputs, TIME}

    def unknowns(tag: str, entries: dict[str, frozenset[str]]) -> None:
        element = etree.SubElement(structure, tag)
        for name, needed in entries.items():
            numbers = " ".join(str(i) for i in sorted(index[n] for n in needed if n in index))
            etree.SubElement(element, "Unknown", index=str(index[name]), dependencies=numbers)

    def now(name: str) -> frozenset[str]:
        root_name = model.aliases.get(name, name)
        return sources.get(root_name, frozenset((root_name,)))

    unknowns("Outputs", {name: now(name) & during for name in outputs})
    if model.states:
        unknowns("Derivatives", {name: now(name) & during for name in model.derivatives})
    starts = _start_sources(model, sources)
    calculated = [a.target for a in model.parameter_assignments if not model.variables[a.target].hidden]
    computed_outputs = [name for name in outputs if roles[name][2] == "calculated"]
    initial = [*computed_outputs, *calculated, *starts, *model.derivatives]
    entries = {name: frozenset().union(*(starts.get(n, {n}) for n in now(name))) for name in initial}
    unknowns("InitialUnknowns", dict(sorted(entries.items(), key=lambda entry: index[entry[0]])))


def _start_sources(model: SortedModel, sources: dict[str, frozenset[str]]) -> dict[str, frozenset[str]]:
    """For each state with a calculated start value the parameters that it depends on."""
    return {
        a.target: frozenset().union(*(sources.get(s.name, frozenset((s.name,))) for s in a.expression.free_symbols))
        for a in model.start_assignments
    }
