"""Source spans of rumoca's trees to places and texts."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

# XML has no place for these (XML 1.0, section 2.2); Modelica's strings may contain them (\a, \b, \f, \v).
_UNFIT = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")

_SKIPPED = re.compile(r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/', re.DOTALL)  # strings and comments


def readable(text: str | None) -> str:
    """A text for people, with a replacement character for each that no XML file can hold; "" if there is none."""
    return _UNFIT.sub("\ufffd", text or "")


class Sources:
    """The Modelica files behind a flat model: turns rumoca's spans into ``file:line``, relative to the library."""

    def __init__(self, files: Mapping[int, tuple[str, str]], root: Path) -> None:
        self._files = files
        self._root = root

    def texts(self) -> Iterator[str]:
        """The text of every file."""
        return (text for _, text in self._files.values())

    def texts_by_number(self) -> dict[int, str]:
        """The text of every file, by its number in spans."""
        return {number: text for number, (_, text) in self._files.items()}

    def end_of_statement(self, span: Mapping[str, int]) -> int:
        """Where the statement ends that the span begins in."""
        _, text = self._files.get(span["source"], ("", ""))
        return text.encode().find(b";", span["start"])

    def place(self, span: Mapping[str, int]) -> str:
        """``file:line`` of a span."""
        name, text = self._files.get(span["source"], ("", ""))
        line = text.encode()[: span["start"]].count(b"\n") + 1
        return f"{self._relative(name) if name else 'Modelica'}:{line}"

    def _relative(self, name: str) -> str:
        """The path in the library; that of a file of another one begins with the folder of that library."""
        root = self._root.resolve()
        path = Path(name).resolve()
        packages = [folder for folder in path.parents if (folder / "package.mo").is_file()]
        if packages and not path.is_relative_to(root):
            root = packages[-1].parent
        return os.path.relpath(path, root)

    def text(self, span: Mapping[str, int]) -> str:
        """The Modelica text of a span, on one line."""
        _, text = self._files.get(span["source"], ("", ""))
        return " ".join(text.encode()[span["start"] : span["end"]].decode().split())

    def is_in_type(self, span: Mapping[str, int]) -> bool:
        """Whether the span is part of the definition of a type, such as ``type Angle = Real(start=1)``."""
        _, text = self._files.get(span["source"], ("", ""))
        statement = text.encode()[: span["start"]].decode().rpartition(";")[2]
        return re.search(r"\btype\s+\w+\s*=", statement) is not None

    def is_declared(self, prefix: str, span: Mapping[str, int]) -> bool:
        """Whether the declaration around a span has a prefix, such as ``outer``, in front of it."""
        _, text = self._files.get(span["source"], ("", ""))
        before = text.encode()[max(0, span["start"] - 500) : span["start"]].decode(errors="ignore")
        return re.search(rf"\b{prefix}\b", _SKIPPED.sub("", before).rpartition(";")[2]) is not None

    def find_place(self, node: Any) -> str:
        """The place of the outermost span inside ``node``."""
        stack = [node]
        while stack:
            item = stack.pop()
            if isinstance(item, dict):
                if {"source", "start"} <= item.keys() and item["source"] in self._files:
                    return self.place(item)
                stack.extend(reversed(item.values()))
                stack.append(item.get("span"))
            elif isinstance(item, list):
                stack.extend(reversed(item))
        return "Modelica"
