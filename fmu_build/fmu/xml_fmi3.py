"""An Interface to the XML files of FMI 3.0: modelDescription.xml, buildDescription.xml, terminalsAndIcons.xml."""

from __future__ import annotations

from collections.abc import Sequence

from lxml import etree

from ..ir.models import Claims
from .interface import GENERATION_TOOL, Dependencies, Entry, Interface
from .xml_common import add_claims, add_items, add_log_categories, add_units, dependencies, to_bytes

CAPABILITIES = {
    "canGetAndSetFMUState": "true",
    "canSerializeFMUState": "true",
    "providesDirectionalDerivatives": "true",
    "providesAdjointDerivatives": "true",
    "providesPerElementDependencies": "true",
    "providesEvaluateDiscreteStates": "true",
}
ELEMENTS = {"Real": "Float64", "Integer": "Int32", "Boolean": "Boolean", "Enumeration": "Enumeration"}
CO_SIMULATION = {
    "canHandleVariableCommunicationStepSize": "true",
    "maxOutputDerivativeOrder": "1",
    "providesIntermediateUpdate": "true",
    "mightReturnEarlyFromDoStep": "true",
    "canReturnEarlyAfterIntermediateUpdate": "true",
    "hasEventMode": "true",
}


def describe(interface: Interface, claims: Claims, token: str) -> bytes:
    """modelDescription.xml, with ``token`` as its instantiation token."""
    root = etree.Element(
        "fmiModelDescription",
        fmiVersion="3.0",
        modelName=interface.name,
        instantiationToken=token,
        description=interface.description,
        generationTool=GENERATION_TOOL,
        variableNamingConvention="structured",
    )
    add_claims(root, claims)
    steps = {"needsCompletedIntegratorStep": "true"} if interface.has_checks else {}
    etree.SubElement(root, "ModelExchange", {"modelIdentifier": interface.identifier} | CAPABILITIES | steps)
    etree.SubElement(root, "CoSimulation", {"modelIdentifier": interface.identifier} | CAPABILITIES | CO_SIMULATION)
    add_units(root, interface.units)
    if interface.enumerations:
        definitions = etree.SubElement(root, "TypeDefinitions")
        for enumeration in interface.enumerations:
            add_items(etree.SubElement(definitions, "EnumerationType", name=enumeration.name), enumeration)
    add_log_categories(root)
    etree.SubElement(root, "DefaultExperiment", interface.experiment)
    listing = etree.SubElement(root, "ModelVariables")
    entries = (*interface.entries, *interface.event_indicators)
    reference = {entry.name: entry.reference for entry in entries}
    for entry in entries:
        _variable(listing, entry, reference)
    structure = etree.SubElement(root, "ModelStructure")
    _unknowns(structure, "Output", interface.outputs, reference)
    _unknowns(structure, "ContinuousStateDerivative", interface.derivatives, reference)
    _unknowns(structure, "InitialUnknown", interface.initial_unknowns, reference)
    _unknowns(structure, "EventIndicator", interface.indicator_sources, reference)
    return to_bytes(root)


def describe_build(identifier: str, sources: Sequence[str]) -> bytes:
    """sources/buildDescription.xml: one set of C11 files, the C and mathematical libraries, FMI's headers."""
    root = etree.Element("fmiBuildDescription", fmiVersion="3.0")
    configuration = etree.SubElement(root, "BuildConfiguration", modelIdentifier=identifier)
    files = etree.SubElement(configuration, "SourceFileSet", language="C11")
    for name in sources:
        etree.SubElement(files, "SourceFile", name=name)
    etree.SubElement(
        files,
        "PreprocessorDefinition",
        name="FMI3_OVERRIDE_FUNCTION_PREFIX",
        optional="true",
        value="1",
        description="For a shared library, whose functions bear the standard's own names",
    )
    etree.SubElement(configuration, "Library", name="m", external="true", description="C mathematical library")
    return to_bytes(root)


def describe_ports(interface: Interface) -> bytes:
    """terminalsAndIcons/terminalsAndIcons.xml: where the icon's picture lies in Modelica's coordinates, and what is to
    be connected together.

    The matching rule "plug" connects members of equal name. What is across, such as a speed, is passed on as a signal.
    What flows, such as a force along the line that both ends lie on (a flow of momentum), has a direction: inflow into
    the unit or outflow from it, and an output that flows out fits an input that flows in as it is.
    """
    root = etree.Element("fmiTerminalsAndIcons", fmiVersion="3.0")
    graphics = etree.SubElement(root, "GraphicalRepresentation")
    corners = {"x1": "-100", "y1": "-100", "x2": "100", "y2": "100"}
    etree.SubElement(graphics, "CoordinateSystem", corners, suggestedScalingFactorTo_mm="0.1")
    etree.SubElement(graphics, "Icon", corners)
    terminals = etree.SubElement(root, "Terminals") if interface.terminals else root
    for terminal in interface.terminals:
        element = etree.SubElement(terminals, "Terminal", name=terminal.name, matchingRule="plug")
        for member in terminal.members:
            attributes = {"variableName": member.variable, "memberName": member.name, "variableKind": member.kind}
            etree.SubElement(element, "TerminalMemberVariable", attributes)
    return to_bytes(root)


def _variable(listing: etree._Element, entry: Entry, reference: dict[str, int]) -> None:
    attributes = {"name": entry.name, "valueReference": str(entry.reference)}
    if entry.variable.description:
        attributes["description"] = entry.variable.description
    attributes |= {"causality": entry.causality, "variability": entry.variability}
    if entry.causality == "output":
        attributes["intermediateUpdate"] = "true"  # may be read between communication points
    if entry.initial:
        attributes["initial"] = entry.initial
    if entry.variable.enumeration:
        attributes["declaredType"] = entry.variable.enumeration.name
    attributes |= entry.attributes
    if entry.start_text is not None:
        attributes["start"] = entry.start_text
    if entry.derivative_of:
        attributes["derivative"] = str(reference[entry.derivative_of])
    etree.SubElement(listing, ELEMENTS[entry.variable.type], attributes)


def _unknowns(structure: etree._Element, tag: str, unknowns: Dependencies, reference: dict[str, int]) -> None:
    for name, knowns in unknowns.items():
        etree.SubElement(structure, tag, {"valueReference": str(reference[name])} | dependencies(knowns, reference))
