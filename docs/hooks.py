"""What mkdocs does not find in docs/: pages that lie elsewhere or are made, and the examples, which are run.

The commands' page is their own help. Where a page's examples (`>>>`) save pictures, they run in a folder of their own
when the site is built, and the page shows these. The live page is what `make web` has left.
"""

from __future__ import annotations

import doctest
import os
import posixpath
import re
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from mkdocs.config.defaults import MkDocsConfig
    from mkdocs.structure.files import File, Files
    from mkdocs.structure.pages import Page

ROOT = Path(__file__).parents[1]
LINK = re.compile(r"(?<=\]\()([^)#:\s]+)(?=[)#])")
FROM_ELSEWHERE = ("CHANGELOG.md", "CONTRIBUTING.md", "benchmarks/results.md")  # pages; what is linked comes along
LIVE_PAGE = "live/index.html"  # by `make web`, in build/
NO_LIVE_PAGE = "<!doctype html><title>No live page</title><p>It was not built: <code>make web</code> needs Node."
COMMANDS = {"hitch": "overrun_hitch.cli", "python -m fmu_build": "fmu_build.cli"}


def run_examples(page: Path) -> int:
    """Run a page's examples in the working folder and return how many there are. ValueError where one fails."""
    text = re.sub(r"^```.*$", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE)  # else part of what is expected
    test = doctest.DocTestParser().get_doctest(text, {}, page.name, str(page), 0)
    told: list[str] = []
    result = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE).run(test, out=told.append)
    if result.failed:
        raise ValueError("".join(told))
    return result.attempted


def pictures(page: Path) -> dict[str, bytes]:
    """The pictures that a page's examples leave, by name."""
    before = Path.cwd()
    with TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            run_examples(page)
        finally:
            os.chdir(before)
        return {path.name: path.read_bytes() for path in Path(folder).glob("*.svg")}


def commands() -> str:
    """Every command with its options, in Markdown, as typer writes it."""
    parts = []
    for name, module in COMMANDS.items():
        call = [sys.executable, "-m", "typer", module, "utils", "docs", "--name", name]
        parts.append(subprocess.run(call, capture_output=True, text=True, check=True, cwd=ROOT).stdout)
    text = re.sub(r"^#", "##", "\n".join(parts), flags=re.MULTILINE)
    return "# Commands\n\nAs they tell it themselves: `hitch -h`, `hitch run -h`.\n\n" + text


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add what lies elsewhere, what is linked from pages and lies elsewhere, what is made."""
    from mkdocs.structure.files import File

    live = ROOT / "build" / LIVE_PAGE
    made: dict[str, str | bytes] = {
        "commands.md": commands(),
        LIVE_PAGE: live.read_bytes() if live.is_file() else NO_LIVE_PAGE,
    }
    for page in sorted((ROOT / "docs").glob("*.md")):
        if ".savefig(" in page.read_text(encoding="utf-8"):
            made |= pictures(page)
    for name, content in made.items():
        files.append(File.generated(config, name, content=content))
    waiting = [*FROM_ELSEWHERE, *(f"docs/{file.src_uri}" for file in files.documentation_pages())]
    seen: set[str] = set()
    while waiting:
        name = waiting.pop()
        if name in seen or not (ROOT / name).is_file():
            continue
        seen.add(name)
        if not name.startswith("docs/"):
            files.append(File.generated(config, name, abs_src_path=str(ROOT / name)))
        if name.endswith(".md"):
            waiting += [_target(name, link) for link in LINK.findall((ROOT / name).read_text(encoding="utf-8"))]
    return files


def on_page_markdown(markdown: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Links of the repository become those of the site, where docs/ is the root."""
    file: File = page.file
    name = file.src_uri if (ROOT / file.src_uri).is_file() else f"docs/{file.src_uri}"
    here = posixpath.dirname(file.src_uri)

    def of_the_site(link: re.Match[str]) -> str:
        return posixpath.relpath(_target(name, link[1]).removeprefix("docs/"), here or ".")

    return LINK.sub(of_the_site, markdown)


def _target(page: str, link: str) -> str:
    """The file that a page links, both as paths from the repository's root."""
    return posixpath.normpath(posixpath.join(posixpath.dirname(page), link))
