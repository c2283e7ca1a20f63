"""Equations with clocks as when-clauses: at each tick of a partition's clock all of them hold together.

``previous(x)`` is ``pre(x)``, ``sample(u)``, the left limit, has ``pre`` around what varies, and a value of another
clock is its last one.
"""

from __future__ import annotations

from typing import Any

from ..errors import BuildError
from .clocks import CROSSING, Clock, Node, Partitions, binary, integer, names_in, reference, span_of
from .sources import Sources


def without_clocks(flat: Node, sources: Sources) -> Node:
    """The flat model with when-clauses in place of clocks.

    Raises BuildError, with the place, where a clock is none of those that can be told beforehand.
    """
    return _Rewriting(flat, sources).flat() if "Clock" in flat["variable_type_names"].values() else flat


class _Rewriting:
    def __init__(self, flat: Node, sources: Sources) -> None:
        self._flat, self._sources = flat, sources
        self._partitions = Partitions(flat, sources)

    def flat(self) -> Node:
        """The flat model without clocks."""
        clocks = self._partitions.clocks
        variables = {name: node for name, node in self._flat["variables"].items() if name not in clocks}
        chains, equations = [], []
        for node in self._partitions.equations:
            clock = next((c for name in names_in(node["residual"]) if (c := self._partitions.of_partition(name))), None)
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
        for name in variables:
            if self._partitions.of_partition(name) is not None:
                variables[name] = {**variables[name], "variability": "Discrete"}
        loops = [
            {**loop, "first_equation_index": sum(node["index"] < loop["first_equation_index"] for node in equations)}
            for loop in self._flat["structured_equations"]
        ]
        left = {"variables": variables, "equations": equations, "structured_equations": loops, "when_chains": chains}
        return {**self._flat, **left}

    def _plain_chain(self, chain: Node) -> Node:
        condition = chain["first"]["condition"]
        clock = self._partitions.told(condition) if self._partitions.clock_named(condition) else None
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
        if function == "Sample" and (len(arguments) == 1 or self._partitions.clock_named(arguments[1])):
            for name in names_in(call["args"][0]):
                if self._partitions.of_partition(name) is not None:
                    place = self._sources.find_place(tree)
                    raise BuildError(f"{place}: sample of {name}, which has a clock already: write hold({name}) in it")
            return self._before(arguments[0])
        if function == "Previous":
            return {"BuiltinCall": {**call, "function": "Pre", "args": arguments}}
        if function in {"Interval", "FirstTick"}:
            if clock is None or clock.condition:
                raise BuildError(f"{self._sources.find_place(tree)}: {function} of a clock without an interval")
            if function == "Interval":
                return clock.interval
            half = binary("Div", clock.interval, integer(2, tree))
            return binary("Lt", reference("time", tree), binary("Add", clock.start, half))
        return {"BuiltinCall": {**call, "args": arguments}}

    def _before(self, tree: Any) -> Any:
        """The left limit of an expression."""
        if isinstance(tree, list):
            return [self._before(item) for item in tree]
        if not isinstance(tree, dict):
            return tree
        if "VarRef" in tree and tree["VarRef"]["name"]["name"] not in self._partitions.still:
            return {"BuiltinCall": {"function": "Pre", "args": [tree], "span": tree["VarRef"]["span"]}}
        return {key: self._before(item) for key, item in tree.items()}


def _is_alias(residual: Node) -> bool:
    """Whether it says that two variables are equal: which of them it determines depends on other equations."""
    body = residual.get("Binary", {})
    return "VarRef" in body.get("lhs", {}) and "VarRef" in body.get("rhs", {})


def _condition(clock: Clock) -> Node:
    if clock.condition:
        return clock.condition
    times = [clock.start, clock.interval]
    return {"BuiltinCall": {"function": "Sample", "args": times, "span": span_of(clock.interval)}}


def _chain(condition: Node, equations: list[Node]) -> Node:
    return {"first": {"condition": condition, "equations": equations}, "else_when": []}
