"""Names in the modifiers of short classes: ``model B = A(y = x)`` means the x around B.

rumoca 0.10.2 takes A's x if there is one, and the value of the x around B as a number if not, so that setting it would
have no effect. Each such name bears its place in the text, and is looked up again.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from ..errors import BuildError
from .placed_values import PlacedValues, lies_in
from .sources import Sources
from .syntax import Span
from .used_classes import UsedClasses

NAME = re.compile(r"[A-Za-z_]\w*(\.[A-Za-z_]\w*)*")
PART = re.compile(r"(?:'(?:\\.|[^'\\])*'|[^.\[])+(?:\[[^\]]*\])?")  # of a name, with its subscripts


@dataclass(frozen=True)
class _Scope:
    """A modifier in a short class, in file ``source``, and what the names around and inside a component begin with."""

    source: int
    value: Span
    around: str
    inside: str


def rescoped(flat: dict[str, Any], sources: Sources, classes: UsedClasses) -> dict[str, Any]:
    """The flat model, with names in modifiers of short classes as they are meant.

    Raises BuildError, with the place, where there is no such variable around, and rumoca has taken one inside.
    """
    variables = dict(flat["variables"])
    for name, key, scope in _modified(flat, classes):
        variables[name] = {**variables[name], key: _looked_up(variables[name][key], scope, flat, sources)}
    return {**flat, "variables": variables}


def _modified(flat: dict[str, Any], classes: UsedClasses) -> Iterator[tuple[str, str, _Scope]]:
    """The variables that short classes modify, with the attribute that is modified."""
    values = PlacedValues(flat)
    for source, read in classes.used:
        for modifier in read.modifiers if read.is_short else ():
            for target in classes.targets(read, modifier):
                for key, ending in (("binding", target), ("start", target[:-1])):
                    for _, node in values.variables(ending) if target[0] else ():
                        parts = PART.findall(node["name"])
                        around = "".join(f"{part}." for part in parts[: len(parts) - len(ending)])
                        inside = f"{around}{parts[len(parts) - len(ending)]}."
                        yield node["name"], key, _Scope(source, modifier.value, around, inside)


def _looked_up(tree: Any, scope: _Scope, flat: dict[str, Any], sources: Sources) -> Any:
    if isinstance(tree, list):
        return [_looked_up(item, scope, flat, sources) for item in tree]
    if not isinstance(tree, dict):
        return tree
    tag: str
    body: Any
    tag, body = next(iter(tree.items()), ("", None))
    if tag not in {"VarRef", "Literal"} or not lies_in(body["span"], scope.source, scope.value):
        return {key: _looked_up(item, scope, flat, sources) for key, item in tree.items()}
    name = sources.text(body["span"]).partition("[")[0]
    outer = scope.around + name
    if NAME.fullmatch(name) and outer in flat["variables"]:
        reference = {"name": {"name": outer}, "subscripts": body.get("subscripts", []), "span": body["span"]}
        return {"VarRef": reference}
    if tag == "VarRef" and body["name"]["name"].startswith(scope.inside):
        raise BuildError(
            f"{sources.place(body['span'])}: {name} in the modifier of a short class means one around the class, and"
            f" rumoca takes {body['name']['name']}: give one of them another name"
        )
    return tree
