"""The files that a class needs, of libraries that may have thousands of them.

What a class is made of stands by name in its text, or in that of a class that it is made of. So a class is needed if
its name occurs in one that is needed, and the package that it lies in is needed too. Names are not looked up, any one
counts in every package: no scope, import, alias, base class or redeclaration need be understood, and what is found may
be too much, never too little (as long as files are called like their classes; Modelica 3.6, section 13.4).
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from .syntax import CLASSES

_WORD = re.compile(r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/|([A-Za-z_]\w*|\'(?:\\.|[^\'\\])*\'|[=()])', re.DOTALL)
_UNNAMED = {"constructor", "destructor"}  # of external objects; nobody calls them by name


@dataclass
class _Class:
    """A class that has an end, and the words in it, but for those of classes inside."""

    name: str
    is_operator: bool = False  # that is called by a sign, with all that is in it
    words: set[str] = field(default_factory=set)
    inner: list[_Class] = field(default_factory=list)


def needed_files(tops: Iterable[Path], class_name: str) -> set[Path]:
    """The files that the class of this full name needs among ``tops``: files, and folders with a package.mo."""
    search = _Search(class_name)
    for top in tops:
        file = _file(top)
        for found in _read(file).inner:
            search.offer(found.name, top)
    search.run()
    return search.files


def packages(folder: Path) -> Iterator[Path]:
    """The libraries in a folder, or the folder itself if it is one: files, and folders with a package.mo."""
    if _file(folder).is_file():
        yield folder
        return
    for path in sorted(folder.iterdir()):
        is_looked_into = not path.is_symlink() and not path.name.startswith(".")
        if path.is_dir() and (is_looked_into or _file(path).is_file()):
            yield from packages(path)
        elif path.suffix == ".mo" and path.is_file():
            yield path


class _Search:
    def __init__(self, class_name: str) -> None:
        self._names = {*_words(class_name), *_UNNAMED}
        self._waiting: dict[str, list[Path | _Class]] = {}  # what is needed if its name is
        self._todo: list[Path | _Class] = []
        self.files: set[Path] = set()

    def offer(self, name: str, found: Path | _Class) -> None:
        """What lies in a package that is needed."""
        if name in self._names:
            self._todo.append(found)
        else:
            self._waiting.setdefault(name, []).append(found)

    def run(self) -> None:
        """Follow all names, until there are no new ones."""
        while self._todo:
            found = self._todo.pop()
            if isinstance(found, Path):
                self._enter(found)
            else:
                self._take(found)

    def _enter(self, path: Path) -> None:
        if _file(path) in self.files:
            return
        self.files.add(_file(path))
        self._take(_read(_file(path)))
        for other in sorted(path.iterdir()) if path.is_dir() else ():
            if _file(other).is_file() and other.name != "package.mo":
                self.offer(other.stem if other.suffix == ".mo" else other.name, other)

    def _take(self, found: _Class) -> None:
        for name in found.words - self._names:
            self._names.add(name)
            self._todo += self._waiting.pop(name, ())
        for inner in found.inner:
            if inner.is_operator or not found.name:  # the classes of a file, which was asked for by their name
                self._todo.append(inner)
            else:
                self.offer(inner.name, inner)


def _file(path: Path) -> Path:
    """Where the class of a file or folder is written."""
    return path if path.suffix == ".mo" else path / "package.mo"


def _read(file: Path) -> _Class:
    """The words of a file outside of classes, and its classes."""
    words = _words(file.read_text(encoding="utf-8", errors="replace"))
    stack = [_Class("")]
    at = 0
    while at < len(words):
        if words[at] == "end" and words[at + 1 : at + 2] == [stack[-1].name]:
            stack.pop()
            at += 2
        elif words[at] in CLASSES and (new := _begun(words, at)):
            new.is_operator |= stack[-1].is_operator
            stack[-1].inner.append(new)
            stack.append(new)
            at = words.index(new.name, at) + 1
        else:
            stack[-1].words.add(words[at])
            at += 1
    return stack[0]


def _begun(words: list[str], at: int) -> _Class | None:
    """The class that begins with the keyword at ``at``, if it has an end of its own."""
    after = next((i for i in range(at, len(words)) if words[i] not in {*CLASSES, "extends"}), len(words))
    name, following = (*words[after : after + 2], "", "")[:2]
    if not re.match(r"[\w']", name) or following == "=" or (following == "(" and words[after - 1] != "extends"):
        return None
    return _Class(name, is_operator="operator" in words[at:after] and "record" not in words[at:after])


def _words(text: str) -> list[str]:
    return [word for word in _WORD.findall(text) if word]
