"""Modelica's built-in functions of scalars and arrays, as far as they are expressions of their arguments.

Those with a relation inside are elsewhere: abs, min and their like in choices.py, floor, mod and theirs in
event_expressions.py.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np
import sympy

from ..ir.functions import no_number, power
from .values import (
    ONE,
    ZERO,
    Value,
    array,
    combine,
    concatenate,
    cross,
    diagonal,
    divide,
    each,
    elements,
    full,
    identity,
    matrix_power,
    multiply,
    quotient,
    skew,
    sum_of,
)

SCALAR: Mapping[str, Callable[..., sympy.Expr]] = {
    "Sqrt": sympy.sqrt,
    "Sin": sympy.sin,
    "Cos": sympy.cos,
    "Tan": sympy.tan,
    "Asin": sympy.asin,
    "Acos": sympy.acos,
    "Atan": sympy.atan,
    "Atan2": sympy.atan2,
    "Sinh": sympy.sinh,
    "Cosh": sympy.cosh,
    "Tanh": sympy.tanh,
    "Exp": sympy.exp,
    "Log": sympy.log,
    "Log10": lambda x: sympy.log(x) / sympy.log(10.0),
}


def finite(value: Value) -> Value:
    """The value, with NaN where it is no real number, such as sqrt(-1) or 1/0. SymPy would go on with complex ones.

    It may stand in a branch that is never taken; a run that needs it ends.
    """
    return combine(_finite, value)


def _finite(scalar: sympy.Expr) -> sympy.Expr:
    is_fine = not scalar.is_number or (scalar.is_real and math.isfinite(float(scalar)))
    return scalar if is_fine else no_number()


def _same(operation: Callable[[sympy.Expr, sympy.Expr], sympy.Expr]) -> Callable[[Value, Value], Value]:
    """For operands of the same structure, which may be records."""
    return lambda a, b: combine(operation, a, b)


def _scalar(exponent: Value) -> sympy.Expr:
    if isinstance(exponent, np.ndarray):
        raise ValueError("an array as exponent: write .^ for element by element")
    return exponent


BINARY: Mapping[str, Callable[[Value, Value], Value]] = {
    "Add": _same(lambda a, b: a + b),
    "Sub": _same(lambda a, b: a - b),
    "Mul": multiply,
    "Div": divide,
    "Exp": lambda a, b: matrix_power(a, b) if isinstance(a, np.ndarray) else power(a, _scalar(b)),
    "AddElem": lambda a, b: each(lambda x, y: x + y, a, b),
    "SubElem": lambda a, b: each(lambda x, y: x - y, a, b),
    "MulElem": lambda a, b: each(lambda x, y: x * y, a, b),
    "DivElem": lambda a, b: each(quotient, a, b),
    "ExpElem": lambda a, b: each(power, a, b),
}


def _sizes(arguments: tuple[Value, ...]) -> list[int]:
    return [int(argument) for argument in arguments]


def _size(a: Value, dimension: Value | None = None) -> Value:
    shape = a.shape if isinstance(a, np.ndarray) else ()
    if dimension is None:
        return array([sympy.Integer(n) for n in shape])
    return sympy.Integer(shape[int(dimension) - 1])


def _linspace(first: Value, last: Value, count: Value) -> Value:
    n = int(count)
    return array([first + (last - first) * sympy.Rational(i, n - 1) for i in range(n)])


def _symmetric(a: Value) -> Value:
    return array([array([a[min(i, j), max(i, j)] for j in range(len(a))]) for i in range(len(a))])


ARRAY: Mapping[str, Callable[..., Value]] = {
    "Sum": lambda a: sum_of(elements(a)),
    "Product": lambda a: sympy.Mul(*elements(a)),
    "Size": _size,
    "Ndims": lambda a: sympy.Integer(getattr(a, "ndim", 0)),
    "Fill": lambda value, *sizes: full(_sizes(sizes), value),
    "Zeros": lambda *sizes: full(_sizes(sizes), ZERO),
    "Ones": lambda *sizes: full(_sizes(sizes), ONE),
    "Identity": lambda size: identity(int(size)),
    "Diagonal": diagonal,
    "Linspace": _linspace,
    "Transpose": lambda a: a.T,
    "OuterProduct": lambda a, b: multiply(a[:, np.newaxis], b[np.newaxis, :]),
    "Cross": cross,
    "Skew": skew,
    "Symmetric": _symmetric,
    "Scalar": lambda a: _only(elements(a)),
    "Vector": lambda a: array(elements(a)),
    "Matrix": lambda a: concatenate([a], axis=0),
    "Cat": lambda axis, *parts: np.concatenate(parts, axis=int(axis) - 1),
    "Homotopy": lambda actual, simplified: actual,
}

# Functions whose last arguments are sizes, with the place of the first one.
SIZES: Mapping[str, int] = {"Fill": 1, "Zeros": 0, "Ones": 0, "Identity": 0, "Linspace": 2}


def _only(found: list[Value]) -> Value:
    if len(found) != 1:
        raise ValueError(f"scalar() of {len(found)} elements")
    return found[0]
