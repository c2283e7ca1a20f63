"""Modelica files to rumoca's flat form and to its simulation, by a process of its own.

rumoca is young: some classes make it overflow its stack or run for ever. It can take no more with it than that process,
whose end we tell.
"""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from ..cache import Part, kept, tools
from ..errors import BuildError
from .source_tree import library_of, whole_tree
from .sources import Sources

TIME_LIMIT = 600.0  # s; all of the Modelica Standard Library takes rumoca 25
# `redeclare model extends Inner`, where rumoca overflows its stack.
_CLASS_EXTENDS = re.compile(r"^[^\"/]*\b(?:model|block|class|record|connector|package|function|type)\s+extends\b")


def load(path: Path, class_name: str, libraries: Sequence[Path] = ()) -> tuple[dict[str, Any], Sources]:
    """The flat form of the class ``class_name`` of a file or a library's folder, and the Modelica text behind it.

    Other libraries are looked for in the folders ``libraries``, and in those that MODELICAPATH names.
    Raises BuildError, with file and line as far as they are known, where it does not compile.
    """
    entry = _entry(path)
    answer = _ask(entry, class_name, libraries)
    files = {number: (name, text) for number, name, text in answer["files"]}
    return answer["flat"], Sources(files, root=entry.parent)


def run(
    path: Path, class_name: str, libraries: Sequence[Path], times: Sequence[float], tolerances: Sequence[float]
) -> dict[str, Any]:
    """rumoca's simulation of a class: ``parameters``, numbers by name, and ``runs``, one for each tolerance, with the
    ``times`` of its rows and ``columns`` by name.

    Raises BuildError where it does not compile or does not run.
    """
    return _ask(_entry(path), class_name, libraries, times=list(times), tolerances=list(tolerances))


def _entry(path: Path) -> Path:
    entry = path / "package.mo" if path.is_dir() else path
    if not entry.is_file():
        raise BuildError(f"{entry}: no such Modelica file; give a .mo file or a library's folder with its package.mo")
    return entry


def readable_files(path: Path, libraries: Sequence[Path]) -> Iterator[Part]:
    """All that may be read for a class of a file or a library's folder: with what is beside, and other libraries.

    Raises BuildError as ``load`` where there is no such file or folder.
    """
    tree = whole_tree(_entry(path), [*map(_library, libraries)])
    own, *others = (Path(os.path.abspath(p)) for p in (library_of(tree.entry), *tree.libraries, *tree.modelica_path))
    yield from sorted(file for file in own.parent.glob("*.mo") if file.is_file())
    for place, top in enumerate((own, *others)):
        yield f"{'library' if place <= len(libraries) else 'MODELICAPATH'} {top}"  # also if there is nothing in it
        yield from sorted(file for kind in ("*.mo", "package.order") for file in top.rglob(kind) if file.is_file())


def _ask(entry: Path, class_name: str, libraries: Sequence[Path], **simulation: list[float]) -> dict[str, Any]:
    """What the process answers, or has answered before."""
    request: dict[str, Any] = {"entry": str(entry), "class_name": class_name, "libraries": [*map(_library, libraries)]}
    request |= {"times": [], "tolerances": []} | simulation

    def parts() -> Iterator[Part]:
        yield from (json.dumps(request), *tools())
        yield from sorted(Path(__file__).parent.rglob("*.py"))
        yield from readable_files(entry, libraries)

    answer: dict[str, Any] = json.loads(kept(parts, lambda: _answer(request, entry, class_name)))
    return answer


def _answer(request: Mapping[str, Any], entry: Path, class_name: str) -> bytes:
    """JSON. BuildError for an error."""
    with tempfile.TemporaryDirectory(prefix="fmu_build-") as folder:
        answer = Path(folder) / "answer.json"
        answer.with_name("request.json").write_text(json.dumps(request), encoding="utf-8")
        command = [sys.executable, "-m", f"{__package__}.rumoca_process", folder]
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
        try:
            ended = subprocess.run(
                command, env=environment, capture_output=True, text=True, check=False, timeout=TIME_LIMIT
            )
        except subprocess.TimeoutExpired:
            raise BuildError(f"{entry}: {class_name}: rumoca does not come to an end within {TIME_LIMIT:g} s") from None
        if ended.returncode != 0:
            raise BuildError(_death(ended, entry, class_name))
        content = answer.read_bytes()
    if content.startswith(b'{"error": '):
        raise BuildError(json.loads(content)["error"])
    return content


def _library(folder: Path) -> str:
    if not folder.is_dir():
        raise BuildError(
            f"{folder}: no such folder; --library names the folder of a library or one that libraries are in"
        )
    return str(folder)


def _death(ended: subprocess.CompletedProcess[str], entry: Path, class_name: str) -> str:
    """How the process ended, and the place that may be why."""
    if ended.returncode < 0:
        how = f"was ended by signal {-ended.returncode} ({signal.Signals(-ended.returncode).name})"
    else:
        last = ended.stderr.strip().splitlines()[-1:]
        how = f"failed ({''.join(last) or f'status {ended.returncode}'})"
    files = sorted(entry.parent.rglob("*.mo")) if entry.name == "package.mo" else [entry]
    for file in files:
        for number, line in enumerate(file.read_text(encoding="utf-8", errors="replace").splitlines(), start=1):
            if _CLASS_EXTENDS.search(line):
                return (
                    f"{file}:{number}: rumoca {how} on {class_name}: it does not survive `class extends`; write a class"
                    " that extends the old one under a name of its own, and redeclare to it"
                )
    return f"{entry}: {class_name}: rumoca {how} on it"
