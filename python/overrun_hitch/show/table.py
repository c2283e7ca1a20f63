"""What commands show in a terminal: a table, sentences where it is narrow, and which files were written."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console
from rich.table import Table
from rich.text import Text

NARROW = 78  # columns of the terminal that a table needs which can be told in sentences
COLOURS = {"agrees": "green", "differs": "bold red", "not judged": "yellow"}

Row = Sequence[str | Text]


@dataclass(frozen=True)
class Column:
    """A column of words: what stands above it."""

    heading: str = ""


@dataclass(frozen=True)
class Numbers(Column):
    """A column of numbers, on the right and never broken; the unit, if there is one, stands below the heading."""

    unit: str = ""
    least: int = 0  # characters


def console() -> Console:
    """Standard output, which colours nothing by itself."""
    return Console(highlight=False)


def table(columns: Iterable[Column], rows: Iterable[Row]) -> Table:
    """The rows under their headings. Cells are words, with rich's markup, or Text."""
    made = Table(box=None, pad_edge=False)
    for column in columns:
        if isinstance(column, Numbers):
            heading = f"{column.heading}\n{column.unit}" if column.unit else column.heading
            made.add_column(heading, justify="right", no_wrap=True, min_width=column.least or None)
        else:
            made.add_column(column.heading)
    for row in rows:
        made.add_row(*row)
    return made


def show_rows(out: Console, columns: Iterable[Column], rows: Iterable[Row], sentences: Iterable[str]) -> None:
    """Print the table; the sentences, which say the same, where the terminal is narrow."""
    if out.width >= NARROW:
        out.print(table(columns, rows))
    else:
        for sentence in sentences:
            out.print(sentence)


def show_written(out: Console, paths: Iterable[Path]) -> None:
    """Print which files were written, each on a line that can be copied."""
    for path in paths:
        out.print(f"wrote {path}", markup=False, soft_wrap=True)


def coloured(verdict: str) -> str:
    """One of COLOURS, in its colour."""
    return f"[{COLOURS[verdict]}]{verdict}[/]"


def number(value: float, digits: int = 5) -> str:
    """With so many decimals; a dash where there is none."""
    return f"{value:.{digits}f}" if math.isfinite(value) else "-"


def small(value: float) -> str:
    """A difference: two digits and a power of ten, 0 where there is none to show; a dash where it is not finite."""
    return "0" if value == 0.0 else f"{value:.1e}" if math.isfinite(value) else "-"
