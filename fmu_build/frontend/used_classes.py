"""The classes that a class is made of, found by their names as Modelica looks them up (3.6, section 5.3)."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator, Mapping
from functools import cached_property

from .syntax import CLASSES, ClassText, Modifier, read_classes

DEFINED = re.compile(rf"\b(?:{'|'.join(sorted(CLASSES))})\s+(?:extends\s+)?(\w+|'[^']*')")
Path = tuple[str, ...]  # of a variable, from the class to be built; that begins with ""


class UsedClasses:
    """Those that the class ``root`` mentions, or one that it mentions; ``texts`` by numbers of files.

    ``used`` has each with the number of its file.
    """

    def __init__(self, texts: Mapping[int, str], root: str) -> None:
        self._texts = texts
        self._classes: dict[str, tuple[int, ClassText]] = {}
        self._bases: dict[str, list[str]] = {}
        self._root = root
        self._files: dict[str, set[int]] = {}  # which have a class of a name
        for number, text in texts.items():
            for name in DEFINED.findall(text):
                self._files.setdefault(name, set()).add(number)
        names, new = set[str](), {self._resolve(f".{root}", "")}
        while new:
            names |= new
            found = [(name, self._classes[name][1]) for name in sorted(new)]
            new = {self._resolve(kind, name) for name, read in found for kind in (*read.mentioned, *read.bases)}
            new -= {*names, ""}
        self.used = [self._classes[name] for name in sorted(names)]

    def _resolve(self, name: str, scope: str) -> str:
        """The whole name of the class that ``name`` means in the class ``scope``; "" for one that is built in."""
        first, *others = name.lstrip(".").split(".")
        self._read({first, *others, *scope.split(".")})
        found = self._look_up(first, "" if name.startswith(".") else scope)
        for part in others:
            found = self._member(found, part)
        return found if found in self._classes else ""

    def _look_up(self, name: str, scope: str) -> str:
        while scope:
            if found := self._member(scope, name) or self._imported(scope, name):
                return found
            scope = scope.rpartition(".")[0]
        return name

    def _imported(self, scope: str, name: str) -> str:
        imports = self._classes[scope][1].imports if scope in self._classes else {}
        if name in imports:
            return self._resolve(f".{imports[name]}", "")
        packages = (self._resolve(f".{package}", "") for key, package in imports.items() if key.startswith("*"))
        return next((found for package in packages if (found := self._member(package, name))), "")

    def _member(self, scope: str, name: str) -> str:
        """The class ``name`` inside another one, its own or inherited; "" if there is none."""
        if f"{scope}.{name}" in self._classes:
            return f"{scope}.{name}"
        return next((found for base in self._bases_of(scope) if (found := self._member(base, name))), "")

    def _bases_of(self, name: str) -> list[str]:
        if name not in self._classes:
            return []
        if name not in self._bases:
            self._bases[name] = []  # names of bases are not looked up in these
            read = self._classes[name][1].bases
            self._bases[name] = [base for kind in read if (base := self._resolve(kind, name)) not in {"", name}]
        return self._bases[name]

    def _read(self, names: set[str]) -> None:
        """Read the files that have classes of these names, once."""
        for number in sorted(set[int]().union(*(self._files.get(name, ()) for name in names))):
            for found in read_classes(self._texts[number]):
                self._classes[found.name] = (number, found)
            for others in self._files.values():
                others.discard(number)

    @cached_property
    def _components(self) -> dict[str, set[str]]:
        """The names of the components of each class, or of one derived from it; by the class's whole and last name."""
        found: dict[str, set[str]] = {}
        for _, read in self.used:
            for name, kind in read.components:
                for base in self._with_bases(self._resolve(kind, read.name)):
                    for key in (base, base.rpartition(".")[2]):
                        found.setdefault(key, set()).add(name)
        return found

    def _with_bases(self, name: str) -> set[str]:
        names, found = [name], {name}
        while names:
            new = {*self._bases_of(names.pop())} - found
            found |= new
            names += new
        return found

    def targets(self, read: ClassText, modifier: Modifier) -> Iterator[Path]:
        """How the paths of variables may end that a modifier in the class ``read`` is for."""
        owners = sorted(self._components.get(read.name, ()))
        if read.name in self._with_bases(self._root):
            owners.append("")
        parts = [part.lstrip("=") for part in modifier.path]
        choices = [sorted({part} | self._components.get(part, set())) for part in parts]
        yield from itertools.product(owners, *choices)

    def is_a(self, component: Path, read: ClassText) -> bool:
        """Whether a component is one of the class ``read``, as the declarations on its path tell."""
        kinds = {self._root}
        for name in component[1:]:
            classes = {base for kind in kinds for base in self._with_bases(kind)}
            declared = {kind for base in classes for kind in self._kinds.get(base, {}).get(name, ())}
            kinds = declared | self._replacements.get(name, set())
        return any(read.name in self._with_bases(kind) for kind in kinds)

    @cached_property
    def _kinds(self) -> dict[str, dict[str, set[str]]]:
        """The classes of the components of each class, by their names."""
        found: dict[str, dict[str, set[str]]] = {}
        for _, read in self.used:
            kinds = found.setdefault(read.name, {})
            for name, kind in read.components:
                kinds.setdefault(name, set()).add(self._resolve(kind, read.name))
        return found

    @cached_property
    def _replacements(self) -> dict[str, set[str]]:
        """The classes that components are redeclared with, by the names of these."""
        found: dict[str, set[str]] = {}
        for _, read in self.used:
            for name in {given.path[-1] for given in read.redeclared}:
                found.setdefault(name, set()).update(self._kinds[read.name].get(name, ()))
        return found
