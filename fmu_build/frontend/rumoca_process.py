"""rumoca in a process of its own: ``python -m fmu_build.frontend.rumoca_process FOLDER``. It alone imports rumoca.

Reads request.json in the folder, writes answer.json: what rumoca makes of a class, or why it makes nothing of it. Two
of its habits are handled here: many of its errors carry no place, so we look the offending name up in the sources; and
it reads every .mo file beside the one it is given, as Modelica's directory rules allow.
"""

from __future__ import annotations

import difflib
import json
import re
import shutil
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import rumoca

from .rewriting.restated import algorithm_left, restated

Request = Mapping[str, Any]

ALGORITHM = "unsupported model algorithm"
ALGORITHM_REMEDY = "give each variable a value in every branch, and loops numbers as bounds; or write a function"
# What rumoca says, what shows the place in the source, and what to do.
REMEDIES = (
    (
        "duplicate reinitialization owner",
        r"\breinit\s*\(\s*([\w.]+)(?=.*?\breinit\s*\(\s*\1\s*,)",
        "two when-clauses reinit {0}, and which counts if both become true? Make them branches of one, by elsewhen",
    ),
    (
        "runtime operator `Clock`: requires parameter-evaluable Integer conversion arguments",
        r"\bClock\s*\([^;]*\bsolverMethod\b",
        "a clock takes no solverMethod: write the method out, x = previous(x) + interval(x)*previous(der_x)",
    ),
    (
        "unbalanced model",
        r"\bouter\s+(?:input\s+|output\s+)?(?:Real|Integer|Boolean)\s+(\w+)",
        "rumoca supports `outer {0}` for parameters and discrete variables alone, which may be why; declare a component"
        " that has it, `inner Surroundings s` and `outer Surroundings s`, or hand it down through a connector",
    ),
)


def main(folder: Path) -> None:
    """Answer the request."""
    request = json.loads((folder / "request.json").read_text(encoding="utf-8"))
    (folder / "answer.json").write_text(_answer(request, folder), encoding="utf-8")


def _answer(request: Request, folder: Path) -> str:
    entry, class_name = Path(request["entry"]), request["class_name"]
    try:
        try:
            if (entry.parent / "package.mo").exists():
                model, files = _compiled(entry, request)
            else:
                model, files = _compiled_alone(entry, request, folder)
        except rumoca.RumocaError as error:
            model, files = _restated(entry, request, folder, error)
        if request["times"]:
            return json.dumps(_simulated(model, request))
        return f'{{"files": {json.dumps(files)}, "flat": {model.to_json("flat")}}}'
    except rumoca.SimulationError as error:
        return json.dumps({"error": f"{class_name}: its simulation failed: {str(error).splitlines()[0]}"})
    except rumoca.RumocaError as error:
        return json.dumps({"error": _located_message(str(error), entry, class_name)})
    except BaseException as error:  # what rumoca throws when it runs into a mistake of its own is no Exception
        if type(error).__name__ != "PanicException":
            raise
        return json.dumps({"error": f"{entry}: {class_name}: rumoca failed in it: {error}"})


def _compiled(entry: Path, request: Request) -> tuple[rumoca.Model, list[tuple[int, str, str]]]:
    """The compiled class, and number, name and text of each file that was read."""
    model = rumoca.Session(roots=request["libraries"]).load(str(entry), model=request["class_name"])
    return model, model.to_dict("dae")["source_map"]["files"]


def _restated(
    entry: Path, request: Request, folder: Path, error: rumoca.RumocaError
) -> tuple[rumoca.Model, list[tuple[int, str, str]]]:
    """The same of what rumoca refuses, said in other words, if there are some."""
    original = entry.parent if (entry.parent / "package.mo").exists() else entry
    copy = folder / "restated" / original.name
    copy.parent.mkdir()
    (shutil.copytree if original.is_dir() else shutil.copyfile)(original, copy)
    changed = False
    for file in copy.rglob("*.mo") if copy.is_dir() else [copy]:
        text = file.read_text(encoding="utf-8")
        file.write_text(restated(text), encoding="utf-8")
        changed |= file.read_text(encoding="utf-8") != text
    if not changed:
        raise error
    try:
        model, files = _compiled(copy / entry.name if copy.is_dir() else copy, request)
    except rumoca.RumocaError as second:
        raise type(second)(str(second).replace(str(copy), str(original))) from None
    return model, [(number, name.replace(str(copy), str(original)), text) for number, name, text in files]


def _compiled_alone(entry: Path, request: Request, folder: Path) -> tuple[rumoca.Model, list[tuple[int, str, str]]]:
    """The same of a file by itself, if that will do: among the files beside it, which rumoca reads as well, there may
    be unrelated ones with classes of the same name."""
    copy = folder / "alone" / entry.name
    copy.parent.mkdir()
    shutil.copyfile(entry, copy)
    try:
        model, files = _compiled(copy, request)
        return model, [(number, name.replace(str(copy), str(entry)), text) for number, name, text in files]
    except rumoca.RumocaError as error:
        alone = str(error).replace(str(copy), str(entry))
    try:
        return _compiled(entry, request)
    except rumoca.RumocaError as error:
        raise type(error)(alone if "Duplicate class" in str(error) else str(error)) from None


def _simulated(model: rumoca.Model, request: Request) -> dict[str, Any]:
    """Every variable at the times, for each tolerance, and the parameters."""
    times = request["times"]
    answer: dict[str, Any] = {"parameters": {p.name: p.value for p in model.parameters if p.value is not None}}
    answer["runs"] = []
    for tolerance in request["tolerances"]:
        config = rumoca.SimConfig(solver="rk-like", rtol=tolerance, atol=tolerance, max_wall_seconds=60)
        result = model.simulate(t=(times[0], times[-1]), dt=times[1] - times[0], config=config)
        columns = {name: list(result[name]) for name in result.names}
        answer["runs"].append({"times": list(result.time), "columns": columns})
    return answer


def _located_message(text: str, entry: Path, class_name: str) -> str:
    """One line with file and line for the text of a rumoca error."""
    first_line = text.splitlines()[0]
    message = re.sub(r"^\S+ could not be compiled: |^\w+ failed: \S+ failed in \w+: ", "", first_line)
    if place := re.search(r" \[(\S+:\d+):\d+\]", message):
        return f"{place.group(1)}: {message.replace(place.group(0), '')}"
    files = _files(entry, class_name)
    for file in files if ALGORITHM in message else ():
        text = file.read_text(encoding="utf-8")
        if (start := algorithm_left(text)) is not None:
            return f"{file}:{_line(text, start)}: {message}: {ALGORITHM_REMEDY}"
    for said, shown, remedy in REMEDIES:
        for file in files if said in message else ():
            if found := re.search(shown, text := file.read_text(encoding="utf-8"), re.DOTALL):
                return f"{file}:{_line(text, found.start())}: {message}: {remedy.format(*found.groups())}"
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


def _line(text: str, start: int) -> int:
    return text.count("\n", 0, start) + 1


def _files(entry: Path, class_name: str) -> list[Path]:
    """The files of the library, that of the class itself first."""
    if entry.name != "package.mo":
        return [entry]
    own = class_name.split(".")
    return sorted(entry.parent.rglob("*.mo"), key=lambda file: (file.stem not in own, file.stem != own[-1], file))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
