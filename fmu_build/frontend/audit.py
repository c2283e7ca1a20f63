"""Modifiers that rumoca drops without a word, found by comparing its flat model with the text.

rumoca 0.10.2 drops modifiers of a ``constrainedby`` clause, of a class that is redeclared in a modifier, of a nested
class, of an array inside a component, and the values of redeclared Reals. Values bear the place where they are written:
a modifier whose place occurs nowhere, while the variable that it is for has its default, is lost.
"""

from __future__ import annotations

import re
from typing import Any

from ..errors import BuildError
from .placed_values import Node, PlacedValues, lies_in, place
from .sources import Sources
from .syntax import ClassText, Modifier, Span
from .used_classes import Path, UsedClasses

NUMBER = re.compile(r"[+-]?\d+\.?\d*([eE][+-]?\d+)?")


def refuse_lost_modifiers(flat: dict[str, Any], sources: Sources, classes: UsedClasses) -> None:
    """BuildError, with the place, where a modifier is lost, or counts beyond its end."""
    audit = _Audit(flat, sources, classes)
    for source, read in classes.used:
        audit.names(source, read)
        for modifier in read.modifiers:
            audit.modifier(source, read, modifier)
        for modifier in read.replaced:
            audit.replaced(source, modifier)


class _Audit:
    def __init__(self, flat: dict[str, Any], sources: Sources, classes: UsedClasses) -> None:
        self._values, self._sources, self._classes = PlacedValues(flat), sources, classes
        self._own = [(source, given) for source, read in classes.used for given in read.values]
        self._redeclared: set[Path] = {
            path for _, read in classes.used for given in read.redeclared for path in classes.targets(read, given)
        }

    def modifier(self, source: int, read: ClassText, modifier: Modifier) -> None:
        """Refuse it if it is lost."""
        if self._values.occurs(source, modifier.value):
            return
        text = self._sources.text(_span(source, modifier.value))
        victim = self._constant(read, modifier, text) if read.kind == "package" else self._variable(read, modifier)
        if victim:
            self._refuse(
                source,
                modifier.value,
                f"{victim} would keep its default instead of {text}: rumoca loses this modifier; modify the component"
                " itself, or use a class of its own that extends the other one with it",
            )

    def replaced(self, source: int, modifier: Modifier) -> None:
        """Refuse it if it still counts for a component that is redeclared: from there its constraint's are in force."""
        for path, node in self._values.variables(modifier.path):
            component = path[: len(path) - len(modifier.path) + 1]
            is_redeclared = any(component[-len(target) :] == target for target in self._redeclared)
            if is_redeclared and lies_in(place(node["binding"]), source, modifier.value):
                self._refuse(
                    source,
                    modifier.value,
                    f"{node['name']} is redeclared, which ends this modifier, and rumoca keeps it: move it into the"
                    " constrainedby clause, or into the redeclaration",
                )

    def names(self, source: int, read: ClassText) -> None:
        """Refuse a type that begins with a dot where rumoca may take a nested class for what is outside all others."""
        names = [other.name for _, other in self._classes.used]
        for root in read.roots:
            if any(name.endswith(f".{root.path[0]}") for name in names):
                self._refuse(
                    source,
                    root.value,
                    f".{root.path[0]} is outside all classes, and rumoca takes the nested class of that name: give"
                    " that one another name",
                )

    def _refuse(self, source: int, value: Span, message: str) -> None:
        raise BuildError(f"{self._sources.place(_span(source, value))}: {message}")

    def _variable(self, read: ClassText, modifier: Modifier) -> str:
        """The variable that the modifier is for and that has its default; "" if there is none."""
        for target in self._classes.targets(read, modifier):
            found = [node for node in self._owned(target, read) if self._is_default(node, "binding")]
            if target[-1] == "start" and len(target) > 2:  # what a type says is never lost
                others = [node for node in self._owned(target[:-1], read) if _starts_by_itself(node)]
                found += [node for node in others if self._is_default(node, "start")]
            found += [node for node in self._values.fields(target) if self._is_declared(node, target[-1])]
            if found:
                return str(found[0]["name"])
        return ""

    def _owned(self, ending: Path, read: ClassText) -> list[Node]:
        """The variables whose paths end so, in components of the class ``read``."""
        found = self._values.variables(ending)
        depth = len(ending) - 1
        return [node for path, node in found if self._classes.is_a(path[: len(path) - depth], read)]

    def _is_default(self, node: Node, key: str) -> bool:
        """Whether an attribute is what the declaration of the variable itself says, or nothing."""
        own = node["component_ref"]["span"]
        statement = (own["start"], self._sources.end_of_statement(own))
        return node[key] is None or lies_in(place(node[key]), own["source"], statement)

    def _is_declared(self, field: Node, record: str) -> bool:
        """Whether a field has its value from the declaration of a record of this name."""
        own = place(field["binding"])
        return any(given.path == (record,) and lies_in(own, source, given.value) for source, given in self._own)

    def _constant(self, read: ClassText, modifier: Modifier, text: str) -> str:
        """The constant of a package that is used, and nowhere has the value that the modifier gives; "" if none is.

        Constants are no variables of the flat model: their values stand in it where their names stand in the text.
        """
        name = modifier.path[-1]
        texts = ((literal, self._sources.text(literal["span"])) for literal in self._values.literals)
        values = [next(iter(literal["value"].values())) for literal, text in texts if text.rpartition(".")[2] == name]
        is_lost = values and NUMBER.fullmatch(text) and float(text) not in values
        return f"{read.name.rpartition('.')[2]}.{'.'.join(modifier.path)}" if is_lost else ""


def _starts_by_itself(node: Node) -> bool:
    """Whether its start value is one: where there is a binding, rumoca repeats that."""
    return node["binding"] is None and "Parameter" not in node["variability"]


def _span(source: int, value: Span) -> dict[str, int]:
    return {"source": source, "start": value[0], "end": value[1]}
