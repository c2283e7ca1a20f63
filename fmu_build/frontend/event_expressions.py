"""What expressions say of events: Boolean values, pre, edge, change, sample, rounding, enumerations.

A relation between discrete variables alone is no Relation: it changes at events only. One between the time and discrete
variables is a time event, whose time is known. Rounding a continuous expression (floor, div, mod, ...) gives an Integer
variable with two relations, which tell when the next integer is reached.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import sympy
from sympy.logic.boolalg import Boolean

from ..errors import BuildError
from ..ir.conditions import compare
from ..ir.equations import Assignment, EnumerationType, Relation
from ..ir.events import Check, Message, Sample
from ..ir.functions import reach_time, round_down
from ..ir.symbols import INITIAL, TERMINAL, TIME, Kind, holds, is_true, kind_of, numbered, pre, symbol, truth
from .expressions import RELATIONS, ExpressionReader
from .sources import Sources
from .values import Value, combine, each, elements

COMPARISONS = {"Lt": sympy.Lt, "Le": sympy.Le, "Gt": sympy.Gt, "Ge": sympy.Ge}
LOGIC = {"And": sympy.And, "Or": sympy.Or, "Not": sympy.Not}
BOOLEAN_OPERATORS = {*LOGIC, "Eq", "Neq", *RELATIONS}
BOOLEAN_CALLS = {"Edge", "Change", "Initial", "Terminal", "Sample"}
HALF = sympy.Float(0.5)  # a Boolean value above it is true
NAMED = {"VarRef", "Index", "FieldAccess", "FunctionCall"}  # expressions whose type their names tell
ROUNDING: Mapping[str, Callable[..., sympy.Expr]] = {  # in terms of rounding down
    "Floor": lambda down, x: down(x),
    "Integer": lambda down, x: down(x),
    "Ceil": lambda down, x: -down(-x),
    "Mod": lambda down, x, y: x - y * down(x / y),
}
TRUNCATION: Mapping[str, Callable[..., sympy.Expr]] = {  # in terms of rounding towards zero
    "Div": lambda cut, x, y: cut(x / y),
    "Rem": lambda cut, x, y: x - y * cut(x / y),
}


@dataclass(frozen=True)
class Declared:
    """What the declarations say of names: their types, and which change at events alone or never."""

    types: Mapping[str, str]
    discrete: frozenset[str]
    constant: frozenset[str]  # parameters among them
    literals: Mapping[str, int]  # of enumerations

    @cached_property
    def still(self) -> frozenset[str]:
        """What does not change in between events."""
        return self.discrete | self.constant


class EventReader(ExpressionReader):
    """Reads all that an ExpressionReader does, and events. ``samples``, ``rounded`` and ``asserted`` collect what
    it meets."""

    def __init__(
        self, sources: Sources, declared: Declared, flat: Mapping[str, Any], fixed: frozenset[str] = frozenset()
    ) -> None:
        super().__init__(sources, flat, fixed)
        self.declared = declared
        self.samples: list[Sample] = []
        self.rounded: list[Assignment] = []
        self.asserted: list[Check] = []  # by functions
        self._texts = {
            name: node["binding"]
            for name, node in flat["variables"].items()
            if declared.types.get(name) == "String" and node["binding"] is not None
        }

    def read(self, node: Mapping[str, Any]) -> Value:
        """A value; true is 1 and false 0."""
        tag, body = next(iter(node.items()))
        if tag == "VarRef" and (number := self._literal_number(body)) is not None:
            return sympy.Integer(number)
        if self._is_boolean(node):
            return self._elementwise(body) if self._is_logic_of_arrays(node) else truth(self.condition(node))
        if tag == "BuiltinCall" and body["function"] == "Pre":
            return combine(lambda x: symbol(pre(self._variable_name(x, node))), super().read(body["args"][0]))
        if tag == "BuiltinCall" and body["function"] in {*ROUNDING, *TRUNCATION}:
            return self._rounded(body)
        return super().read(node)

    def read_event_free(self, node: Mapping[str, Any]) -> sympy.Expr:
        """A value whose conditions are no relations: for what is evaluated at events or at the start alone."""
        return self._without_events(node)

    def condition(self, node: Mapping[str, Any]) -> Boolean:
        """A Boolean expression."""
        return self._condition(node)

    def conditions(self, node: Mapping[str, Any]) -> list[Boolean]:
        """The elements of a Boolean vector, or a single one."""
        tag, body = next(iter(node.items()))
        if tag == "Array":
            return [condition for element in body["elements"] for condition in self.conditions(element)]
        if (tag in NAMED or self._is_logic_of_arrays(node)) and isinstance(found := self.read(node), np.ndarray):
            return [compare(sympy.Gt, element, HALF) for element in elements(found)]
        return [self.condition(node)]

    def condition_event_free(self, node: Mapping[str, Any]) -> Boolean:
        """A Boolean expression that is evaluated at events alone."""
        outside, self._event_free = self._event_free, True
        try:
            return self._condition(node)
        finally:
            self._event_free = outside

    def message(self, node: Mapping[str, Any]) -> Message:
        """A String expression: literals and conversions of scalars."""
        tag, body = next(iter(node.items()))
        if tag == "Literal" and "String" in body["value"]:
            return Message(str(body["value"]["String"]).replace("%", "%%"))
        if tag == "VarRef" and body["name"]["name"] in self._texts:
            return self.message(self._texts[body["name"]["name"]])
        if tag == "StringConversion":
            return Message("%s", ((self.read_event_free(body["value"]), self._type(body["value"])),))
        if tag == "Binary" and body["op"] == "Add":
            left, right = self.message(body["lhs"]), self.message(body["rhs"])
            return Message(left.format + right.format, (*left.values, *right.values))
        place = self.sources.find_place(node)
        raise BuildError(f"{place}: only texts, String parameters and String(scalar), joined by +, are supported")

    def check(self, node: Mapping[str, Any]) -> Check:
        """An assertion: looked at after each step, no event of its own."""
        level = node.get("level")
        is_warning = level is not None and self.read(level) == 1  # AssertionLevel.warning
        return Check(
            sympy.Not(self.condition_event_free(node["condition"])),
            self.message(node["message"]),
            "WARN" if is_warning else "FAIL",
            self.sources.find_place(node),
        )

    def assertion(self, node: Mapping[str, Any]) -> None:
        """Keep what a function asserts, if an equation calls it in any case, and at any time."""
        check = self.check(node)
        if check.violated == sympy.false:
            return
        if not self._shares:
            raise ValueError(
                "an assertion in a function that is called under a condition, or elsewhere than in an equation: not"
                " supported; assert it beside the call"
            )
        self.asserted.append(check)

    def is_discrete_valued(self, node: Mapping[str, Any]) -> bool:
        """Whether the value is a Boolean, an Integer or an enumeration's."""
        tag, body = next(iter(node.items()))
        is_variable = tag == "VarRef" and self.declared.types.get(body["name"]["name"], "Real") != "Real"
        return is_variable or self._is_boolean(node)

    def _literal_number(self, body: Mapping[str, Any]) -> int | None:
        name = body["name"]["name"]
        return None if name in self.declared.types else self.declared.literals.get(name)

    def _type(self, node: Mapping[str, Any]) -> str:
        tag, body = next(iter(node.items()))
        if tag == "VarRef":
            return self.declared.types.get(body["name"]["name"], "Real")
        return "Boolean" if self._is_boolean(node) else "Real"

    def _is_boolean(self, node: Mapping[str, Any]) -> bool:
        """Whether the node itself is Boolean; a variable is read as it is."""
        tag, body = next(iter(node.items()))
        if tag == "Literal":
            return "Boolean" in body["value"]
        if tag in {"Binary", "Unary"}:
            return body["op"] in BOOLEAN_OPERATORS
        if tag == "BuiltinCall" and body["function"] == "NoEvent":
            return self._is_boolean(body["args"][0])
        return tag == "BuiltinCall" and body["function"] in BOOLEAN_CALLS

    def _is_logic_of_arrays(self, node: Mapping[str, Any]) -> bool:
        tag, body = next(iter(node.items()))
        if tag in {"Binary", "Unary"} and body["op"] in LOGIC:
            return any(self._is_logic_of_arrays(body[side]) for side in ("lhs", "rhs") if side in body)
        if tag == "VarRef":
            return not any("Expr" in s for s in body["subscripts"]) and isinstance(self.read(node), np.ndarray)
        return tag == "Array"

    def _elementwise(self, body: Mapping[str, Any]) -> Value:
        """``and``, ``or`` or ``not`` of arrays."""
        operands = [self.read(body[side]) for side in ("lhs", "rhs") if side in body]
        return each(lambda *x: truth(LOGIC[body["op"]](*(compare(sympy.Gt, y, HALF) for y in x))), *operands)

    def _condition(self, node: Mapping[str, Any]) -> Boolean:
        tag, body = next(iter(node.items()))
        if tag == "Literal" and "Boolean" in body["value"]:
            return sympy.true if body["value"]["Boolean"] else sympy.false
        if tag in NAMED:
            return compare(sympy.Gt, self.read_scalar(node), HALF)
        if tag == "If":
            return self._conditional_condition(body)
        if tag == "Binary" and body["op"] in {"Eq", "Neq"}:
            equal = self._equal(body["lhs"], body["rhs"])
            return equal if body["op"] == "Eq" else sympy.Not(equal)
        if tag == "BuiltinCall":
            return self._call_condition(body)
        return super()._condition(node)

    def _conditional_condition(self, body: Mapping[str, Any]) -> Boolean:
        result = self._condition(body["else_branch"])
        for condition, value in reversed(body["branches"]):
            chosen = self._condition(condition)
            result = sympy.Or(sympy.And(chosen, self._condition(value)), sympy.And(sympy.Not(chosen), result))
        return result

    def _equal(self, left: Mapping[str, Any], right: Mapping[str, Any]) -> Boolean:
        if self._type(left) == "Boolean" or self._type(right) == "Boolean":
            a, b = self._condition(left), self._condition(right)
            return sympy.Or(sympy.And(a, b), sympy.And(sympy.Not(a), sympy.Not(b)))
        return compare(sympy.Eq, self.read_scalar(left), self.read_scalar(right))

    def _call_condition(self, body: Mapping[str, Any]) -> Boolean:
        function, arguments = body["function"], body["args"]
        if function == "Initial":
            return is_true(INITIAL)
        if function == "Terminal":
            return is_true(TERMINAL)
        if function == "NoEvent":
            return self.condition_event_free(arguments[0])
        if function == "Sample" and len(arguments) == 2:
            start, interval = (self.read_event_free(argument) for argument in arguments)
            self.samples.append(Sample(start, interval, self.sources.find_place(body)))
            return is_true(numbered(Kind.SAMPLE, len(self.samples) - 1))
        if function in {"Pre", "Edge", "Change"}:
            name = self._variable_name(super().read(arguments[0]), arguments[0])
            if function == "Pre":
                return is_true(pre(name))
            if function == "Change":
                return sympy.Ne(symbol(name), symbol(pre(name)))
            return sympy.And(is_true(name), sympy.Not(is_true(pre(name))))
        raise self._unsupported({"BuiltinCall": body})

    def _variable_name(self, operand: Value, node: Mapping[str, Any]) -> str:
        if not (isinstance(operand, sympy.Basic) and operand.is_Symbol):
            place = self.sources.find_place(node)
            raise BuildError(
                f"{place}: pre(), edge() and change() take a variable: give this expression a name of its own"
            )
        return str(operand.name)

    def _changes_at_events_alone(self, expression: sympy.Expr) -> bool:
        return all(
            s.name in self.declared.discrete
            or s.name in self.declared.constant
            or kind_of(s.name) in {Kind.HOLDS, Kind.BEFORE, Kind.ROUNDED}
            or s.name in {INITIAL, TERMINAL}
            for s in expression.free_symbols
        )

    def _relation(self, body: Mapping[str, Any]) -> Boolean:
        left, right = self.read(body["lhs"]), self.read(body["rhs"])
        symbols = {s.name for s in (left - right).free_symbols}
        if not symbols <= self.declared.constant and self._changes_at_events_alone(left - right):
            return compare(COMPARISONS[body["op"]], left, right)
        if TIME in symbols and not self._event_free and (line := self._line(left - right)) is not None:
            rest, slope = line
            before = self._before(-rest / slope, self.sources.text(body["span"]), self.sources.place(body["span"]))
            return sympy.Not(before) if (slope > 0) == (body["op"] in {"Gt", "Ge"}) else before
        return super()._relation(body)

    def _line(self, expression: sympy.Expr) -> tuple[sympy.Expr, sympy.Expr] | None:
        """Rest and slope of an expression that is linear in time and otherwise changes at events alone."""
        time = symbol(TIME)
        slope = expression.diff(time)
        rest = expression.xreplace({time: sympy.Integer(0)})
        is_line = slope.is_number and slope != 0 and self._changes_at_events_alone(rest)
        return (rest, slope) if is_line else None

    def _before(self, until: sympy.Expr, text: str, origin: str) -> sympy.Symbol:
        """A time event: true before that time, and false at this very time already."""
        self.relations.append(Relation(until - symbol(TIME), text, origin, until))
        return holds(len(self.relations) - 1)

    def _rounded(self, body: Mapping[str, Any]) -> Value:
        arguments = [self.read(argument) for argument in body["args"]]
        if body["function"] in ROUNDING:
            return each(lambda *x: ROUNDING[body["function"]](lambda y: self._down(y, body), *x), *arguments)
        return each(lambda *x: TRUNCATION[body["function"]](lambda y: self._cut(y, body), *x), *arguments)

    def _cut(self, x: sympy.Expr, body: Mapping[str, Any]) -> sympy.Expr:
        """Rounded towards zero."""
        if x.is_number:
            return sympy.Integer(int(x))
        is_discrete = self._event_free or self._changes_at_events_alone(x)
        text, origin = self.sources.text(body["span"]), self.sources.find_place(body)
        negative = (
            compare(sympy.Lt, x, sympy.Integer(0)) if is_discrete else self._is_below(x, sympy.Integer(0), text, origin)
        )
        pairs = [(-self._down(-x, body), negative), (self._down(x, body), True)]
        return sympy.Piecewise(*pairs, evaluate=False)

    def _down(self, x: sympy.Expr, body: Mapping[str, Any]) -> sympy.Expr:
        if self._event_free or self._changes_at_events_alone(x):
            return round_down(x)
        text, origin = self.sources.text(body["span"]), self.sources.find_place(body)
        name = numbered(Kind.ROUNDED, len(self.rounded))
        before = symbol(pre(name))
        below = self._is_below(x, before, text, origin)
        inside = self._is_below(x, before + 1, text, origin)
        lower, higher = sympy.Min(round_down(x), before - 1), sympy.Max(round_down(x), before + 1)
        value = sympy.Piecewise(
            (round_down(x), is_true(INITIAL)), (lower, below), (before, inside), (higher, True), evaluate=False
        )
        self.rounded.append(Assignment(name, value, origin))
        return symbol(name)

    def _is_below(self, x: sympy.Expr, limit: sympy.Expr, text: str, origin: str) -> Boolean:
        line = self._line(x)
        if line is None:
            return self._holds(limit - x, text, origin)
        rest, slope = line
        before = self._before(reach_time(limit, rest, slope), text, origin)
        return before if slope > 0 else sympy.Not(before)


def enumeration_types(flat: Mapping[str, Any]) -> dict[str, EnumerationType]:
    """The enumerations of a flat model by the name of the type, as variables bear it: whole, or its last parts."""
    literals: dict[str, dict[int, str]] = {}
    for full_name, number in flat["enum_literal_ordinals"].items():
        name, _, literal = full_name.rpartition(".")
        literals.setdefault(name, {}).setdefault(number, literal.strip("'"))
    types = {name: EnumerationType(name, tuple(by[i] for i in sorted(by))) for name, by in literals.items()}
    borne = set(flat["variable_type_names"].values()) - types.keys()
    return types | {kind: types[name] for kind in borne for name in types if name.endswith(f".{kind}")}
