"""What the documentation shows is run: examples in Python, commands with what they print. The site of `make docs`."""

from __future__ import annotations

import doctest
import importlib.util
import json
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import overrun_hitch as hitch
from docs.hooks import FROM_ELSEWHERE, LINK, run_examples
from overrun_hitch.parameters import Parameters
from tests.conftest import ROOT
from tests.sampling import sampled

PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
IN_BRIEF = [ROOT / "docs" / "model.md", ROOT / "docs" / "sweep.md", ROOT / "README.md"]  # the others are `full`
COMMANDS = {"hitch": ["-m", "overrun_hitch"], "make": ["-m", "overrun_hitch"], "python": []}  # make run: hitch run
NOTEBOOKS = sorted((ROOT / "docs").glob("*.ipynb"))
PICTURES = ("first-run.svg", "four-dampers.svg")
MADE = ("commands.md", "live/index.html", *PICTURES, *(f"{path.stem}.md" for path in NOTEBOOKS))  # with the site
CONSOLE = re.compile(r"^```console\n(.*?)^```$", re.MULTILINE | re.DOTALL)
TOML = re.compile(r"^```toml\n# (\S+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def having(mark: str) -> list[Path]:
    return [page for page in PAGES if mark in page.read_text(encoding="utf-8")]


def named(page: Path) -> str:
    return page.name


@pytest.mark.parametrize("page", sampled(having(">>> import overrun_hitch"), IN_BRIEF), ids=named)
def test_examples(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert run_examples(page) > 1


def test_an_example_that_prints_something_else_is_told(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text("```python\n>>> 1 + 1\n3\n```\n", encoding="utf-8")
    with pytest.raises(ValueError, match=r"Expected:\s+3\s+Got:\s+2"):
        run_examples(page)


def sessions(page: Path) -> list[tuple[str, str]]:
    """The commands of a page with what each prints."""
    blocks = "".join(CONSOLE.findall(page.read_text(encoding="utf-8")))
    return [(command, output) for command, output in re.findall(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", blocks, re.MULTILINE)]


@pytest.mark.parametrize("page", sampled(having("```console"), IN_BRIEF), ids=named)
def test_commands(page: Path, tmp_path: Path) -> None:
    for name, text in TOML.findall(page.read_text(encoding="utf-8")):
        (tmp_path / name).write_text(text, encoding="utf-8")
    for name in ("CarTrailer.fmu", "theirs.fmu"):
        shutil.copy(hitch.fmu_path(), tmp_path / name)
    for command, expected in sessions(page):
        program, *arguments = shlex.split(command)
        call = [sys.executable, *COMMANDS[program], *arguments]
        done = subprocess.run(call, cwd=tmp_path, capture_output=True, text=True, check=False, timeout=120)
        told = done.stdout + done.stderr
        is_shown = doctest.OutputChecker().check_output(expected, told, doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)
        assert is_shown, f"$ {command}\n{told}"


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=named)
def test_notebooks_are_kept_without_results(notebook: Path) -> None:
    cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
    code = [cell for cell in cells if cell["cell_type"] == "code"]
    assert len(code) > 3 and not [cell for cell in code if cell["outputs"] or cell["execution_count"]]


@pytest.mark.full
@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=named)
def test_notebooks_run(notebook: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "agg")
    known: dict[str, object] = {}
    for cell in json.loads(notebook.read_text(encoding="utf-8"))["cells"]:
        if cell["cell_type"] == "code":
            exec("".join(cell["source"]), known)
    assert "hitch" in known


@pytest.mark.parametrize("page", [*PAGES, *(ROOT / name for name in FROM_ELSEWHERE)], ids=named)
def test_links_lead_somewhere(page: Path) -> None:
    links = LINK.findall(page.read_text(encoding="utf-8"))
    assert [link for link in links if not (page.parent / link).exists() and link not in MADE] == []


def test_every_parameter_with_its_unit_and_default() -> None:
    text = (ROOT / "docs" / "model.md").read_text(encoding="utf-8").partition("## Every parameter")[2]
    rows = re.findall(r"^\| `(\w+)` \| (\S+) \| (\S+) \| (.*) \|$", text, re.MULTILINE)
    figure_8 = hitch.FIGURES["8"].parameters
    expected = [(name, Parameters.unit(name), getattr(figure_8, name)) for name in Parameters.model_fields]
    assert [(name, unit, float(default)) for name, unit, default, _ in rows] == expected
    assert [meaning for *_, meaning in rows] == [Parameters.description(name) for name in Parameters.model_fields]


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    if importlib.util.find_spec("material") is None:
        pytest.skip("mkdocs-material is not installed (make docs installs it)")
    folder = tmp_path_factory.mktemp("site")
    build = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "--site-dir", str(folder)]
    done = subprocess.run(build, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


@pytest.mark.full
@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=named)
def test_a_notebook_is_a_page_with_pictures_and_can_be_had(site: Path, notebook: Path) -> None:
    page = (site / notebook.with_suffix(".html").name).read_text(encoding="utf-8")
    pictures = re.findall(rf'src="({notebook.stem}_files/[^"]+\.svg)"', page)
    assert len(pictures) >= 3 and all((site / picture).read_bytes().startswith(b"<?xml") for picture in pictures)
    assert (
        f'href="{notebook.name}"' in page and "<table" in page and "<script type=" not in page.partition("<article")[2]
    )
    offered = json.loads((site / notebook.name).read_text(encoding="utf-8"))
    assert [cell for cell in offered["cells"] if cell.get("outputs")]


LOADED = re.compile(
    r"""<(?:script|img|iframe|source)[^>]*\ssrc=["']?(?:https?:)?//|<link[^>]*rel=["']?(?:stylesheet|preload|preconnect|icon)"""
    r"""[^>]*href=["']?(?:https?:)?//|url\(["']?(?:https?:)?//|@import\s*["'](?:https?:)?//"""
)


@pytest.mark.full
def test_a_page_loads_nothing_from_outside(site: Path) -> None:
    pages = [path for kind in ("html", "css", "svg") for path in site.rglob(f"*.{kind}")]
    assert len(pages) > 20
    assert [path.name for path in pages if LOADED.search(path.read_text(encoding="utf-8"))] == []
    assert LOADED.search('<script async src="https://example.org/a.js">')
    assert LOADED.search("background: url(//example.org/a.png)")


@pytest.mark.full
@pytest.mark.parametrize("word", ["backlash", "C_crit", "750 kg", "torque history", "run_many"])
def test_search_finds(site: Path, word: str) -> None:
    index = json.loads((site / "search" / "search_index.json").read_text(encoding="utf-8"))
    assert [entry["location"] for entry in index["docs"] if word in entry["title"] + entry["text"]]


def opened(address: str, folder: Path) -> tuple[str, list[str]]:
    """What a browser makes of a page, and what the page has it ask of others."""
    folder.mkdir()
    browser = shutil.which("chromium") or shutil.which("google-chrome")
    if browser is None:
        pytest.skip("no Chromium here")
    log = folder / "requests.json"
    options = ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-sync",
               "--disable-background-networking", f"--user-data-dir={folder}", f"--log-net-log={log}",
               "--virtual-time-budget=20000", "--dump-dom"]  # fmt: skip
    done = subprocess.run([browser, *options, address], capture_output=True, text=True, check=True, timeout=120)
    told = [event.get("params", {}) for event in json.loads(log.read_text(encoding="utf-8"))["events"]]
    by_the_page = [one for one in told if one.get("initiator", "not an origin") != "not an origin"]
    return done.stdout, [one["url"] for one in by_the_page if one["url"].startswith("http")]


@pytest.mark.full
def test_the_search_works_from_the_disk(site: Path, tmp_path: Path) -> None:
    page, asked = opened(f"{(site / 'index.html').as_uri()}?q=backlash", tmp_path / "site")
    assert re.search(r"[1-9]\d* matching documents", page)
    assert asked == []


@pytest.mark.full
def test_a_request_of_a_page_is_seen(tmp_path: Path) -> None:
    (tmp_path / "page.html").write_text('<script src="https://example.invalid/a.js"></script>', encoding="utf-8")
    assert "https://example.invalid/a.js" in opened((tmp_path / "page.html").as_uri(), tmp_path / "control")[1]
