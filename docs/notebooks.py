"""The notebooks of docs/, run when the site is built: each is a page, and a file to be had with its results in it."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from mkdocs.config.defaults import MkDocsConfig
    from mkdocs.structure.files import Files

NOTEBOOKS = Path(__file__).parent
TIME_LIMIT = 120  # s, of a cell
KERNEL = ["--InlineBackend.figure_formats={'svg'}", "--log-level=ERROR"]
# What pandas gives a table; without it it is the site's own, which scrolls where it is wide.
FRAME = ' border="1" class="dataframe"'


def run(notebook: Path) -> tuple[str, dict[str, bytes]]:
    """A notebook's page in Markdown, and the files beside it by name: the notebook as run, and its pictures.

    What goes wrong in a cell is nbclient.exceptions.CellExecutionError.
    """
    import nbformat
    from nbconvert import MarkdownExporter
    from nbconvert.preprocessors import ExecutePreprocessor

    cells = nbformat.read(notebook, as_version=4)
    with TemporaryDirectory() as folder:
        runner = ExecutePreprocessor(timeout=TIME_LIMIT, kernel_name="python3", extra_arguments=KERNEL)
        runner.preprocess(cells, {"metadata": {"path": folder}})
    names = {"unique_key": notebook.stem, "output_files_dir": f"{notebook.stem}_files"}
    text, made = MarkdownExporter().from_notebook_node(cells, names)
    title, rest = text.strip().split("\n", maxsplit=1)
    offer = f"This page is a notebook: [{notebook.name}]({notebook.name}), to be opened in Jupyter and changed."
    page = f"{title}\n\n{offer}\n{rest.replace(FRAME, '')}\n"
    return page, {notebook.name: nbformat.writes(cells).encode(), **made["outputs"]}


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Put the pages and what belongs to them in place of the notebooks."""
    from mkdocs.structure.files import File

    for notebook in sorted(NOTEBOOKS.glob("*.ipynb")):
        page, beside = run(notebook)
        made: dict[str, str | bytes] = {notebook.with_suffix(".md").name: page, **beside}
        for name, content in made.items():
            if name in files.src_uris:
                files.remove(files.src_uris[name])
            files.append(File.generated(config, name, content=content))
    return files
