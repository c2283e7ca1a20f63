"""Numbers on the command line: one, a list, a range, so many values of a range."""

from __future__ import annotations

import math
from collections.abc import Callable

from overrun_hitch.decimals import decimals
from overrun_hitch.parameters import HitchError

MOST = 10_000  # values of one option
FORMS = "allowed: 200 or 50,100,200 or 0:3200 or 0:3200:9 (A:B:N, N values from A to B)"


def numbers(option: str, text: str, between: Callable[[float, float], list[float]]) -> list[float]:
    """The values that `text` asks for, ascending, each once; `between` says which of a range A:B, ends included.

    `option` ("--C") is for the message: HitchError for anything else than FORMS, values that are not finite, a range
    that is empty and more than MOST values. Limits of the quantity itself are for the caller to check.
    """
    parts = text.split(":")
    if len(parts) == 1:
        values = [_number(option, text, part) for part in text.split(",")]
    else:
        low, high = (_number(option, text, part) for part in parts[:2])
        if low >= high:
            raise HitchError(f"{option} {text!r:.40} is an empty range: A of A:B must be less than B")
        values = between(low, high) if len(parts) == 2 else evenly(low, high, _count(option, text, parts))
    if len(values) > MOST:
        raise HitchError(f"{option} asks for {len(values)} values; allowed: at most {MOST}")
    return sorted(set(values))


def evenly(low: float, high: float, count: int) -> list[float]:
    """`count` values from `low` to `high`, both included, at even distances."""
    return [*decimals(low + (high - low) * i / (count - 1) for i in range(count - 1)), high]


def doubling(low: float, high: float) -> list[float]:
    """From `low` on, each twice the one before, and `high`; evenly where `low` is not positive."""
    if low <= 0.0:
        return evenly(low, high, 5)
    count = math.ceil(math.log2(high / low))
    return [*(low * 2.0**i for i in range(count)), high]


def _number(option: str, text: str, part: str) -> float:
    try:
        value = float(part)
    except ValueError:
        raise HitchError(f"{option} {text!r:.40}: {part.strip()!r:.20} is no number; {FORMS}") from None
    if not math.isfinite(value):
        raise HitchError(f"{option} {text!r:.40}: {value:g} is not a finite number")
    return value


def _count(option: str, text: str, parts: list[str]) -> int:
    try:
        count = int(parts[2])
    except ValueError:
        count = 0
    if len(parts) > 3 or not 2 <= count <= MOST:
        raise HitchError(f"{option} {text!r:.40}: N of A:B:N must be a whole number, at least 2, at most {MOST}")
    return count
