"""The variables of a flat model by their paths, and their values by the places in the text where they are written."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import Any

from .syntax import Span
from .used_classes import Path

Node = dict[str, Any]


class PlacedValues:
    """Variables and values of the flat model ``flat``."""

    def __init__(self, flat: Mapping[str, Any]) -> None:
        self._flat = flat
        self._variables: dict[str, list[tuple[Path, Node]]] = {}  # by the last part of their names
        self._fields: dict[str, list[tuple[Path, Node]]] = {}  # by the last part but one
        for node in flat["variables"].values():
            path = ("", *(part["ident"] for part in node["component_ref"]["parts"]))
            self._variables.setdefault(path[-1], []).append((path, node))
            self._fields.setdefault(path[-2], []).append((path[:-1], node))

    def variables(self, ending: Path) -> list[tuple[Path, Node]]:
        """The variables whose paths end so, with these."""
        return [(path, node) for path, node in self._variables.get(ending[-1], ()) if path[-len(ending) :] == ending]

    def fields(self, ending: Path) -> list[Node]:
        """The variables that lie directly in a component whose path ends so."""
        return [node for path, node in self._fields.get(ending[-1], ()) if path[-len(ending) :] == ending]

    def occurs(self, source: int, span: Span) -> bool:
        """Whether anything in the flat model is written within this part of a file."""
        starts = self._starts.get(source, [])
        at = bisect_left(starts, span[0])
        return at < len(starts) and starts[at] < span[1]

    @cached_property
    def _starts(self) -> dict[int, list[int]]:
        """Where all expressions and their parts begin, by file."""
        found: dict[int, set[int]] = {}
        for node in _nodes(self._flat):
            if isinstance(node.get("span"), dict):
                found.setdefault(node["span"]["source"], set()).add(node["span"]["start"])
        return {source: sorted(starts) for source, starts in found.items()}

    @cached_property
    def literals(self) -> list[Node]:
        """All literals, each with its value and its span."""
        return [node["Literal"] for node in _nodes(self._flat) if isinstance(node.get("Literal"), dict)]


def place(expression: Node | None) -> Mapping[str, int]:
    """The span of an expression; empty if there is none."""
    body = next(iter(expression.values())) if expression else {}
    return body.get("span") or {}


def lies_in(span: Mapping[str, int], source: int, outer: Span) -> bool:
    """Whether a span begins within this part of a file."""
    return span.get("source") == source and outer[0] <= span["start"] < outer[1]


def _nodes(tree: Any) -> Iterator[Node]:
    stack = [tree]
    while stack:
        item = stack.pop()
        if isinstance(item, dict):
            yield item
            stack.extend(item.values())
        elif isinstance(item, list):
            stack.extend(item)
