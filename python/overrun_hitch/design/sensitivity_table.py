"""What `hitch sensitivity` shows in a terminal."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.table import Table

from overrun_hitch.design.sensitivity import Sensitivity


def show(title: str, found: Sensitivity, paths: Sequence[Path]) -> None:
    """Print the indices with their confidence, the most important for damping first, and the files written."""
    console = Console(highlight=False)
    console.print(f"{title}, {found.runs} runs")
    table = Table(box=None, pad_edge=False)
    table.add_column("")
    for metric in found.indices:
        table.add_column(f"{metric}\nalone", justify="right", no_wrap=True)
        table.add_column("\ntotal", justify="right", no_wrap=True)
    first = next(iter(found.indices.values()))
    for place in np.argsort(-first.total):
        cells = []
        for one in found.indices.values():
            cells += [_cell(one.first[place], one.first_confidence[place])]
            cells += [_cell(one.total[place], one.total_confidence[place])]
        table.add_row(found.names[place], *cells)
    console.print(table)
    for path in paths:
        console.print(f"wrote {path}", markup=False, soft_wrap=True)


def _cell(index: float, confidence: float) -> str:
    return f"{index:.3f} \N{PLUS-MINUS SIGN} {confidence:.3f}"
