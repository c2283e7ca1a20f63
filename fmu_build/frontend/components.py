"""What the names of a flat model stand for: scalars, arrays and records of symbols, or values that are fixed.

Constants, and parameters that are no Reals (sizes, choices), are put in as numbers wherever they stand.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import Any

import sympy

from ..ir.symbols import symbol
from .builtin import finite
from .values import Value, array, elements, full

Read = Callable[[Mapping[str, Any]], Value]


class Components:
    """The components of one flat model by name.

    ``nodes`` are the front end's, ``fixed`` the names that stand for values, ``literals`` those of enumerations.
    ``read`` reads an expression.
    """

    def __init__(
        self, nodes: Mapping[str, Mapping[str, Any]], fixed: frozenset[str], literals: Mapping[str, int], read: Read
    ) -> None:
        self._nodes = nodes
        self._fixed = fixed
        self._literals = literals
        self._read = read
        self._values: dict[str, Value] = {}
        self._parts = _parts(nodes)
        self._numbers: dict[sympy.Symbol, sympy.Expr] = {}
        self.structural: set[str] = set()  # what sizes and subscripts follow from

    def value(self, name: str) -> Value:
        """What ``name`` stands for; KeyError without such a component, ValueError for a constant without value."""
        if name not in self._values:
            self._values[name] = self._find(name)
        return self._values[name]

    def _find(self, name: str) -> Value:
        node = self._nodes.get(name)
        if node is not None and name in self._fixed:
            value = self._read(node["binding"])
            return spread(value, node["dims"]) if node["dims"] else value
        if node is not None and node["binding"] is None and "Constant" in node["variability"]:
            raise ValueError(f"constant {name} has no value: give it one")
        if node is not None:
            return _symbols(name, node["dims"])
        if name in self._parts:
            return self._compose(name)
        return sympy.Integer(self._literals[name])

    def _compose(self, name: str) -> Value:
        """A record from its fields, an array of components from its elements."""
        parts = self._parts[name]
        if not parts[0].startswith("["):
            return {part: self.value(f"{name}.{part}") for part in parts}
        indices = [tuple(int(i) for i in part[1:-1].split(",")) for part in parts]
        result = full(tuple(max(column) for column in zip(*indices, strict=True)), None)
        for index, part in zip(indices, parts, strict=True):
            result[tuple(i - 1 for i in index)] = self.value(name + part)
        return result

    def structure(self, expression: sympy.Expr) -> sympy.Expr:
        """The same as number(), for what decides how the model is built: its parameters cannot be set any more."""
        self.structural |= {s.name for s in expression.free_symbols}
        return self.number(expression)

    def number(self, expression: sympy.Expr) -> sympy.Expr:
        """The expression with every parameter at the number that the model gives it, if it is one. (Conditional
        expressions, put into each other as they are, would grow exponentially.)"""
        for s in expression.free_symbols - self._numbers.keys():
            base, _, index = s.name.partition("[") if s.name not in self._nodes else (s.name, "", "")
            node = self._nodes.get(base)
            self._numbers[s] = s
            if node is not None and node["binding"] is not None and "Parameter" in node["variability"]:
                bound = self._read(node["binding"])
                if index:
                    bound = spread(bound, node["dims"])[tuple(int(i) - 1 for i in index[:-1].split(","))]
                number = self.number(bound)
                self._numbers[s] = number if number.is_number else s
        return finite(expression.xreplace({s: self._numbers[s] for s in expression.free_symbols}))


def element_names(name: str, dims: list[int]) -> list[str]:
    """The names of an array's elements, row by row: ``x[1,1]``, ``x[1,2]``."""
    return [s.name for s in elements(_symbols(name, dims))]


def spread(value: Value, dims: list[int]) -> Value:
    """The value as an array of this shape: a scalar counts for every element."""
    if not hasattr(value, "shape") or value.shape == ():
        return full(dims, value)
    if value.shape != tuple(dims):
        raise ValueError(f"sizes differ: {value.shape} and {tuple(dims)}")
    return value


def elements_for(target: Value, value: Value) -> list[Value]:
    """The scalars of ``value``, one for each of ``target``; a scalar counts for every element."""
    return elements(spread(value, list(target.shape)) if hasattr(target, "shape") else value)


def _symbols(name: str, dims: list[int], index: tuple[int, ...] = ()) -> Value:
    if not dims:
        return symbol(f"{name}[{','.join(map(str, index))}]" if index else name)
    parts = [_symbols(name, dims[1:], (*index, i + 1)) for i in range(dims[0])]
    return array(parts) if parts else full(dims, None)


def _parts(names: Mapping[str, Any]) -> dict[str, list[str]]:
    """What each prefix of a name is followed by: fields, or indices in brackets."""
    found: dict[str, dict[str, None]] = {}
    for name in names:
        whole = ""
        for part in re.findall(r"\[[^\]]*\]|'[^']*'|[^.\[]+", name):
            if whole:
                found.setdefault(whole, {})[part] = None
            whole += part if part.startswith("[") or not whole else f".{part}"
    return {name: list(parts) for name, parts in found.items()}
