"""Numbers as people write them: three times 0.1 is 0.3, not 0.30000000000000004."""

from __future__ import annotations

import math
from collections.abc import Iterable

DIGITS = 12  # that people write at most
ROUNDING = 2.0  # units in the last place: a product, and its factor's own


def decimals(values: Iterable[float]) -> list[float]:
    """Each value as the decimal from which it differs by rounding alone; unchanged where there is none."""
    return [_decimal(float(value)) for value in values]


def _decimal(value: float) -> float:
    near = float(f"{value:.{DIGITS}g}")
    return near if abs(near - value) <= ROUNDING * math.ulp(value) else value
