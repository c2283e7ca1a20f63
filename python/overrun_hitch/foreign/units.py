"""Units that others write, to ours. The one module that touches pint, which has no types."""

from __future__ import annotations

import math
import re
from functools import cache
from typing import Any

from overrun_hitch.parameters import HitchError

LONGEST = 80  # characters
# A power of anything but a name or a number, or to more than two digits: pint would compute 9**9**9 to its last one.
EXCESSIVE = re.compile(r"\)\s*\*\*|\*\*(?!\s*\(?\s*[-+]?\s*\d{1,2}(?![\d.eE_])\s*\)?(?!\s*\*\*))|\d{10}")


def factor(name: str, unit: str, ours: str) -> float:
    """What a value of the variable `name` in `unit` is to be multiplied by for `ours`; HitchError if it does not fit.

    Units as Modelica, FMI and engineers write them: "N.m", "Nm", "m/s2", "kg*m**2", "km/h", "%".
    """
    if unit == ours:
        return 1.0
    try:
        asked, wanted = (_registry().Quantity(1.0, _spelt(text)) for text in (unit, ours))
        size = float(asked.to(wanted.units).magnitude)
        if 0.0 < size < math.inf:
            return size
        raise ValueError(size)
    except Exception:  # pint raises its parser's and the tokenizer's errors as well as its own
        raise HitchError(
            f"{unit!r:.20} is no unit of {name}; allowed: {ours} and what can be converted to it"
        ) from None


def _spelt(unit: str) -> str:
    """As pint reads it: products, and exponents that stand behind a unit."""
    text = re.sub(r"Nm\b", "N*m", unit.replace(".", "*") if re.search(r"[A-Za-z]\.", unit) else unit)
    text = re.sub(r"(?<=[A-Za-z])(-?[1-9])\b", r"**\1", text)
    text = text.replace("^", "**")
    if len(text) > LONGEST or EXCESSIVE.search(text):
        raise ValueError(text)
    return "dimensionless" if text in ("1", "-") else text


@cache
def _registry() -> Any:
    # Imported here, because it takes half a second that who uses SI need not wait for.
    import pint

    return pint.UnitRegistry()
