"""Receivers of a function's outputs, written so that rumoca takes them: ``(x, y) := f(u)`` of an f with three outputs.

Modelica lets the last be left out (3.6, section 12.4.3); rumoca 0.10.2 wants a place for each, ``(x, y, ) := f(u)``.
"""

from __future__ import annotations

import re

_FEW = re.compile(r"`(?:[\w.]*\.)?(\w+)` returns (\d+) values but the receiving tuple has (\d+) slots")


def with_all_receivers(text: str, said: str) -> str:
    """The Modelica text with an empty receiver for each that rumoca, by what it ``said``, does not see."""
    if (found := _FEW.search(said)) is None or int(found[2]) < int(found[3]):
        return text
    name, outputs, slots = found[1], int(found[2]), int(found[3])
    inner = r"[^();]*(?:\([^();]*\)[^();]*)*"  # what is between the parentheses may have some, as x[size(y, 1)]
    call = re.compile(rf"\(({inner})\)(\s*:?=\s*(?:[\w.]+\.)?{re.escape(name)}\s*\()")
    return call.sub(lambda c: f"({c[1]}{', ' * (outputs - slots)}){c[2]}" if _slots(c[1]) == slots else c[0], text)


def _slots(receivers: str) -> int:
    """How many; commas in brackets and parentheses separate none."""
    flat = receivers
    while (inner := re.sub(r"\([^()]*\)|\[[^\[\]]*\]", "", flat)) != flat:
        flat = inner
    return flat.count(",") + 1
