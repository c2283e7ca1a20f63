"""Calls of tables in declarations, written so that rumoca takes them for what they are.

rumoca 0.10.2 takes ``parameter Real mu0 = getTable1DValue(tableID, 1, 0)`` for an array, and then counts an equation
too many wherever ``mu0`` is used; ``getTable1DValue(tableID, 1, 0) + 0`` it does not. The brakes and clutches of the
Modelica Standard Library declare their friction so.
"""

from __future__ import annotations

import re

_CALL = re.compile(r"(\bgetT(?:able1D|imeTable)\w*\([^()]*\))(\s*?)  (?= )")


def with_calls_in_sums(text: str) -> str:
    """The Modelica text with ``+0`` behind such calls, in place of two blanks: all places in it stay what they are."""
    return _CALL.sub(r"\1+0\2", text)
