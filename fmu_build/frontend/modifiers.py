"""Values that are handed down through modifiers. rumoca puts them in at the innermost place, as if written there.

Of ``A a(k = 3)`` where A has ``B b(k = k)``, it makes ``a.b.k = 3``: setting ``a.k`` would have no effect. But the
value bears the place in the source where it stands, and so shows which parameter outside it came through.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

Node = Mapping[str, Any]
Place = tuple[int, int, int]


def with_modifiers(flat: dict[str, Any], fixed: frozenset[str]) -> dict[str, Any]:
    """The flat model, in which parameters refer to those that hand them their values; ``fixed`` names stay values."""
    variables = dict(flat["variables"])
    for name, giver in _givers(variables).items():
        if name not in fixed:
            span = next(iter(variables[name]["binding"].values()))["span"]
            reference = {"VarRef": {"name": {"name": giver}, "subscripts": [], "span": span}}
            variables[name] = {**variables[name], "binding": reference}
    return {**flat, "variables": variables}


def _givers(variables: Mapping[str, Node]) -> dict[str, str]:
    """Each parameter that has its value through another one, and that one, the nearest."""
    outer: dict[Place, list[str]] = {}
    for name, node in variables.items():
        if "Parameter" in node["variability"] and not node["dims"] and (place := _place(node["binding"])) is not None:
            outer.setdefault(place, []).append(name)
    found = {}
    for names in outer.values():
        for name in names:
            above = [other for other in names if _holds(other, name)]
            if above:
                found[name] = max(above, key=len)
    return found


def _holds(outer: str, inner: str) -> bool:
    """Whether ``outer`` is a parameter of a component that ``inner`` lies further inside of."""
    parent, other = outer.rpartition(".")[0], inner.rpartition(".")[0]
    return other != parent and f"{other}.".startswith(f"{parent}." if parent else "")


def _place(binding: Node | None) -> Place | None:
    span = next(iter(binding.values())).get("span") if binding else None
    return (span["source"], span["start"], span["end"]) if span else None
