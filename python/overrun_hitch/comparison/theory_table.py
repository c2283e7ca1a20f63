"""What `hitch run` shows in a terminal: theory against simulation."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from overrun_hitch.measure.judged import Judged
from overrun_hitch.parameters import Scenario
from overrun_hitch.results import Run, values
from overrun_hitch.show.table import Column, Numbers, Row, coloured, console, number, show_rows, show_written, small

COLUMNS = (
    Column(), Column("unit"), *(Numbers(heading) for heading in ("theory", "simulation", "difference", "allowed")),
    Column("verdict"),
)  # fmt: skip


def show(scenario: Scenario, result: Run, rows: Sequence[Judged], paths: Sequence[Path]) -> None:
    """Print theory against simulation, what there is to say about it, and the files written."""
    out = console()
    last = float(values(result, "time")[-1])
    torque = "braked from" if result.attrs.get("profile") else f"{scenario.brake_torque:g} N.m at"
    out.print(f"{scenario.name}: {torque} {scenario.parameters.V_0:g} m/s, {last:g} s")
    show_rows(out, COLUMNS, map(_cells, rows), map(_sentence, rows))
    for reason in dict.fromkeys(row.not_judged for row in rows if row.not_judged):
        out.print(f"not judged: {reason}")
    if result.attrs["ended"] == "standstill":
        out.print(f"ended at {last:g} s, before standstill, where the model ends")
    show_written(out, paths)


def _cells(row: Judged) -> Row:
    numbers = (number(row.expected), number(row.found), small(row.difference), small(row.allowed))
    return (row.quantity, row.unit, *numbers, coloured(row.verdict))


def _sentence(row: Judged) -> str:
    both = f"theory {number(row.expected)}, simulation {number(row.found)}"
    return f"{row.quantity} ({row.unit}): {both}, {coloured(row.verdict)}"
