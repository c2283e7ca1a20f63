"""Matplotlib's labels, their mathematics between dollar signs, as text and as what an SVG's <text> holds."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass

from lxml import etree

SVG = "{http://www.w3.org/2000/svg}"
SMALLER = 0.7  # a script's size, as matplotlib has it
RAISED, LOWERED = -0.35, 0.2  # of the size
SYMBOLS = {"times": "\N{MULTIPLICATION SIGN}"}  # other names are those of Greek letters
PART = re.compile(
    r"(?P<script>[_^])?(?:\\math(?P<font>rm|default)(?=\{))?"
    r"(?:\{(?P<group>(?:[^{}]|\{[^{}]*\})*)\}|\\(?P<name>[A-Za-z]+)|(?P<sign>[^\s\\{}]))"
)


@dataclass(frozen=True)
class Piece:
    """Some of a label; `script` is "_" for an index, "^" for an exponent."""

    text: str
    is_italic: bool = False
    script: str = ""


def pieces(label: str) -> list[Piece]:
    """A label of one line, from left to right."""
    found = []
    for place, part in enumerate(re.split(r"(?<!\\)\$", label)):
        found += list(_mathematics(part)) if place % 2 else [Piece(part.replace(r"\$", "$"))] * bool(part)
    return found


def plain(label: str) -> str:
    """As in the code: C_crit."""
    texts, before = [], ""
    for piece in pieces(label):
        texts += [piece.script if piece.script != before else "", piece.text]
        before = piece.script
    return "".join(texts)


def typeset(element: etree._Element, label: str, size: float) -> None:
    """Put a label of `size` into an SVG's <text>."""
    height = 0.0
    for piece in pieces(label):
        level = {"": 0.0, "_": LOWERED, "^": RAISED}[piece.script] * size
        span = etree.SubElement(element, f"{SVG}tspan")
        span.text = piece.text
        if level != height:
            span.set("dy", f"{level - height:.2f}")
            height = level
        if piece.script:
            span.set("font-size", f"{SMALLER * size:g}")
        if piece.is_italic:
            span.set("font-style", "italic")


def _mathematics(text: str, is_upright: bool = False, script: str = "") -> Iterator[Piece]:
    for part in PART.finditer(text):
        level = part["script"] or script
        if part["group"] is not None:
            yield from _mathematics(part["group"], is_upright or part["font"] is not None, level)
        else:
            sign = part["sign"] or _symbol(part["name"])
            yield Piece(sign, sign.isalpha() and not is_upright, level)


def _symbol(name: str) -> str:
    return SYMBOLS.get(name) or unicodedata.lookup(f"GREEK SMALL LETTER {name}")
