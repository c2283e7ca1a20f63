"""Where rumoca reads: all that is there, or a copy of what a class needs.

rumoca reads whole libraries, and of the Modelica Standard Library's 2557 files a model often needs 30.
"""

from __future__ import annotations

import os
import shutil
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from .needed_files import needed_files, packages


@dataclass(frozen=True)
class SourceTree:
    """The file that reading begins with, the folders of other libraries, and those of MODELICAPATH."""

    entry: Path
    libraries: Sequence[Path]
    modelica_path: Sequence[Path]
    copies: Sequence[tuple[str, str]] = ()  # names of folders in a copy, and what they are copies of
    written: Sequence[Path] = ()  # the files of a copy

    def original(self, text: str) -> str:
        """A text, a name of a file or a message, with the names of the originals in it."""
        for copy, original in self.copies:
            text = text.replace(copy, original)
        return text


def whole_tree(entry: Path, libraries: Sequence[str]) -> SourceTree:
    """All that there is."""
    named = os.environ.get("MODELICAPATH", "").split(os.pathsep)
    return SourceTree(entry, [*map(Path, libraries)], [Path(name) for name in named if name])


def copy_of_needed(tree: SourceTree, class_name: str, folder: Path, beside: bool = False) -> SourceTree:
    """A copy, in ``folder``, of the files that a class needs, from libraries and, if ``beside``, from beside the file.

    Files lie in it as in the originals, so that folders may contain each other.
    """
    own = library_of(tree.entry)
    tops = [own] if own.is_dir() or not beside else sorted(own.parent.glob("*.mo"))
    others = [path for path in (*tree.libraries, *tree.modelica_path) if path.is_dir()]
    tops += [package for other in others for package in packages(other)]
    places = {file: _place(file, folder) for file in {tree.entry, *needed_files(tops, class_name)}}
    for file, place in places.items():
        place.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(file, place)
    copies: dict[str, str] = {}
    for root in (own.parent, *others):
        _place(root, folder).mkdir(parents=True, exist_ok=True)
        copies.setdefault(os.path.join(_place(root, folder), ""), "" if root == Path() else os.path.join(root, ""))
    return SourceTree(
        _place(tree.entry, folder),
        [_place(path, folder) for path in tree.libraries],
        [_place(path, folder) for path in tree.modelica_path if path in others],
        sorted(copies.items(), key=lambda pair: -len(pair[0])),
        list(places.values()),
    )


def library_of(entry: Path) -> Path:
    """The outermost package around a file; a file that is in none, itself."""
    own = entry
    while (own.absolute().parent / "package.mo").is_file():
        own = own.parent if own.name else own.absolute().parent
    return own


def _place(path: Path, folder: Path) -> Path:
    """Where the copy of a file or folder is."""
    whole = Path(os.path.abspath(path))
    return folder / whole.drive.strip(":\\/") / whole.relative_to(whole.anchor)
