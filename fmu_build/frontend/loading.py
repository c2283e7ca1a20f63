"""Modelica files to rumoca's compiled model.

Two of its habits are handled here: many of its errors carry no place, so we look the offending name up in the sources;
and it reads every .mo file beside the one it is given, as Modelica's directory rules allow.
"""

from __future__ import annotations

import difflib
import re
import shutil
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path

import rumoca

from ..errors import BuildError
from .sources import Sources


def load(path: Path, class_name: str) -> tuple[rumoca.Model, Sources]:
    """The class ``class_name`` of a file or a library's folder, compiled, and its Modelica text.

    Raises BuildError, with file and line as far as they are known, where it does not compile.
    """
    entry = path / "package.mo" if path.is_dir() else path
    if not entry.is_file():
        raise BuildError(f"{entry}: no such Modelica file; give a .mo file or a library's folder with its package.mo")
    try:
        if (entry.parent / "package.mo").exists():
            model, files = _compiled(entry, class_name)
        else:
            model, files = _compiled_alone(entry, class_name)
    except rumoca.RumocaError as error:
        raise BuildError(_located_message(str(error), entry, class_name)) from None
    except BaseException as error:  # what rumoca throws when it runs into a mistake of its own is no Exception
        if type(error).__name__ != "PanicException":
            raise
        raise BuildError(f"{entry}: {class_name}: rumoca failed in it: {error}") from None
    return model, Sources({file_id: (name, text) for file_id, name, text in files}, root=entry.parent)


def _compiled(entry: Path, class_name: str) -> tuple[rumoca.Model, list[tuple[int, str, str]]]:
    """The compiled class, and number, name and text of each file that was read."""
    model = rumoca.Session().load(str(entry), model=class_name)
    return model, model.to_dict("dae")["source_map"]["files"]


def _compiled_alone(entry: Path, class_name: str) -> tuple[rumoca.Model, list[tuple[int, str, str]]]:
    """The same of a file by itself, if that will do: among the files beside it, which rumoca reads as well, there may
    be unrelated ones with classes of the same name."""
    with tempfile.TemporaryDirectory(prefix="fmu_build-") as folder:
        copy = Path(folder) / entry.name
        shutil.copyfile(entry, copy)
        try:
            model, files = _compiled(copy, class_name)
            return model, [(number, name.replace(str(copy), str(entry)), text) for number, name, text in files]
        except rumoca.RumocaError as error:
            alone = str(error).replace(str(copy), str(entry))
    try:
        return _compiled(entry, class_name)
    except rumoca.RumocaError as error:
        text = alone if "Duplicate class" in str(error) else str(error)
        raise BuildError(_located_message(text, entry, class_name)) from None


def _located_message(text: str, entry: Path, class_name: str) -> str:
    """One line with file and line for the text of a rumoca error."""
    first_line = text.splitlines()[0]
    message = re.sub(r"^\S+ could not be compiled: |^\w+ failed: \S+ failed in \w+: ", "", first_line)
    if place := re.search(r" \[(\S+:\d+):\d+\]", message):
        return f"{place.group(1)}: {message.replace(place.group(0), '')}"
    files = sorted(entry.parent.rglob("*.mo")) if entry.name == "package.mo" else [entry]
    for file in files:
        for diagnostic in rumoca.validate(str(file)):
            if place := re.search(r"\[(.+?:\d+):\d+\]", diagnostic.message):
                return f"{place.group(1)}: {message}"
    for name in re.findall(r"['`]([^'`]+)['`]|(\w+)\(\.\.\.\)|(\w+) is not a state", message):
        word = re.compile(rf"(?<![\w.]){re.escape(''.join(name))}(?!\w)")
        for file in files:
            for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), start=1):
                if word.search(line.partition("//")[0]):
                    return f"{file}:{number}: {message}"
    if "resolve/parse failed" in message:
        meant = _alike(class_name, files)
        return f"{entry}: no class {class_name} in it{f'; did you mean {meant}?' if meant else ''}"
    return f"{entry}: {class_name}: {message}"


def _alike(class_name: str, files: Sequence[Path]) -> str:
    """The classes of these files that were hardly meant otherwise: called so elsewhere, or almost so."""
    classes = {name.casefold(): name for file in files for name in _classes(file.read_text(encoding="utf-8"))}
    asked = class_name.casefold()
    called_so = [name for name in classes if name.rpartition(".")[2] == asked.rpartition(".")[2]]
    close = called_so or difflib.get_close_matches(asked, classes, n=3, cutoff=0.8)
    return " or ".join(classes[name] for name in close[:3])


def _classes(text: str) -> Iterator[str]:
    """Full names of the class in a file and of those in it, as far as they can be told without a parser."""
    within = re.search(r"^\s*within\s+([\w.]+)\s*;", text, re.MULTILINE)
    declared = r"^\s*(?:partial\s+)?(?:model|block|class|package)\s+(\w+)"
    first, *others = re.findall(declared, text, re.MULTILINE) or [""]
    outer = f"{within[1]}.{first}" if within else first
    yield outer
    yield from (f"{outer}.{other}" for other in others)
