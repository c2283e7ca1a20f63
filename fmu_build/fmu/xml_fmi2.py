"""An Interface to the text of modelDescription.xml, FMI 2.0 (Co-Simulation and Model Exchange)."""

from __future__ import annotations

from collections.abc import Sequence

from lxml import etree

from ..ir.models import Claims
from .interface import GENERATION_TOOL, Dependencies, Entry, Interface
from .xml_common import add_claims, add_items, add_log_categories, add_units, dependencies, to_bytes

CAPABILITIES = {
    "canGetAndSetFMUstate": "true",
    "canSerializeFMUstate": "true",
    "providesDirectionalDerivative": "true",
}
CO_SIMULATION = {
    "canHandleVariableCommunicationStepSize": "true",
    "canInterpolateInputs": "true",
    "maxOutputDerivativeOrder": "1",
}


def describe(interface: Interface, claims: Claims, token: str, sources: Sequence[str]) -> bytes:
    """modelDescription.xml, with ``token`` as its guid and the C files ``sources`` of the folder sources/."""
    root = etree.Element(
        "fmiModelDescription",
        fmiVersion="2.0",
        modelName=interface.name,
        guid=token,
        description=interface.description,
        generationTool=GENERATION_TOOL,
        variableNamingConvention="structured",
        numberOfEventIndicators=str(len(interface.event_indicators)),
    )
    add_claims(root, claims)
    identity = {"modelIdentifier": interface.identifier}
    for tag, capabilities in (
        (
            "ModelExchange",
            CAPABILITIES | ({} if interface.has_checks else {"completedIntegratorStepNotNeeded": "true"}),
        ),
        ("CoSimulation", CAPABILITIES | CO_SIMULATION),
    ):
        kind = etree.SubElement(root, tag, identity | capabilities)
        files = etree.SubElement(kind, "SourceFiles")
        for name in sources:
            etree.SubElement(files, "File", name=name)
    add_units(root, interface.units)
    _add_types(root, interface)
    add_log_categories(root)
    etree.SubElement(root, "DefaultExperiment", interface.experiment)
    listing = etree.SubElement(root, "ModelVariables")
    index = {entry.name: position for position, entry in enumerate(interface.entries, start=1)}
    for entry in interface.entries:
        _scalar_variable(listing, entry, index)
    structure = etree.SubElement(root, "ModelStructure")
    _unknowns(structure, "Outputs", interface.outputs, index)
    _unknowns(structure, "Derivatives", interface.derivatives, index)
    _unknowns(structure, "InitialUnknowns", interface.initial_unknowns, index)
    return to_bytes(root)


def _add_types(root: etree._Element, interface: Interface) -> None:
    if interface.enumerations:
        definitions = etree.SubElement(root, "TypeDefinitions")
        for enumeration in interface.enumerations:
            kind = etree.SubElement(definitions, "SimpleType", name=enumeration.name)
            add_items(etree.SubElement(kind, "Enumeration"), enumeration)


def _scalar_variable(listing: etree._Element, entry: Entry, index: dict[str, int]) -> None:
    attributes = {"name": entry.name, "valueReference": str(entry.reference)}
    if entry.variable.description:
        attributes["description"] = entry.variable.description
    attributes |= {"causality": entry.causality, "variability": entry.variability}
    if entry.initial:
        attributes["initial"] = entry.initial
    value = dict(entry.attributes)
    if entry.variable.enumeration:
        value = {"declaredType": entry.variable.enumeration.name} | value
    if entry.start_text is not None:
        value["start"] = entry.start_text
    if entry.derivative_of:
        value["derivative"] = str(index[entry.derivative_of])
    etree.SubElement(etree.SubElement(listing, "ScalarVariable", attributes), entry.variable.type, value)


def _unknowns(structure: etree._Element, tag: str, unknowns: Dependencies, index: dict[str, int]) -> None:
    if unknowns:
        element = etree.SubElement(structure, tag)
        for name, knowns in unknowns.items():
            etree.SubElement(element, "Unknown", {"index": str(index[name])} | dependencies(knowns, index))
