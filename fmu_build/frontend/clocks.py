"""Clocks of rumoca's flat form: which variable has which, and when it ticks. Modelica 3.6, chapter 16.

What equations connect other than by ``hold``, ``sample`` and the like is one partition, and has one clock.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

import networkx as nx

from ..errors import BuildError
from .expressions import unwrap
from .sources import Sources

Node = dict[str, Any]
CONVERSIONS = {"SubSample", "SuperSample", "ShiftSample", "BackSample"}
CROSSING = CONVERSIONS | {"Hold", "NoClock"}  # what stands in them belongs to another partition
CLOCKED = CONVERSIONS | {"Previous", "Interval", "FirstTick"}
REMEDY = "supported are Clock(interval), Clock(counter, resolution), Clock(condition) and conversions of these"


@dataclass(frozen=True)
class Clock:
    """Ticks at ``start`` + i*``interval``, or whenever ``condition`` becomes true. Expressions of rumoca's."""

    start: Node = field(default_factory=dict)
    interval: Node = field(default_factory=dict)
    condition: Node = field(default_factory=dict)


def _calls(tree: Any) -> Iterator[tuple[str, list[Node], Node]]:
    """All calls of built-in functions, with their arguments; those around others first."""
    if isinstance(tree, list):
        for item in tree:
            yield from _calls(item)
    elif isinstance(tree, dict):
        if "BuiltinCall" in tree:
            yield tree["BuiltinCall"]["function"], tree["BuiltinCall"]["args"], tree
        for item in tree.values():
            yield from _calls(item)


def names_in(tree: Any) -> Iterator[str]:
    """The variables that an expression has in its own partition."""
    if isinstance(tree, list):
        for item in tree:
            yield from names_in(item)
    elif isinstance(tree, dict):
        call = tree.get("BuiltinCall")
        if "VarRef" in tree:
            yield tree["VarRef"]["name"]["name"]
        elif isinstance(tree.get("target"), str):
            yield tree["target"]
        if call is None:
            for item in tree.values():
                yield from names_in(item)
        elif call["function"] not in {*CROSSING, "Sample"}:
            yield from names_in(call["args"])


class Partitions:
    """The equations of a flat model, bindings of variables among them, and the clocks of its variables."""

    def __init__(self, flat: Node, sources: Sources) -> None:
        self._flat, self._sources = flat, sources
        kinds = flat["variable_type_names"]
        self.clocks = {name for name in flat["variables"] if kinds.get(name) == "Clock"}
        self.still = {"time", *flat["enum_literal_ordinals"]} | {
            name for name, node in flat["variables"].items() if unwrap(node["variability"]) in {"Parameter", "Constant"}
        }
        self._definitions: dict[str, Node] = {}
        self.equations: list[Node] = []  # bindings of variables among them
        for name, node in flat["variables"].items():
            if node["binding"] is not None and name not in self.still:
                self._add(_equation(name, node))
        for index, node in enumerate(flat["equations"]):
            self._add({**node, "index": index})
        self._partitions = self._connected()
        self._known: dict[str, Clock] = {}

    def _add(self, node: Node) -> None:
        body = node["residual"].get("Binary", {})
        for one, other in (("lhs", "rhs"), ("rhs", "lhs")):
            name = body.get(one, {}).get("VarRef", {}).get("name", {}).get("name")
            if name in self.clocks and name not in self._definitions:
                self._definitions[name] = body[other]
                return
        self.equations.append(node)

    def _connected(self) -> dict[str, list[Any]]:
        """For each variable what may tell the clock of its partition: clocks, and calls that have one."""
        graph = nx.Graph()
        hints: dict[str, list[Any]] = {}
        chains = [[chain["first"], *chain["else_when"]] for chain in self._flat["when_chains"]]
        for tree in (*(node["residual"] for node in self.equations), *chains):
            names = [name for name in names_in(tree) if name not in self.still | self.clocks]
            graph.add_nodes_from(names)
            graph.add_edges_from(pairwise(names))
            hints.setdefault(names[0] if names else "", []).extend(self._hints(tree))
        return {
            name: [hint for member in members for hint in hints.get(member, ())]
            for members in map(sorted, nx.connected_components(graph))
            for name in members
        }

    def _hints(self, tree: Any) -> Iterator[Node]:
        if isinstance(tree, list) and self.clock_named(tree[0]["condition"]):
            yield tree[0]["condition"]
        for function, arguments, call in _calls(tree):
            if function == "Sample" and len(arguments) == 2 and self.clock_named(arguments[1]):
                yield arguments[1]
            elif function in CLOCKED:
                yield call

    def clock_named(self, node: Node) -> str:
        """The Clock variable that an expression is; "" if it is another one."""
        name = node.get("VarRef", {}).get("name", {}).get("name", "")
        return str(name) if name in self.clocks else ""

    def of_partition(self, name: str, asked: frozenset[str] = frozenset()) -> Clock | None:
        """The clock of a variable's partition; None if that is continuous."""
        hints = self._partitions.get(name, [])
        for hint in hints if name not in asked else ():
            if found := self.told(hint, asked | {name}):
                return found
        if hints:
            raise BuildError(f"{self._sources.find_place(hints[0])}: the clock of {name} cannot be told: {REMEDY}")
        return None

    def told(self, node: Node, asked: frozenset[str] = frozenset()) -> Clock | None:
        """The clock that an expression is, or that its value has; None where it tells none."""
        if name := self.clock_named(node):
            if name not in self._known:
                if name in asked or name not in self._definitions:
                    raise BuildError(f"{self._sources.find_place(node)}: the clock {name} cannot be told: {REMEDY}")
                self._known[name] = self._given(self._definitions[name], asked | {name})
            return self._known[name]
        function, arguments, _ = next(_calls(node))
        if function not in CONVERSIONS:
            return None
        base = next((found for name in names_in(arguments[0]) if (found := self.of_partition(name, asked))), None)
        return None if base is None else self._converted(base, node)

    def _given(self, node: Node, asked: frozenset[str]) -> Clock:
        """The clock that an expression of type Clock gives."""
        if self.clock_named(node):
            return self.told(node, asked) or Clock()
        nothing: tuple[str, list[Node], Node] = ("", [], node)
        function, arguments, _ = next(_calls(node), nothing)
        if function in CONVERSIONS:
            return self._converted(self._given(arguments[0], asked), node)
        if (
            function != "Clock"
            or not 0 < len(arguments) < 3
            or (set(names_in(arguments)) - self.still and arguments[1:])
        ):
            raise BuildError(f"{self._sources.find_place(node)}: this clock is not supported: {REMEDY}")
        if len(arguments) == 2:
            return Clock(start=integer(0, node), interval=binary("Div", arguments[0], arguments[1]))
        if set(names_in(arguments)) - self.still:
            return Clock(condition=arguments[0])
        return Clock(start=integer(0, node), interval=arguments[0])

    def _converted(self, base: Clock, node: Node) -> Clock:
        function, (_, *numbers), _ = next(_calls(node))
        if base.condition or not numbers:
            raise BuildError(f"{self._sources.find_place(node)}: {function} here: {REMEDY}, by a number")
        if function in {"SubSample", "SuperSample"}:
            return Clock(base.start, binary("Mul" if function == "SubSample" else "Div", base.interval, numbers[0]))
        shift = binary("Mul", base.interval, numbers[0])
        shift = binary("Div", shift, numbers[1]) if numbers[1:] else shift
        return Clock(binary("Add" if function == "ShiftSample" else "Sub", base.start, shift), base.interval)


def _equation(name: str, node: Node) -> Node:
    """A declaration's value as an equation."""
    span = node["source_span"]
    reference = {"VarRef": {"name": {"name": name}, "subscripts": [], "span": span}}
    return {
        "residual": {"Binary": {"op": "Sub", "lhs": reference, "rhs": node["binding"], "span": span}},
        "span": span,
        "origin": "Binding",
        "declared": name,
    }


def span_of(node: Mapping[str, Any]) -> Any:
    """The place of an expression."""
    body = next(iter(node.values()))
    return body["span"]


def integer(value: int, place: Node) -> Node:
    """A number, as if it stood at a place."""
    return {"Literal": {"value": {"Integer": value}, "span": span_of(place)}}


def binary(operator: str, left: Node, right: Node) -> Node:
    """An expression of two."""
    return {"Binary": {"op": operator, "lhs": left, "rhs": right, "span": span_of(left)}}


def reference(name: str, place: Node) -> Node:
    """A variable, as if it stood at a place."""
    return {"VarRef": {"name": {"name": name}, "subscripts": [], "span": span_of(place)}}
