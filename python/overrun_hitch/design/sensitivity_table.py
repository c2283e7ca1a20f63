"""What `hitch sensitivity` shows in a terminal."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain
from pathlib import Path

from overrun_hitch.design.sensitivity import Sensitivity
from overrun_hitch.show.table import Column, Numbers, Row, console, show_written, table


def show(title: str, found: Sensitivity, paths: Sequence[Path]) -> None:
    """Print the indices with their confidence, the most important for damping first, and the files written."""
    out = console()
    out.print(f"{title}, {found.runs} runs")
    pairs = [(Numbers(f"{metric}\nalone"), Numbers("\ntotal")) for metric in found.indices]
    out.print(table([Column(), *chain.from_iterable(pairs)], (_cells(found, place) for place in found.ranked())))
    show_written(out, paths)


def _cells(found: Sensitivity, place: int) -> Row:
    cells = [found.names[place]]
    for one in found.indices.values():
        cells += [_cell(one.first[place], one.first_confidence[place])]
        cells += [_cell(one.total[place], one.total_confidence[place])]
    return cells


def _cell(index: float, confidence: float) -> str:
    return f"{index:.3f} \N{PLUS-MINUS SIGN} {confidence:.3f}"
