"""Clocks of rumoca's flat form as ``when sample(start, interval)``. Modelica 3.6, chapter 16.

What equations connect other than by ``hold``, ``sample`` and the like is one partition, and has one clock. At each of
its ticks all its equations hold together, so they become those of a when-clause: ``previous(x)`` is ``pre(x)``,
``sample(u)``, the left limit, has ``pre`` around what varies, and a value of another clock is the last one.
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


def without_clocks(flat: Node, sources: Sources) -> Node:
    """The flat model with when-clauses in place of clocks.

    Raises BuildError, with the place, where a clock is none of those that can be told beforehand.
    """
    return _Clocks(flat, sources).rewritten() if "Clock" in flat["variable_type_names"].values() else flat


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


def _names(tree: Any) -> Iterator[str]:
    """The variables that an expression has in its own partition."""
    if isinstance(tree, list):
        for item in tree:
            yield from _names(item)
    elif isinstance(tree, dict):
        call = tree.get("BuiltinCall")
        if "VarRef" in tree:
            yield tree["VarRef"]["name"]["name"]
        elif isinstance(tree.get("target"), str):
            yield tree["target"]
        if call is None:
            for item in tree.values():
                yield from _names(item)
        elif call["function"] not in {*CROSSING, "Sample"}:
            yield from _names(call["args"])


class _Clocks:
    def __init__(self, flat: Node, sources: Sources) -> None:
        self._flat, self._sources = flat, sources
        kinds = flat["variable_type_names"]
        self._clocks = {name for name in flat["variables"] if kinds.get(name) == "Clock"}
        self._still = {"time"} | {
            name for name, node in flat["variables"].items() if unwrap(node["variability"]) in {"Parameter", "Constant"}
        }
        self._definitions: dict[str, Node] = {}
        self._equations: list[Node] = []  # bindings of variables among them
        for name, node in flat["variables"].items():
            if node["binding"] is not None and name not in self._still:
                self._add(_equation(name, node))
        for index, node in enumerate(flat["equations"]):
            self._add({**node, "index": index})
        self._partitions = self._connected()
        self._known: dict[str, Clock] = {}

    def _add(self, node: Node) -> None:
        body = node["residual"].get("Binary", {})
        for one, other in (("lhs", "rhs"), ("rhs", "lhs")):
            name = body.get(one, {}).get("VarRef", {}).get("name", {}).get("name")
            if name in self._clocks and name not in self._definitions:
                self._definitions[name] = body[other]
                return
        self._equations.append(node)

    def _connected(self) -> dict[str, list[Any]]:
        """For each variable what may tell the clock of its partition: clocks, and calls that have one."""
        graph = nx.Graph()
        hints: dict[str, list[Any]] = {}
        chains = [[chain["first"], *chain["else_when"]] for chain in self._flat["when_chains"]]
        for tree in (*(node["residual"] for node in self._equations), *chains):
            names = [name for name in _names(tree) if name not in self._still | self._clocks]
            graph.add_nodes_from(names)
            graph.add_edges_from(pairwise(names))
            hints.setdefault(names[0] if names else "", []).extend(self._hints(tree))
        return {
            name: [hint for member in members for hint in hints.get(member, ())]
            for members in map(sorted, nx.connected_components(graph))
            for name in members
        }

    def _hints(self, tree: Any) -> Iterator[Node]:
        if isinstance(tree, list) and self._clock_named(tree[0]["condition"]):
            yield tree[0]["condition"]
        for function, arguments, call in _calls(tree):
            if function == "Sample" and len(arguments) == 2 and self._clock_named(arguments[1]):
                yield arguments[1]
            elif function in CLOCKED:
                yield call

    def _clock_named(self, node: Node) -> str:
        """The Clock variable that an expression is; "" if it is another one."""
        name = node.get("VarRef", {}).get("name", {}).get("name", "")
        return str(name) if name in self._clocks else ""

    def _of_partition(self, name: str, asked: frozenset[str] = frozenset()) -> Clock | None:
        """The clock of a variable's partition; None if that is continuous."""
        hints = self._partitions.get(name, [])
        for hint in hints if name not in asked else ():
            if found := self._told(hint, asked | {name}):
                return found
        if hints:
            raise BuildError(f"{self._sources.find_place(hints[0])}: the clock of {name} cannot be told: {REMEDY}")
        return None

    def _told(self, node: Node, asked: frozenset[str] = frozenset()) -> Clock | None:
        """The clock that an expression is, or that its value has; None where it tells none."""
        if name := self._clock_named(node):
            if name not in self._known:
                if name in asked or name not in self._definitions:
                    raise BuildError(f"{self._sources.find_place(node)}: the clock {name} cannot be told: {REMEDY}")
                self._known[name] = self._given(self._definitions[name], asked | {name})
            return self._known[name]
        function, arguments, _ = next(_calls(node))
        if function not in CONVERSIONS:
            return None
        base = next((found for name in _names(arguments[0]) if (found := self._of_partition(name, asked))), None)
        return None if base is None else self._converted(base, node)

    def _given(self, node: Node, asked: frozenset[str]) -> Clock:
        """The clock that an expression of type Clock gives."""
        if self._clock_named(node):
            return self._told(node, asked) or Clock()
        nothing: tuple[str, list[Node], Node] = ("", [], node)
        function, arguments, _ = next(_calls(node), nothing)
        if function in CONVERSIONS:
            return self._converted(self._given(arguments[0], asked), node)
        if (
            function != "Clock"
            or not 0 < len(arguments) < 3
            or (set(_names(arguments)) - self._still and arguments[1:])
        ):
            raise BuildError(f"{self._sources.find_place(node)}: this clock is not supported: {REMEDY}")
        if len(arguments) == 2:
            return Clock(start=_integer(0, node), interval=_binary("Div", arguments[0], arguments[1]))
        if set(_names(arguments)) - self._still:
            return Clock(condition=arguments[0])
        return Clock(start=_integer(0, node), interval=arguments[0])

    def _converted(self, base: Clock, node: Node) -> Clock:
        function, (_, *numbers), _ = next(_calls(node))
        if base.condition or not numbers:
            raise BuildError(f"{self._sources.find_place(node)}: {function} here: {REMEDY}, by a number")
        if function in {"SubSample", "SuperSample"}:
            return Clock(base.start, _binary("Mul" if function == "SubSample" else "Div", base.interval, numbers[0]))
        shift = _binary("Mul", base.interval, numbers[0])
        shift = _binary("Div", shift, numbers[1]) if numbers[1:] else shift
        return Clock(_binary("Add" if function == "ShiftSample" else "Sub", base.start, shift), base.interval)

    def rewritten(self) -> Node:
        """The flat model without clocks."""
        variables = {name: node for name, node in self._flat["variables"].items() if name not in self._clocks}
        chains, equations = [], []
        for node in self._equations:
            clock = next((c for name in _names(node["residual"]) if (c := self._of_partition(name))), None)
            residual = self._plain(node["residual"], clock)
            declared = node.get("declared")
            if clock is not None and not _is_alias(node["residual"]):
                chains.append(_chain(_condition(clock), [self._assignment(residual, node)]))
                if declared:
                    variables[declared] = {**variables[declared], "binding": None}
            elif declared:
                variables[declared] = {**variables[declared], "binding": residual["Binary"]["rhs"]}
            else:
                equations.append({**node, "residual": residual})
        chains += map(self._plain_chain, self._flat["when_chains"])
        for name in variables.keys() & self._partitions.keys():
            if self._of_partition(name) is not None:
                variables[name] = {**variables[name], "variability": "Discrete"}
        loops = [
            {**loop, "first_equation_index": sum(node["index"] < loop["first_equation_index"] for node in equations)}
            for loop in self._flat["structured_equations"]
        ]
        left = {"variables": variables, "equations": equations, "structured_equations": loops, "when_chains": chains}
        return {**self._flat, **left}

    def _plain_chain(self, chain: Node) -> Node:
        condition = chain["first"]["condition"]
        clock = self._told(condition) if self._clock_named(condition) else None
        plain: Node = self._plain(chain, clock)
        return plain if clock is None else {**plain, "first": {**plain["first"], "condition": _condition(clock)}}

    def _assignment(self, residual: Node, node: Node) -> Node:
        body = residual.get("Binary", {})
        for one, other in (("lhs", "rhs"), ("rhs", "lhs")):
            if "VarRef" in body.get(one, {}):
                reference = body[one]["VarRef"]
                part = {"ident": reference["name"]["name"], "subs": reference.get("subscripts", [])}
                return {"Assign": {"comp": {"parts": [part]}, "value": body[other], "span": node["span"]}}
        raise BuildError(f"{self._sources.find_place(node)}: an equation with a clock must read: name = expression")

    def _plain(self, tree: Any, clock: Clock | None) -> Any:
        """The tree without operators of clocks."""
        if isinstance(tree, list):
            return [self._plain(item, clock) for item in tree]
        if not isinstance(tree, dict):
            return tree
        call = tree.get("BuiltinCall")
        if call is None:
            return {key: self._plain(item, clock) for key, item in tree.items()}
        function, arguments = call["function"], [self._plain(argument, clock) for argument in call["args"]]
        if function in CROSSING:
            return arguments[0]
        if function == "Sample" and (len(arguments) == 1 or self._clock_named(arguments[1])):
            return self._before(arguments[0])
        if function == "Previous":
            return {"BuiltinCall": {**call, "function": "Pre", "args": arguments}}
        if function in {"Interval", "FirstTick"}:
            if clock is None or clock.condition:
                raise BuildError(f"{self._sources.find_place(tree)}: {function} of a clock without an interval")
            if function == "Interval":
                return clock.interval
            half = _binary("Div", clock.interval, _integer(2, tree))
            return _binary("Lt", _reference("time", tree), _binary("Add", clock.start, half))
        return {"BuiltinCall": {**call, "args": arguments}}

    def _before(self, tree: Any) -> Any:
        """The left limit of an expression."""
        if isinstance(tree, list):
            return [self._before(item) for item in tree]
        if not isinstance(tree, dict):
            return tree
        if "VarRef" in tree and tree["VarRef"]["name"]["name"] not in self._still:
            return {"BuiltinCall": {"function": "Pre", "args": [tree], "span": tree["VarRef"]["span"]}}
        return {key: self._before(item) for key, item in tree.items()}


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


def _is_alias(residual: Node) -> bool:
    """Whether it says that two variables are equal: which of them it determines depends on other equations."""
    body = residual.get("Binary", {})
    return "VarRef" in body.get("lhs", {}) and "VarRef" in body.get("rhs", {})


def _condition(clock: Clock) -> Node:
    if clock.condition:
        return clock.condition
    return {"BuiltinCall": {"function": "Sample", "args": [clock.start, clock.interval], "span": _span(clock.interval)}}


def _chain(condition: Node, equations: list[Node]) -> Node:
    return {"first": {"condition": condition, "equations": equations}, "else_when": []}


def _span(node: Mapping[str, Any]) -> Any:
    body = next(iter(node.values()))
    return body["span"]


def _integer(value: int, place: Node) -> Node:
    return {"Literal": {"value": {"Integer": value}, "span": _span(place)}}


def _binary(operator: str, left: Node, right: Node) -> Node:
    return {"Binary": {"op": operator, "lhs": left, "rhs": right, "span": _span(left)}}


def _reference(name: str, place: Node) -> Node:
    return {"VarRef": {"name": {"name": name}, "subscripts": [], "span": _span(place)}}
