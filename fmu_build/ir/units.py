"""Modelica unit strings (Modelica specification, chapter 19) to FMI base units."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass

SI_BASE = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")

# symbol: (factor to SI, exponents of the base units); BIPM, The International System of Units, 9th ed., tables 2, 4, 8
_NAMED: dict[str, tuple[float, dict[str, int]]] = {
    **{base: (1.0, {base: 1}) for base in SI_BASE},
    "g": (1e-3, {"kg": 1}),
    "t": (1e3, {"kg": 1}),
    "N": (1.0, {"kg": 1, "m": 1, "s": -2}),
    "Pa": (1.0, {"kg": 1, "m": -1, "s": -2}),
    "bar": (1e5, {"kg": 1, "m": -1, "s": -2}),
    "J": (1.0, {"kg": 1, "m": 2, "s": -2}),
    "W": (1.0, {"kg": 1, "m": 2, "s": -3}),
    "C": (1.0, {"A": 1, "s": 1}),
    "V": (1.0, {"kg": 1, "m": 2, "s": -3, "A": -1}),
    "F": (1.0, {"kg": -1, "m": -2, "s": 4, "A": 2}),
    "Ohm": (1.0, {"kg": 1, "m": 2, "s": -3, "A": -2}),
    "S": (1.0, {"kg": -1, "m": -2, "s": 3, "A": 2}),
    "Wb": (1.0, {"kg": 1, "m": 2, "s": -2, "A": -1}),
    "T": (1.0, {"kg": 1, "s": -2, "A": -1}),
    "H": (1.0, {"kg": 1, "m": 2, "s": -2, "A": -2}),
    "Hz": (1.0, {"s": -1}),
    "min": (60.0, {"s": 1}),
    "h": (3600.0, {"s": 1}),
    "d": (86400.0, {"s": 1}),
    "l": (1e-3, {"m": 3}),
    "deg": (0.017453292519943295, {"rad": 1}),
    "degC": (1.0, {"K": 1}),
}
_PREFIXES = {"G": 1e9, "M": 1e6, "k": 1e3, "c": 1e-2, "m": 1e-3, "u": 1e-6, "n": 1e-9, "p": 1e-12}
_FACTOR = re.compile(r"([A-Za-z]+)(-?\d+)?")


@dataclass(frozen=True)
class BaseUnit:
    """value in SI = factor * value + offset; ``exponents`` of the SI base units, those that are not zero."""

    exponents: tuple[tuple[str, int], ...]
    factor: float = 1.0
    offset: float = 0.0


def base_unit(unit: str) -> BaseUnit | None:
    """The base unit of a Modelica unit string; None if it has a symbol that is not known here."""
    factor = 1.0
    total: Counter[str] = Counter()
    factors = _factors(unit)
    if factors is None:
        return None
    for name, exponent in factors.items():
        if (named := _named(name)) is None:
            return None
        factor *= named[0] ** exponent
        for base, power in named[1].items():
            total[base] += power * exponent
    exponents = tuple((base, total[base]) for base in SI_BASE if total[base])
    return BaseUnit(exponents, factor, 273.15 if unit == "degC" else 0.0)


def conversion(unit: str, display_unit: str) -> tuple[float, float] | None:
    """(factor, offset) with which ``factor*value + offset`` is a value of ``unit`` in ``display_unit``.

    None where one of them is not known here, or where they measure different things.
    """
    one, other = base_unit(unit), base_unit(display_unit)
    if one is None or other is None or one.exponents != other.exponents:
        return None
    factor, offset = one.factor / other.factor, (one.offset - other.offset) / other.factor
    return float(f"{factor:.15g}"), float(f"{offset:.15g}")  # 1 m/s is 3.6 km/h


def per_second(unit: str) -> str:
    """The unit of a time derivative: "m" to "m/s", "m/s" to "m/s2", "1" to "1/s"; "" stays ""."""
    factors = _factors(unit)
    if factors is None:
        return f"({unit})/s" if unit else ""
    counts = Counter(factors)
    counts["s"] -= 1
    above = ".".join(_power(name, e) for name, e in counts.items() if e > 0) or "1"
    below = [_power(name, -e) for name, e in counts.items() if e < 0]
    if not below:
        return above
    return f"{above}/{below[0]}" if len(below) == 1 else f"{above}/({'.'.join(below)})"


def _power(name: str, exponent: int) -> str:
    return name if exponent == 1 else f"{name}{exponent}"


def _factors(unit: str) -> dict[str, int] | None:
    """Symbols and their exponents; {} for "1", None if the string does not follow Modelica's syntax."""
    above, slash, below = unit.partition("/")
    counts: Counter[str] = Counter()
    for part, sign in ((above, 1), (below.removeprefix("(").removesuffix(")"), -1)):
        if part == "1" or (sign < 0 and not slash):
            continue
        for text in part.split("."):
            if not (match := _FACTOR.fullmatch(text)):
                return None
            counts[match.group(1)] += sign * int(match.group(2) or 1)
    return dict(counts)


def _named(name: str) -> tuple[float, dict[str, int]] | None:
    if name in _NAMED:
        return _NAMED[name]
    prefix, symbol = name[:1], name[1:]
    if prefix in _PREFIXES and symbol in _NAMED:
        factor, exponents = _NAMED[symbol]
        return _PREFIXES[prefix] * factor, exponents
    return None
