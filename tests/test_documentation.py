"""What the documentation shows is run: examples in Python, commands with what they print. The site of `make docs`."""

from __future__ import annotations

import doctest
import importlib.util
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path
from subprocess import PIPE, STDOUT
from typing import NamedTuple

import pytest

import overrun_hitch as hitch
from docs.hooks import FROM_ELSEWHERE, LINK, run_examples
from overrun_hitch.parameters import Parameters
from tests.conftest import ROOT
from tests.sampling import sampled

PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
IN_BRIEF = [ROOT / "README.md"]  # the others are `full`
COMMANDS = {"hitch": ["-m", "overrun_hitch"], "make": ["-m", "overrun_hitch"], "python": []}  # make run: hitch run
NOTEBOOKS = sorted((ROOT / "docs").glob("*.ipynb"))
PICTURES = ("first-run.svg", "four-dampers.svg")
MADE = ("commands.md", "live/index.html", *PICTURES, *(f"{path.stem}.md" for path in NOTEBOOKS))  # with the site
BLOCK = re.compile(r"(?:<!-- ([^\n]*) -->\n)?^( *)```(\w*)\n(.*?)^ *```$", re.MULTILINE | re.DOTALL)
INDENTED = re.compile(r"^\n {4,}\S.*$", re.MULTILINE)  # code without a fence says no language
NOT_RUN, FILE, EXCERPT = "not run: ", "file: ", "from "  # what a comment before a block may say
SECONDS = re.compile(r"^(fmu_build: .*) \d+\.\d\d s$", re.MULTILINE)
THEIRS = ("CarTrailer.fmu", "theirs.fmu")  # files of the reader's, with theirs.csv


def named(page: Path) -> str:
    return page.name


class Block(NamedTuple):
    """A block of code in a page."""

    remark: str  # in the comment before it
    language: str
    text: str

    @property
    def is_run(self) -> bool:
        """By the tests below."""
        if self.remark.startswith(NOT_RUN):
            return False
        is_written = self.language == "toml" and self.text.startswith("# ")
        return is_written or self.language == "console" or (self.language == "python" and ">>> " in self.text)


def blocks(page: Path) -> list[Block]:
    found = BLOCK.findall(page.read_text(encoding="utf-8"))
    return [Block(remark, language, textwrap.dedent(text)) for remark, _, language, text in found]


@pytest.mark.parametrize("page", PAGES, ids=named)
def test_every_block_is_run_or_says_why_not(page: Path) -> None:
    """Formulas, trees and messages are `text`; files and excerpts are compared with what they name."""
    for block in blocks(page):
        if block.remark.startswith(EXCERPT):
            source = (ROOT / block.remark.removeprefix(EXCERPT)).read_text(encoding="utf-8")
            lines, wanted = ([line.strip() for line in text.splitlines()] for text in (source, block.text))
            assert wanted in [lines[place : place + len(wanted)] for place in range(len(lines))], block.text
        elif not block.remark.startswith((NOT_RUN, FILE)):
            assert block.language == "text" or block.is_run, block.text
    assert INDENTED.findall(BLOCK.sub("", page.read_text(encoding="utf-8"))) == []


def test_a_block_that_nobody_runs_is_found(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    for text in ("```sh\nhitch run\n```\n", "Do\n\n    hitch run\n", "```python\nhitch.run()\n```\n", "```\nx\n```\n"):
        page.write_text(text, encoding="utf-8")
        with pytest.raises(AssertionError):
            test_every_block_is_run_or_says_why_not(page)


def test_an_example_that_prints_something_else_is_told(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text("```python\n>>> 1 + 1\n3\n```\n", encoding="utf-8")
    with pytest.raises(ValueError, match=r"Expected:\s+3\s+Got:\s+2"):
        run_examples(page)


def sessions(page: Path) -> list[tuple[str, str]]:
    """The commands of a page with what each prints."""
    shown = "".join(block.text for block in blocks(page) if block.language == "console" and block.is_run)
    return [(command, output) for command, output in re.findall(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", shown, re.MULTILINE)]


def furnished(page: Path, folder: Path) -> None:
    """Put into a folder what a page's commands find there."""
    for block in blocks(page):
        if block.remark.startswith(FILE):
            (folder / block.remark.removeprefix(FILE)).write_text(block.text, encoding="utf-8")
        elif block.language == "toml" and block.is_run:
            head, _, rest = block.text.partition("\n")
            (folder / head.removeprefix("# ")).write_text(rest, encoding="utf-8")
    for name in ("modelica", "examples"):
        (folder / name).symlink_to(ROOT / name)
    for name in THEIRS:
        shutil.copy(hitch.fmu_path(), folder / name)
    hitch.run("8").to_dataframe().to_csv(folder / "theirs.csv")


@pytest.mark.parametrize(
    "page", sampled([page for page in PAGES if any(b.is_run for b in blocks(page))], IN_BRIEF), ids=named
)
def test_what_a_page_shows(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its commands, then its examples, which may use what those have made."""
    furnished(page, tmp_path)
    new = {**os.environ, "FMU_BUILD_CACHE": str(tmp_path / "kept")}  # as for who builds for the first time
    for command, expected in sessions(page):
        program, *arguments = shlex.split(command, comments=True)
        call = [sys.executable, *COMMANDS[program], *arguments]
        done = subprocess.run(
            call, cwd=tmp_path, env=new, stdout=PIPE, stderr=STDOUT, text=True, check=False, timeout=300
        )
        told, shown = (SECONDS.sub(r"\1 ... s", text) for text in (done.stdout, expected))
        is_shown = doctest.OutputChecker().check_output(shown, told, doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)
        is_whole = doctest.ELLIPSIS_MARKER not in expected  # what is cut short might be a fault
        assert is_shown and (is_whole or done.returncode == 0), f"$ {command}\n{told}"
    monkeypatch.chdir(tmp_path)
    examples = [block for block in blocks(page) if block.language == "python" and block.is_run]
    assert run_examples(page) >= len(examples)


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
