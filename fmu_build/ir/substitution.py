"""Put values in place of symbols, everywhere in a value of the intermediate representation."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass, replace
from typing import Any, TypeVar, cast

import sympy

T = TypeVar("T")


def substitute(value: T, replacements: Mapping[sympy.Symbol, sympy.Expr]) -> T:
    """``value`` (a frozen dataclass, a tuple or an expression) with ``replacements`` in all its expressions."""
    return cast(T, _substitute(value, replacements)) if replacements else value


def _substitute(value: Any, replacements: Mapping[sympy.Symbol, sympy.Expr]) -> Any:
    if isinstance(value, sympy.Basic):
        return value.xreplace(replacements)
    if isinstance(value, tuple):
        return tuple(_substitute(item, replacements) for item in value)
    if is_dataclass(value) and not isinstance(value, type):
        old = {field.name: getattr(value, field.name) for field in fields(value)}
        new = {name: _substitute(item, replacements) for name, item in old.items()}
        changed = {name: item for name, item in new.items() if item is not old[name]}
        return replace(value, **changed) if changed else value
    return value
