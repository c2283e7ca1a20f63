"""An SVG file of matplotlib's made fit to stand inside an HTML page, beside others."""

from __future__ import annotations

import re

from lxml import etree

SVG = "{http://www.w3.org/2000/svg}"
HREF = "{http://www.w3.org/1999/xlink}href"
REFERENCE = re.compile(r"url\(#([^)]+)\)")


def inline(content: bytes, prefix: str, label: str) -> str:
    """The svg element alone: ids under `prefix`, so that no two figures share one; as wide as its place; named `label`.

    Matplotlib's style sheet for every element would hold for the whole page; it becomes the root's own style.
    """
    root = etree.fromstring(content, etree.XMLParser(remove_comments=True, remove_blank_text=True))
    for unwanted in [*root.iter(f"{SVG}metadata"), *root.iter(f"{SVG}style")]:
        parent = unwanted.getparent()
        if parent is not None:
            parent.remove(unwanted)
    for element in root.iter():
        _rename(element, prefix)
    for name in ("width", "height", "version"):
        root.attrib.pop(name, "")
    root.set("style", "stroke-linejoin: round; stroke-linecap: butt")
    root.set("role", "img")
    root.set("aria-label", label)
    return etree.tostring(root, encoding="unicode")


def _rename(element: etree._Element, prefix: str) -> None:
    for name, value in element.attrib.items():
        text = str(value)
        if name == "id":
            element.set(name, f"{prefix}{text}")
        elif name in ("href", HREF) and text.startswith("#"):
            element.set(name, f"#{prefix}{text[1:]}")
        elif "url(#" in text:
            element.set(name, REFERENCE.sub(rf"url(#{prefix}\1)", text))
