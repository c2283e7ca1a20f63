"""XML of SSP 1.0, and of the FMUs that it names."""

from __future__ import annotations

import zipfile
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from lxml import etree

from overrun_hitch.parameters import HitchError

NAMESPACES = {key: f"http://ssp-standard.org/SSP1/SystemStructure{name}" for key, name in
              {"ssd": "Description", "ssv": "ParameterValues", "ssc": "Common"}.items()}  # fmt: skip


@dataclass(frozen=True)
class Described:
    """A unit as its modelDescription.xml tells it."""

    variables: Mapping[str, etree._Element]  # ScalarVariable by name
    units: Mapping[str, etree._Element]  # Unit by name

    def unit(self, name: str) -> str:
        """The unit of measure of the variable `name`."""
        return str(self.variables[name].find("Real").attrib["unit"])  # type: ignore[union-attr]

    def names(self, causality: str) -> list[str]:
        """The variables of that causality ("input"), in the order of the file."""
        return [name for name, variable in self.variables.items() if variable.get("causality") == causality]


def described(fmu: Path, needed: Sequence[str]) -> Described:
    """What the FMU file tells of itself.

    HitchError if it is none, if it is not FMI 2.0 (SSP 1.0 knows no later one), or if a `needed` variable is missing.
    """
    try:
        with zipfile.ZipFile(fmu) as archive:
            root = etree.fromstring(archive.read("modelDescription.xml"))
    except (OSError, KeyError, zipfile.BadZipFile, etree.XMLSyntaxError) as error:
        raise HitchError(f"{fmu} is no FMU: {error}") from None
    if root.get("fmiVersion") != "2.0":
        raise HitchError(f"{fmu} has FMI {root.get('fmiVersion')}: SSP 1.0 takes units of FMI 2.0")
    variables = {str(v.get("name")): v for v in root.findall("ModelVariables/ScalarVariable")}
    missing = [name for name in needed if name not in variables]
    if missing:
        raise HitchError(f"{fmu} is not the unit that is needed: it has no variable {', '.join(missing)}")
    return Described(variables, {str(u.get("name")): u for u in root.findall("UnitDefinitions/Unit")})


def root(tag: str, **attributes: str) -> etree._Element:
    """A root element ("ssd:SystemStructureDescription") that declares its namespaces."""
    prefix, name = tag.split(":")
    nsmap = {key: NAMESPACES[key] for key in (prefix, "ssc")}
    return etree.Element(f"{{{NAMESPACES[prefix]}}}{name}", attributes, nsmap=nsmap)


def add(parent: etree._Element, tag: str, **attributes: str) -> etree._Element:
    """A new last child, "ssd:System"."""
    prefix, name = tag.split(":")
    return etree.SubElement(parent, f"{{{NAMESPACES[prefix]}}}{name}", attributes)


def add_connectors(parent: etree._Element, ports: Iterable[tuple[str, Described]]) -> list[str]:
    """Connectors for variables as their units describe them; the units of measure that they name."""
    used = []
    connectors = add(parent, "ssd:Connectors")
    for name, unit in ports:
        variable = unit.variables[name]
        texts = {"description": str(variable.get("description")), "kind": str(variable.get("causality"))}
        used.append(unit.unit(name))
        add(add(connectors, "ssd:Connector", name=name, **texts), "ssc:Real", unit=used[-1])
    return used


def add_units(parent: etree._Element, tag: str, used: Iterable[str], units: Iterable[Described]) -> None:
    """Definitions of the `used` units of measure. SSP writes the exponents of base units as FMI does."""
    known = {name: definition for unit in units for name, definition in unit.units.items()}
    definitions = add(parent, tag)
    for name in sorted(set(used)):
        base = known[name].find("BaseUnit")
        exponents = {str(key): str(value) for key, value in base.attrib.items()} if base is not None else {}
        add(add(definitions, "ssc:Unit", name=name), "ssc:BaseUnit", **exponents)


def text(top: etree._Element) -> bytes:
    """The document as a file has it."""
    return etree.tostring(top, encoding="UTF-8", xml_declaration=True, pretty_print=True)
