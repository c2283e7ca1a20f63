"""rumoca in a process of its own: ``python -m fmu_build.frontend.rumoca_process FOLDER``. It alone imports rumoca.

Reads request.json in the folder, writes answer.json: what rumoca makes of a class, or why it makes nothing of it. Two
of its habits are handled here: many of its errors carry no place, so we look the offending name up in the sources; and
it reads all that it could need, beside the file that it is given and in libraries, so we show it what the class needs.
"""

from __future__ import annotations

import difflib
import json
import os
import re
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import rumoca

from .needed_files import needed_files
from .receivers import with_all_receivers
from .source_tree import SourceTree, copy_of_needed, library_of, whole_tree
from .table_calls import with_calls_in_sums

Request = Mapping[str, Any]
Files = list[tuple[int, str, str]]  # number, name and text of each

MISSING = re.compile("unresolved|not found|does not exist|resolve/parse failed")
ALGORITHM = "unsupported model algorithm"
MOST_FUNCTIONS = 8  # whose outputs a model does not all receive: rumoca names one at a time
ALGORITHM_REMEDY = "give each variable a value in every branch, and loops numbers as bounds; or write a function"
Rewrite = Callable[[str, str], str]  # of a text, and what rumoca says


def _restated(text: str, _: str) -> str:
    # Imported only here, because its graphs take 0.2 s, and few models need it.
    from .rewriting.restated import restated

    return restated(text)


def _with_undefined_outputs(text: str, _: str) -> str:
    from .rewriting.function_words import with_undefined_outputs

    return with_undefined_outputs(text)


# What rumoca says, and what says the same in a way that it takes; the last, whatever it says.
REWRITES: Sequence[tuple[str, Rewrite]] = (
    ("unbalanced model", lambda text, _: with_calls_in_sums(text)),
    *[("the receiving tuple has", with_all_receivers)] * MOST_FUNCTIONS,
    ("without a definition on some branch", _with_undefined_outputs),
    ("", _restated),
)
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
    (
        "finite arithmetic-series form",
        r"\bbreak\s*;",
        "write the loop without break: `if` around what is passed over",
    ),
    (
        "statement without a checked DAE owner",
        r"\bwhile\b",
        "write a for with numbers or sizes as bounds in place of the while",
    ),
    ("reference `spatialDistribution`", r"\bspatialDistribution\b", "write the pipe as a row of cells, each a state"),
)


def main(folder: Path) -> None:
    """Answer the request."""
    request = json.loads((folder / "request.json").read_text(encoding="utf-8"))
    (folder / "answer.json").write_text(_answer(request, folder), encoding="utf-8")


def _answer(request: Request, folder: Path) -> str:
    entry, class_name = Path(request["entry"]), request["class_name"]
    try:
        model, files = _loaded(entry, request, folder)
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


def _loaded(entry: Path, request: Request, folder: Path) -> tuple[rumoca.Model, Files]:
    """The compiled class, and the files that were read: those that it needs; all, if that does not do."""
    messages: list[str] = []
    for tree in _trees(entry, request, folder):
        try:
            return _compiled(tree, request["class_name"])
        except rumoca.RumocaError as error:
            messages.append(tree.original(str(error)))
            kind = type(error)
            if not MISSING.search(messages[-1]):
                break
    raise kind(messages[0] if "Duplicate class" in messages[-1] else messages[-1])


def _trees(entry: Path, request: Request, folder: Path) -> Iterator[SourceTree]:
    """Where to look, one after another. A file is tried by itself first: among those beside it, which rumoca reads as
    well, there may be unrelated ones with classes of the same name."""
    whole, surroundings = whole_tree(entry, request["libraries"]), dict(os.environ)
    os.environ["XDG_CACHE_HOME"] = str(folder / "cache")  # where rumoca keeps what it has parsed, by names of files
    yield copy_of_needed(whole, request["class_name"], folder / "needed")
    if not (entry.parent / "package.mo").exists():
        yield copy_of_needed(whole, request["class_name"], folder / "beside", beside=True)
    os.environ.pop("XDG_CACHE_HOME")
    os.environ.update(surroundings)
    yield whole


def _compiled(tree: SourceTree, class_name: str) -> tuple[rumoca.Model, Files]:
    """The same, of one tree; where rumoca refuses what can be said otherwise, the texts of a copy are rewritten."""
    os.environ["MODELICAPATH"] = os.pathsep.join(map(str, tree.modelica_path))
    model = _model(tree, class_name, REWRITES if tree.written else ())
    return model, [
        (number, tree.original(name), text) for number, name, text in model.to_dict("dae")["source_map"]["files"]
    ]


def _model(tree: SourceTree, class_name: str, rewrites: Sequence[tuple[str, Rewrite]]) -> rumoca.Model:
    try:
        return rumoca.Session(roots=[*map(str, tree.libraries)]).load(str(tree.entry), model=class_name)
    except rumoca.RumocaError as error:
        for place, (said, rewrite) in enumerate(rewrites):
            if said in str(error) and _changed(tree, rewrite, str(error)):
                return _model(tree, class_name, [*rewrites[:place], *rewrites[place + 1 :]])
        raise


def _changed(tree: SourceTree, rewrite: Rewrite, said: str) -> bool:
    """Whether there was something to rewrite in the files of a copy."""
    texts = {file: file.read_text(encoding="utf-8") for file in tree.written}
    rewritten = {file: rewrite(text, said) for file, text in texts.items()}
    for file, text in rewritten.items():
        file.write_text(text, encoding="utf-8")
    return rewritten != texts


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
    from .rewriting.restated import algorithm_left

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
        meant = _alike(class_name, [entry] if entry.name != "package.mo" else sorted(entry.parent.rglob("*.mo")))
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
    """The files of the library that the class needs, its own first: in another one the fault can't be."""
    if entry.name != "package.mo":
        return [entry]
    own = class_name.split(".")
    needed = needed_files([library_of(entry)], class_name)
    return sorted(needed, key=lambda file: (file.stem not in own, file.stem != own[-1], file))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
