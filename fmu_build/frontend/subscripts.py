"""Elements of arrays: subscripts that are known when the unit is built, and such that change in time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import sympy

from ..ir.conditions import compare
from ..ir.functions import no_number
from .reader import Reader
from .values import Value, combine


def element(reader: Reader, value: Value, subscripts: Sequence[Mapping[str, Any]]) -> Value:
    """The element or the part of the array ``value`` that the subscripts name."""
    if not isinstance(value, np.ndarray):
        raise ValueError("a subscript of what is no array")
    for axis, subscript in enumerate(subscripts):
        if (moving := _moving(reader, subscript)) is not None:
            return _chosen(reader, value, subscripts, axis, moving)
    return value[indices(reader, subscripts, value.shape)]


def _moving(reader: Reader, subscript: Mapping[str, Any]) -> sympy.Expr | None:
    """The subscript if it changes in time."""
    value = reader.read(subscript["Expr"]["expr"]) if "Expr" in subscript else None
    if not isinstance(value, sympy.Basic) or reader.components.number(value).is_number:
        return None
    return value


def _chosen(
    reader: Reader, value: Value, subscripts: Sequence[Mapping[str, Any]], axis: int, moving: sympy.Expr
) -> Value:
    """The element that ``moving`` has the number of at the time; outside the array nothing, which is no number."""
    options = []
    for number in range(1, value.shape[axis] + 1):
        fixed = {"Index": {"value": number}}
        options.append(element(reader, value, [*subscripts[:axis], fixed, *subscripts[axis + 1 :]]))
    truths = [compare(sympy.Eq, moving, sympy.Integer(number)) for number in range(1, len(options) + 1)]
    return combine(
        lambda *scalars: sympy.Piecewise(*zip(scalars, truths, strict=True), (no_number(), True), evaluate=False),
        *options,
    )


def indices(reader: Reader, subscripts: Sequence[Mapping[str, Any]], shape: tuple[int, ...]) -> tuple[Any, ...]:
    """Subscripts as indices of a NumPy array, from zero; several vectors count independently of each other."""
    found: list[Any] = []
    for subscript, size in zip(subscripts, shape, strict=False):
        tag, body = next(iter(subscript.items()))
        if tag == "Colon":
            found.append(range(size))
            continue
        value = sympy.Integer(body["value"]) if tag == "Index" else reader.read(body["expr"])
        if isinstance(value, np.ndarray):
            found.append([_position(reader, scalar, size) for scalar in value])
        else:
            found.append(_position(reader, value, size))
    if all(isinstance(index, int) for index in found):
        return tuple(found)
    found += [range(size) for size in shape[len(found) :]]
    grid = np.ix_(*([index] if isinstance(index, int) else list(index) for index in found))
    is_scalar = [isinstance(index, int) for index in found]
    return tuple(np.squeeze(part, axis=tuple(np.flatnonzero(is_scalar))) for part in grid)


def _position(reader: Reader, value: sympy.Expr, size: int) -> int:
    number = reader.components.structure(value)
    if not number.is_number or number != int(number):
        raise ValueError(f"the subscript {value} changes in time: only constants and parameters can be subscripts")
    if not 1 <= int(number) <= size:
        raise ValueError(f"the subscript {number} is outside 1 to {size}")
    return int(number) - 1
