"""Values of expressions that are not scalar: arrays and records of SymPy expressions.

An array is a NumPy array of objects, a record a dict from the names of its fields to values, and what a function with
several outputs gives is a tuple. Operators are Modelica's: ``*`` of vectors is the scalar product, of matrices the
matrix product; ``.*`` and its like go element by element.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import sympy
from numpy.typing import NDArray

from ..ir.functions import no_number

Array = NDArray[np.object_]
Value = Any  # sympy.Expr, Array, dict[str, Value] or tuple[Value, ...]
ZERO, ONE = sympy.Integer(0), sympy.Integer(1)


def array(elements: Sequence[Value]) -> Array:
    """An array of elements of one shape; ValueError where the shapes differ."""
    shapes = {element.shape if isinstance(element, np.ndarray) else () for element in elements}
    if len(shapes) > 1:
        raise ValueError(f"elements of different sizes: {', '.join(sorted(map(str, shapes)))}")
    result = np.empty((len(elements), *next(iter(shapes), ())), dtype=object)
    for index, element in enumerate(elements):
        result[index] = element
    return result


def full(shape: Sequence[int], element: Value) -> Array:
    """An array with the same element everywhere."""
    result = np.empty(tuple(shape), dtype=object)
    result.fill(element)
    return result


def each(function: Callable[..., Value], *operands: Value) -> Value:
    """The function of scalars, element by element; scalars count for every element."""
    shapes = [operand.shape for operand in operands if isinstance(operand, np.ndarray)]
    if not shapes:
        return function(*operands)
    if len(set(shapes)) > 1:
        raise ValueError(f"sizes differ: {' and '.join(map(str, shapes))}")
    result = np.empty(shapes[0], dtype=object)
    for index in np.ndindex(*shapes[0]):
        result[index] = function(*(o[index] if isinstance(o, np.ndarray) else o for o in operands))
    return result


def multiply(a: Value, b: Value) -> Value:
    """``a*b``"""
    if not (isinstance(a, np.ndarray) and isinstance(b, np.ndarray)):
        return each(lambda x, y: x * y, a, b)
    if a.ndim > 2 or b.ndim > 2 or a.shape[-1] != b.shape[0]:
        raise ValueError(f"sizes do not fit for a product: {a.shape} and {b.shape}")
    rows = a if a.ndim == 2 else a[np.newaxis, :]
    columns = b if b.ndim == 2 else b[:, np.newaxis]
    result = np.empty((rows.shape[0], columns.shape[1]), dtype=object)
    for i, j in np.ndindex(*result.shape):
        result[i, j] = sum_of([x * y for x, y in zip(rows[i], columns[:, j], strict=True)])
    if a.ndim == 1:
        return result[0] if b.ndim == 2 else result[0, 0]
    return result if b.ndim == 2 else result[:, 0]


def divide(a: Value, b: Value) -> Value:
    """``a/b``, b a scalar"""
    if isinstance(b, np.ndarray):
        raise ValueError("division by an array: write ./ for element by element")
    return each(lambda x: quotient(x, b), a)


def quotient(a: sympy.Expr, b: sympy.Expr) -> sympy.Expr:
    """``a/b`` of scalars; NaN where b is the number zero."""
    return no_number() if b.is_zero else a / b


def matrix_power(a: Array, b: Value) -> Value:
    """``a^b`` of a square matrix with a number."""
    if a.ndim != 2 or a.shape[0] != a.shape[1] or not b.is_Integer or b < 0:
        raise ValueError("only a square matrix has powers, with natural numbers: write .^ for element by element")
    result: Value = identity(a.shape[0])
    for _ in range(int(b)):
        result = multiply(result, a)
    return result


def identity(size: int) -> Array:
    """The identity matrix."""
    return diagonal([ONE] * size)


def diagonal(elements: Sequence[Value]) -> Array:
    """A matrix with these elements on its diagonal."""
    result = full((len(elements), len(elements)), ZERO)
    for index, element in enumerate(elements):
        result[index, index] = element
    return result


def sum_of(elements: Sequence[sympy.Expr]) -> sympy.Expr:
    """The sum of scalars, at once: one by one would take quadratic time."""
    return sympy.Add(*elements)


def cross(a: Array, b: Array) -> Array:
    """The vector product."""
    return multiply(skew(a), b)  # type: ignore[no-any-return]


def skew(a: Array) -> Array:
    """The matrix that makes the vector product with a."""
    return array([array([ZERO, -a[2], a[1]]), array([a[2], ZERO, -a[0]]), array([-a[1], a[0], ZERO])])


def concatenate(parts: Sequence[Value], axis: int) -> Array:
    """Along an axis, as ``[a, b]`` (1) and ``[a; b]`` (0) do: scalars and vectors become columns of a matrix."""
    return np.concatenate([_matrix(part) for part in parts], axis=axis)


def _matrix(value: Value) -> Array:
    if not isinstance(value, np.ndarray):
        return full((1, 1), value)
    return value[:, np.newaxis] if value.ndim == 1 else value


def elements(value: Value) -> list[Value]:
    """All scalars, arrays row by row, records field by field."""
    if isinstance(value, np.ndarray):
        return [scalar for element in value.flat for scalar in elements(element)]
    if isinstance(value, dict):
        return [scalar for element in value.values() for scalar in elements(element)]
    if isinstance(value, tuple):
        return [scalar for element in value for scalar in elements(element)]
    return [value]


def field(value: Value, name: str) -> Value:
    """A field of a record, or of every record of an array."""
    if isinstance(value, np.ndarray):
        flat = array([field(element, name) for element in value.flat])
        return flat.reshape(value.shape + flat.shape[1:])
    return value[name]


def combine(function: Callable[..., sympy.Expr], *values: Value) -> Value:
    """The function of scalars, through arrays, records and tuples of one structure."""
    first = values[0]
    if isinstance(first, dict):
        return {key: combine(function, *(value[key] for value in values)) for key in first}
    if isinstance(first, tuple):
        return tuple(combine(function, *parts) for parts in zip(*values, strict=True))
    return each(function, *values)
