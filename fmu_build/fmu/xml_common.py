"""Elements of modelDescription.xml that are the same in FMI 2 and 3."""

from __future__ import annotations

from collections.abc import Sequence

from lxml import etree

from ..ir.equations import EnumerationType
from ..ir.units import base_unit

LOG_CATEGORIES = {
    "logStatusError": "Errors: what was refused or failed, and what is allowed",
    "logStatusWarning": "Warnings",
    "logEvents": "Times at which relations switch",
}


def add_units(root: etree._Element, names: Sequence[str]) -> None:
    """UnitDefinitions."""
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


def add_items(element: etree._Element, enumeration: EnumerationType) -> None:
    """The literals of an enumeration."""
    for number, literal in enumerate(enumeration.literals, start=1):
        etree.SubElement(element, "Item", name=literal, value=str(number))


def add_log_categories(root: etree._Element) -> None:
    """LogCategories."""
    categories = etree.SubElement(root, "LogCategories")
    for name, description in LOG_CATEGORIES.items():
        etree.SubElement(categories, "Category", name=name, description=description)


def to_bytes(root: etree._Element) -> bytes:
    """The text of an XML file."""
    return bytes(etree.tostring(root, xml_declaration=True, encoding="UTF-8", pretty_print=True))
