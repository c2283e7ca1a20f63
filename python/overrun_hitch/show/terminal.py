"""What the command line shows: a table that stays readable in narrow terminals and pipes, and signs of life."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import xarray as xr
from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    ProgressColumn,
    Task,
    TaskID,
    TextColumn,
    TimeRemainingColumn,
)
from rich.table import Table
from rich.text import Text

from overrun_hitch.measure.judged import Judged
from overrun_hitch.parameters import Scenario

PATIENCE = 2.0  # s, after which people wonder
NARROW = 78  # columns that the table needs
COLOURS = {"agrees": "green", "differs": "bold red", "not judged": "yellow"}


@contextmanager
def patience(what: str) -> Iterator[Callable[[str], None]]:
    """Show `what` with a spinner on stderr, where that is a terminal, once it takes over two seconds.

    Gives a function that shows something else from then on.
    """
    console = Console(stderr=True)
    if not console.is_terminal:
        yield lambda _: None
        return
    status = console.status(f"{what} ...")
    timer = threading.Timer(PATIENCE, status.start)
    timer.daemon = True
    timer.start()
    try:
        yield lambda now: status.update(f"{now} ...")
    finally:
        timer.cancel()
        timer.join()  # it may be starting the spinner at this moment
        status.stop()


class _Rate(ProgressColumn):
    def render(self, task: Task) -> Text:
        return Text("" if task.speed is None else f"{task.speed:.0f} runs/s")


@contextmanager
def counting(what: str) -> Iterator[Callable[[int, int, int], None]]:
    """Show a bar with rate and time left on stderr, where that is a terminal.

    Gives a function that is told runs done, failed ones among them, and runs in all.
    """
    ahead = TimeRemainingColumn(), TextColumn("{task.description}")
    columns = (TextColumn(what), BarColumn(), MofNCompleteColumn(), _Rate(), *ahead)
    console = Console(stderr=True)
    with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as progress:
        tasks: list[TaskID] = []

        def told(done: int, failed: int, runs: int) -> None:
            if not tasks:
                tasks.append(progress.add_task("", total=runs, completed=done))
            progress.update(tasks[0], completed=done, description=f"{failed} failed" if failed else "")

        yield told


def show(scenario: Scenario, result: xr.Dataset, rows: Sequence[Judged], paths: Sequence[Path]) -> None:
    """Print theory against simulation, what there is to say about it, and the files written."""
    console = Console(highlight=False)
    last = float(result["time"][-1])
    console.print(f"{scenario.name}: {scenario.brake_torque:g} N.m at {scenario.parameters.V_0:g} m/s, {last:g} s")
    if console.width >= NARROW:
        console.print(_table(rows))
    else:
        for row in rows:
            console.print(
                f"{row.quantity} ({row.unit}): theory {_number(row.expected)}, simulation {_number(row.found)}, "
                f"[{COLOURS[row.verdict]}]{row.verdict}[/]"
            )
    for reason in dict.fromkeys(row.not_judged for row in rows if row.not_judged):
        console.print(f"not judged: {reason}")
    if result.attrs["ended"] == "standstill":
        console.print(f"ended at {last:g} s, before standstill, where the model ends")
    for path in paths:
        console.print(f"wrote {path}", markup=False, soft_wrap=True)


def _table(rows: Sequence[Judged]) -> Table:
    table = Table(box=None, pad_edge=False)
    table.add_column("")
    table.add_column("unit")
    for heading in ("theory", "simulation", "difference", "allowed"):
        table.add_column(heading, justify="right")
    table.add_column("verdict")
    for row in rows:
        table.add_row(
            row.quantity,
            row.unit,
            _number(row.expected),
            _number(row.found),
            _small(row.difference),
            _small(row.allowed),
            f"[{COLOURS[row.verdict]}]{row.verdict}[/]",
        )
    return table


def _number(value: float) -> str:
    return "-" if math.isnan(value) else f"{value:.5f}"


def _small(value: float) -> str:
    return "-" if math.isnan(value) else f"{value:.1e}"
