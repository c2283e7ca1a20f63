"""rumoca's expression trees to SymPy, and source spans to places."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import sympy
from sympy.logic.boolalg import Boolean

from .errors import BuildError
from .ir import Relation, der, holds, symbol

FUNCTIONS: Mapping[str, Callable[..., sympy.Expr]] = {
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
ARITHMETIC: Mapping[str, Callable[[sympy.Expr, sympy.Expr], sympy.Expr]] = {
    "Add": lambda a, b: a + b,
    "Sub": lambda a, b: a - b,
    "Mul": lambda a, b: a * b,
    "Div": lambda a, b: a / b,
    "Exp": lambda a, b: a**b,
}
RELATIONS = {"Lt": "<", "Le": "<=", "Gt": ">", "Ge": ">="}
CHOICES = {"Abs": 1, "Min": 2, "Max": 2}  # conditionals in the guise of functions: number of arguments


def unwrap(node: Any) -> str:
    """The tag of one of rumoca's enumerations, which are strings or one-entry objects."""
    return str(next(iter(node)) if isinstance(node, dict) else node)


class Sources:
    """The Modelica files behind a flat model: turns rumoca's spans into ``file:line``, relative to the library."""

    def __init__(self, files: Mapping[int, tuple[str, str]], root: Path) -> None:
        self._files = files
        self._root = root

    def texts(self) -> Iterator[str]:
        """The text of every file."""
        return (text for _, text in self._files.values())

    def place(self, span: Mapping[str, int]) -> str:
        """``file:line`` of a span."""
        name, text = self._files.get(span["source"], ("", ""))
        line = text.encode()[: span["start"]].count(b"\n") + 1
        return f"{os.path.relpath(name, self._root) if name else 'Modelica'}:{line}"

    def text(self, span: Mapping[str, int]) -> str:
        """The Modelica text of a span, on one line."""
        _, text = self._files.get(span["source"], ("", ""))
        return " ".join(text.encode()[span["start"] : span["end"]].decode().split())

    def find_place(self, node: Any) -> str:
        """The place of the outermost span inside ``node``."""
        stack = [node]
        while stack:
            item = stack.pop()
            if isinstance(item, dict):
                if {"source", "start"} <= item.keys() and item["source"] in self._files:
                    return self.place(item)
                stack.extend(reversed(item.values()))
                stack.append(item.get("span"))
            elif isinstance(item, list):
                stack.extend(reversed(item))
        return "Modelica"


class ExpressionReader:
    """Reads expressions of one flat model and collects the relations that it meets.

    Within noEvent() a condition is no relation: it is evaluated as it stands, at any time. Elsewhere abs(), min() and
    max() are conditionals with a relation, so that their kinks are located as well.
    """

    def __init__(self, sources: Sources) -> None:
        self.sources = sources
        self.relations: list[Relation] = []
        self._event_free = False

    def read(self, node: Mapping[str, Any]) -> sympy.Expr:
        """A real expression; BuildError with its place where a construct is not supported."""
        tag, body = next(iter(node.items()))
        if tag == "Literal":
            return self._literal(body)
        if tag == "VarRef" and not body["subscripts"]:
            return symbol(body["name"]["name"])
        if tag == "Unary" and body["op"] in {"Minus", "Plus"}:
            operand = self.read(body["rhs"])
            return -operand if body["op"] == "Minus" else operand
        if tag == "Binary" and body["op"] in ARITHMETIC:
            return ARITHMETIC[body["op"]](self.read(body["lhs"]), self.read(body["rhs"]))
        if tag == "If":
            return self._conditional(body)
        if tag == "BuiltinCall":
            return self._call(body)
        raise self._unsupported(node)

    def _literal(self, body: Mapping[str, Any]) -> sympy.Expr:
        kind, value = next(iter(body["value"].items()))
        if kind not in {"Real", "Integer"}:
            raise self._unsupported({"Literal": body})
        return sympy.Integer(value) if kind == "Integer" else sympy.Float(value)

    def _call(self, body: Mapping[str, Any]) -> sympy.Expr:
        function, arguments = body["function"], body["args"]
        if function == "Der":
            operand = self.read(arguments[0])
            if not operand.is_Symbol:
                raise BuildError(f"{self.sources.find_place(body)}: der() of an expression: give it a variable instead")
            return symbol(der(operand.name))
        if function == "NoEvent":
            return self._without_events(arguments[0])
        if function == "Smooth":  # how often it is differentiable is of no use here
            return self.read(arguments[1])
        if len(arguments) == CHOICES.get(function):
            return self._choice(body)
        if function not in FUNCTIONS:
            raise self._unsupported({"BuiltinCall": body})
        return FUNCTIONS[function](*(self.read(argument) for argument in arguments))

    def _without_events(self, node: Mapping[str, Any]) -> sympy.Expr:
        outside, self._event_free = self._event_free, True
        try:
            return self.read(node)
        finally:
            self._event_free = outside

    def _choice(self, body: Mapping[str, Any]) -> sympy.Expr:
        """abs(a) is -a where -a > 0, min(a, b) is a where b - a > 0, max(a, b) is a where a - b > 0."""
        *others, last = (self.read(argument) for argument in body["args"])
        chosen = others[0] if others else -last
        difference = chosen - last if others else chosen
        text, origin = self.sources.text(body["span"]), self.sources.find_place(body)
        is_chosen = self._holds(-difference if body["function"] == "Min" else difference, text, origin)
        return sympy.Piecewise((chosen, is_chosen), (last, True), evaluate=False)

    def _conditional(self, body: Mapping[str, Any]) -> sympy.Expr:
        pairs = [(self.read(value), self._condition(condition)) for condition, value in body["branches"]]
        return sympy.Piecewise(*pairs, (self.read(body["else_branch"]), True), evaluate=False)

    def _condition(self, node: Mapping[str, Any]) -> Boolean:
        tag, body = next(iter(node.items()))
        if tag == "Binary" and body["op"] in RELATIONS:
            return self._relation(body)
        if tag == "Binary" and body["op"] in {"And", "Or"}:
            combine = sympy.And if body["op"] == "And" else sympy.Or
            return combine(self._condition(body["lhs"]), self._condition(body["rhs"]))
        if tag == "Unary" and body["op"] == "Not":
            return sympy.Not(self._condition(body["rhs"]))
        raise self._unsupported(node)

    def _relation(self, body: Mapping[str, Any]) -> Boolean:
        """``a > b`` is true where a - b > 0; ``a >= b`` is the negation of b > a."""
        left, right = self.read(body["lhs"]), self.read(body["rhs"])
        residual = left - right if body["op"] in {"Gt", "Le"} else right - left
        text, origin = self.sources.text(body["span"]), self.sources.place(body["span"])
        truth = self._holds(residual, text, origin)
        return sympy.Not(truth) if body["op"] in {"Le", "Ge"} else truth

    def _holds(self, residual: sympy.Expr, text: str, origin: str) -> Boolean:
        """Whether the residual is positive: what it was at the last event, or, within noEvent(), what it is."""
        if self._event_free:
            return residual > 0
        self.relations.append(Relation(residual, text, origin))
        return holds(len(self.relations) - 1)

    def _unsupported(self, node: Mapping[str, Any]) -> BuildError:
        tag, body = next(iter(node.items()))
        what = body.get("op") or body.get("function") or tag
        text = self.sources.text(body["span"]) if "span" in body else ""
        return BuildError(f"{self.sources.find_place(node)}: {unwrap(what)} in {text!r}: not supported")
