"""The walls of the house, beside those that `lint-imports` holds: doors, no circles in Python or C, sizes."""

from __future__ import annotations

import ast
import importlib
import re
from collections.abc import Iterable, Iterator
from pathlib import Path

import grimp
import networkx as nx
import pytest

import overrun_hitch

ROOT = Path(__file__).parents[1]
RUNTIME = ROOT / "fmu_build" / "runtime"
FLOORS = ("", "numerics", "instance", "fmi2", "fmi3")  # each sees those before it; the facades don't see each other
PACKAGES = ("fmu_build", "overrun_hitch")
SOURCES = ("fmu_build", "python", "tests", "web/src", "web/test")
LONGEST_FILE, LONGEST_FUNCTION = 400, 40  # lines


def python_graph(package: str) -> nx.DiGraph:
    """Who imports whom, module by module; imports for type checkers count."""
    graph = grimp.build_graph(package, cache_dir=None)
    edges = [(module, other) for module in graph.modules for other in graph.find_modules_directly_imported_by(module)]
    return nx.DiGraph(edges)


def include_graph(runtime: Path = RUNTIME) -> nx.DiGraph:
    """Which file of the runtime includes which, by their paths in it."""
    places = {path.name: path.relative_to(runtime).as_posix() for path in runtime.rglob("*.[ch]")}
    return nx.DiGraph(
        (places[path.name], places[name])
        for path in runtime.rglob("*.[ch]")
        for name in re.findall(r'^#include "(.*)"', path.read_text(encoding="utf-8"), re.MULTILINE)
        if name in places
    )


def circles(graph: nx.DiGraph) -> list[list[str]]:
    return [sorted(part) for part in nx.strongly_connected_components(graph) if len(part) > 1]


@pytest.mark.parametrize("package", PACKAGES)
def test_no_circle_of_imports(package: str) -> None:
    graph = python_graph(package)
    assert circles(graph) == []
    one, other = next(iter(graph.edges))
    graph.add_edge(other, one)
    assert circles(graph) != []


def test_no_circle_of_includes() -> None:
    graph = include_graph()
    assert circles(graph) == []
    one, other = next(iter(graph.edges))
    graph.add_edge(other, one)
    assert circles(graph) != []


def test_includes_go_down() -> None:
    upward = [
        (one, other)
        for one, other in include_graph().edges
        for here, there in [(str(Path(one).parent), str(Path(other).parent))]
        if here != there
        and (FLOORS.index(there.strip(".")) >= FLOORS.index(here.strip(".")) or here == "fmi3" == there)
    ]
    assert upward == []
    assert not any({"fmi2", "fmi3"} == {Path(part).parts[0] for part in edge} for edge in include_graph().edges)


def test_c_files_lie_side_by_side_in_an_fmu() -> None:
    names = [path.name for path in RUNTIME.rglob("*.[ch]")]
    assert len(names) == len(set(names))


def test_the_page_imports_downwards() -> None:
    """Along the staircase in CONTRIBUTING.md, which names every module of web/src."""
    staircase = re.search(r"web/src/ +(.*?)\(", (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8"), re.DOTALL)
    assert staircase
    floors = [re.findall(r"\w+", floor) for floor in reversed(staircase[1].split(">"))]
    height = {module: n for n, floor in enumerate(floors) for module in floor}
    files = [file for file in (ROOT / "web" / "src").glob("*.ts") if file.name != "files.d.ts"]
    imports = [
        (file.stem, other)
        for file in files
        for other in re.findall(r'from "\./(\w+)\.js"', file.read_text(encoding="utf-8"))
    ]
    assert {file.stem for file in files} == height.keys() and len(imports) > 20
    assert [(one, other) for one, other in imports if height[other] >= height[one]] == []


def folders(package: str) -> list[str]:
    graph = grimp.build_graph(package, cache_dir=None)
    return sorted(module for module in graph.modules if graph.find_children(module) and module != package)


@pytest.mark.parametrize("package", PACKAGES)
def test_a_folder_is_entered_by_its_door(package: str) -> None:
    """From outside only the modules are imported that its __init__ names, and every one of those is."""
    graph = grimp.build_graph(package, cache_dir=None)
    for folder in folders(package):
        door = importlib.import_module(folder)
        assert door.__doc__ is not None and "\n" not in door.__doc__.strip(), folder
        entered = {
            module.removeprefix(f"{folder}.").partition(".")[0]
            for module in graph.find_descendants(folder)
            for user in graph.find_modules_that_directly_import(module)
            if not f"{user}.".startswith(f"{folder}.")
        }
        assert entered == set(door.__all__), folder


def test_no_folder_hides_what_the_package_offers() -> None:
    """`overrun_hitch.sweep` is a function; a folder of that name would take its place once it is imported."""
    package = ROOT / "python" / "overrun_hitch"
    assert not {name for name in overrun_hitch.__all__ if (package / name).exists()}


def test_no_file_is_too_long() -> None:
    files = [file for folder in SOURCES for file in (ROOT / folder).rglob("*.*")]
    ours = [file for file in files if ROOT / "fmu_build" / "headers" not in file.parents]  # the rest is the standard's
    sources = [file for file in ours if file.suffix in {".py", ".c", ".h", ".ts", ".mjs"}]
    lengths = {str(file.relative_to(ROOT)): file.read_text(encoding="utf-8").count("\n") for file in sources}
    assert len(lengths) > 200 and {name: n for name, n in lengths.items() if n > LONGEST_FILE} == {}


def long_functions(files: Iterable[Path]) -> Iterator[str]:
    """Functions by the lines of their bodies, docstring included: a signature is a table of what goes in."""
    for file in files:
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                length = (node.end_lineno or 0) - node.body[0].lineno + 1
                if length > LONGEST_FUNCTION:
                    yield f"{file.name}: {node.name}: {length} lines"


def test_no_function_is_too_long(tmp_path: Path) -> None:
    packages = [file for folder in ("fmu_build", "python") for file in (ROOT / folder).rglob("*.py")]
    assert list(long_functions(packages)) == []
    long = tmp_path / "long.py"
    long.write_text("def f() -> None:\n" + "    pass\n" * (LONGEST_FUNCTION + 1), encoding="utf-8")
    assert len(list(long_functions([long]))) == 1


def test_no_function_in_c_is_too_long() -> None:
    """By clang-format's habit a function begins and ends with a brace at the start of a line."""
    lengths = {}
    for file in RUNTIME.rglob("*.c"):
        lines = file.read_text(encoding="utf-8").splitlines()
        begins = [number for number, line in enumerate(lines) if line == "{"]
        for begin in begins:
            lengths[file.name, begin + 1] = lines[begin:].index("}") - 1
    assert len(lengths) > 200 and {place: n for place, n in lengths.items() if n > LONGEST_FUNCTION} == {}
