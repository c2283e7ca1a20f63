"""Elements of modelDescription.xml that are the same in FMI 2 and 3."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict

from lxml import etree

from ..ir.equations import EnumerationType
from ..ir.models import Claims
from ..ir.units import base_unit, conversion
from .dependency_kinds import DEPENDENT

LOG_CATEGORIES = {
    "logStatusError": "Errors: what was refused or failed, and what is allowed",
    "logStatusWarning": "Warnings",
    "logEvents": "Times at which relations switch",
    "logSteps": "What each communication step takes: integrator steps, rejections, events",
}


def add_claims(root: etree._Element, claims: Claims) -> None:
    """Author, copyright and licence of the model, as far as it states them."""
    for key, value in asdict(claims).items():
        if value:
            root.set(key, value)


def add_units(root: etree._Element, units: Mapping[str, Sequence[str]]) -> None:
    """UnitDefinitions: ``units`` with those that their values are displayed in."""
    definitions = etree.SubElement(root, "UnitDefinitions")
    for name, displayed in units.items():
        unit = etree.SubElement(definitions, "Unit", name=name)
        if (base := base_unit(name)) is not None:
            attributes = {symbol: str(power) for symbol, power in base.exponents}
            if base.factor != 1.0:
                attributes["factor"] = repr(base.factor)
            if base.offset != 0.0:
                attributes["offset"] = repr(base.offset)
            etree.SubElement(unit, "BaseUnit", attributes)
        for other in displayed:
            factor, offset = conversion(name, other) or (1.0, 0.0)  # interface.displayed_in() lets no others through
            numbers = {"factor": factor} if factor != 1.0 else {}
            numbers |= {"offset": offset} if offset != 0.0 else {}
            etree.SubElement(unit, "DisplayUnit", {key: repr(n) for key, n in numbers.items()}, name=other)


def add_items(element: etree._Element, enumeration: EnumerationType) -> None:
    """The literals of an enumeration."""
    for number, literal in enumerate(enumeration.literals, start=1):
        etree.SubElement(element, "Item", name=literal, value=str(number))


def add_log_categories(root: etree._Element) -> None:
    """LogCategories."""
    categories = etree.SubElement(root, "LogCategories")
    for name, description in LOG_CATEGORIES.items():
        etree.SubElement(categories, "Category", name=name, description=description)


def dependencies(knowns: Sequence[tuple[str, str]], number: Mapping[str, int]) -> dict[str, str]:
    """The attributes that say what an unknown depends on; kinds where they say more than that it does."""
    kinds = {"dependenciesKind": " ".join(kind for _, kind in knowns)} if {k for _, k in knowns} - {DEPENDENT} else {}
    return {"dependencies": " ".join(str(number[known]) for known, _ in knowns)} | kinds


def to_bytes(root: etree._Element) -> bytes:
    """The text of an XML file."""
    return bytes(etree.tostring(root, xml_declaration=True, encoding="UTF-8", pretty_print=True))
