"""A figure of matplotlib's as an SVG that stands inside an HTML page beside others: its text is the page's text."""

from __future__ import annotations

import html
import re
from collections.abc import Mapping

import matplotlib as mpl
from lxml import etree
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.text import Text
from matplotlib.textpath import TextToPath

from overrun_hitch.paper.report.label import SVG, typeset
from overrun_hitch.show.traces import rendered

HREF = "{http://www.w3.org/1999/xlink}href"
REFERENCE = re.compile(r"url\(#([^)]+)\)")
SIZE = re.compile(r"([\d.]+)px")
FONT = re.compile(r"font[\w-]*:[^;]*;?\s*")
LONG = re.compile(r"-?\d+\.\d{3,}")
ANCHORS = {"left": ("start", 0.0), "center": ("middle", 0.5), "right": ("end", 1.0)}  # and where in the text it is


def inline(figure: Figure, prefix: str, label: str) -> str:
    """The svg element alone: ids under `prefix`, so that no two figures share one; as wide as its place; named `label`.

    Text is in the page's fonts, held where matplotlib anchors it, whatever its width there. Matplotlib's style sheet
    for every element would hold for the whole page; it becomes the root's own style.
    """
    with mpl.rc_context({"svg.fonttype": "none"}):
        content = rendered(figure, "svg")
    root = etree.fromstring(content, etree.XMLParser(remove_blank_text=True))
    for unwanted in [*root.iter(f"{SVG}metadata"), *root.iter(f"{SVG}style")]:
        parent = unwanted.getparent()
        if parent is not None:
            parent.remove(unwanted)
    _set_texts(root, _alignments(figure))
    etree.strip_tags(root, etree.Comment)
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
        elif name in ("d", "x", "y", "transform"):  # in points: a hundredth is more than can be seen
            element.set(name, LONG.sub(lambda number: f"{float(number[0]):.2f}", text))


def _alignments(figure: Figure) -> dict[str, str]:
    """Of every line of text: "left", "center" or "right"."""
    texts = [text for text in figure.findobj(Text) if isinstance(text, Text)]
    return {line: text.get_horizontalalignment() for text in texts for line in text.get_text().splitlines()}


def _set_texts(root: etree._Element, alignments: Mapping[str, str]) -> None:
    """Make words and formulas of what matplotlib places by its own font, formulas even letter by letter."""
    formulas = {element.getnext(): html.unescape(str(element.text).strip()) for element in root.iter(etree.Comment)}
    for group, formula in formulas.items():
        if group is not None:  # else the comment stands for nothing
            size = max(float(found) for span in group.iter() for found in SIZE.findall(str(span.get("style", ""))))
            text = group[0]
            for span in list(text):
                text.remove(span)
            text.text = None
            typeset(text, formula, size)
            _anchor(text, group, formula, size, alignments[formula])
    for text in root.iter(f"{SVG}text"):
        if text.getparent() not in formulas:
            style = str(text.get("style", ""))
            size = float(SIZE.findall(style)[0])
            _anchor(text, text, text.text or "", size, "" if "text-anchor" in style else alignments[text.text or ""])


def _anchor(text: etree._Element, styled: etree._Element, label: str, size: float, alignment: str) -> None:
    """Leave the page its font, and hold the text where it is aligned; "" where it is held already."""
    style = f"{FONT.sub('', str(styled.get('style', ''))).strip('; ')}; font-size: {size:g}px"
    if alignment:
        anchor, share = ANCHORS[alignment]
        width, _, _ = TextToPath().get_text_width_height_descent(label, FontProperties(size=size), "$" in label)
        text.set("x", f"{share * width:.2f}")
        style += f"; text-anchor: {anchor}"
    styled.set("style", style.removeprefix("; "))
