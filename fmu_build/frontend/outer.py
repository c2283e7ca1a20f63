"""``outer`` parameters and discrete variables get the values of the nearest ``inner`` ones around them.

rumoca's flat form keeps both, without a connection where one is declared ``inner outer``, or is no parameter.
"""

from __future__ import annotations

from typing import Any

from .sources import Sources

Node = dict[str, Any]


def with_inner(flat: Node, sources: Sources) -> Node:
    """The flat model, in which an outer variable that has no value refers to its inner one."""
    variables = dict(flat["variables"])
    for name, node in flat["variables"].items():
        if node["binding"] is None and "." in name and sources.is_declared("outer", node["source_span"]):
            inner = next((other for other in _around(name) if _is_inner(other, flat, sources)), None)
            if inner is not None:
                reference = {"name": {"name": inner}, "subscripts": [], "span": node["source_span"]}
                variables[name] = {**node, "binding": {"VarRef": reference}}
    return {**flat, "variables": variables}


def _around(name: str) -> list[str]:
    """What may be the inner one, the nearest first: ``b.i``, then ``i``, of ``b.a.i``."""
    *scopes, last = name.split(".")
    return [".".join([*scopes[:depth], last]) for depth in reversed(range(len(scopes)))]


def _is_inner(name: str, flat: Node, sources: Sources) -> bool:
    node = flat["variables"].get(name)
    return node is not None and sources.is_declared("inner", node["source_span"])
