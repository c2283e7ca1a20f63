"""Signs of life on stderr while something takes its time."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

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
from rich.text import Text

PATIENCE = 2.0  # s, after which people wonder


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
def counting(what: str, is_kept: bool = True) -> Iterator[Callable[[int, int, int], None]]:
    """Show a bar with rate and time left on stderr, where that is a terminal; after Ctrl-C how far it came.

    Gives a function that is told runs done, failed ones among them, and runs in all. `is_kept`: so is what is done.
    """
    ahead = TimeRemainingColumn(), TextColumn("{task.description}")
    columns = (TextColumn(what), BarColumn(), MofNCompleteColumn(), _Rate(), *ahead)
    console = Console(stderr=True)
    tasks: list[TaskID] = []
    try:
        with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as progress:

            def told(done: int, failed: int, runs: int) -> None:
                if not tasks:
                    tasks.append(progress.add_task("", total=runs, completed=done))
                progress.update(tasks[0], completed=done, description=f"{failed} failed" if failed else "")

            yield told
    except KeyboardInterrupt:
        for task in progress.tasks:
            so_far = f"{task.completed:.0f} of {task.total:.0f} runs are done"
            goes_on = "; the same command goes on" if is_kept else ""
            print(f"interrupted, {so_far}{goes_on}", file=sys.stderr)
        raise
