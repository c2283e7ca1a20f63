"""What `hitch sweep` shows in a terminal: the spread of each metric, and the runs that failed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import xarray as xr
from rich.console import Console
from rich.table import Table

from overrun_hitch.measure.metrics import METRICS
from overrun_hitch.sweeps.store import FAILED

MOST_MESSAGES = 3


def failures(sweep: xr.Dataset) -> int:
    """How many runs failed."""
    return int((sweep["status"] == FAILED).sum())


def show(name: str, sweep: xr.Dataset, paths: Sequence[Path]) -> None:
    """Print the least, median and greatest of each metric, why runs failed, and the files written."""
    console = Console(highlight=False)
    console.print(f"{name}: {sweep.sizes['run']} runs")
    table = Table(box=None, pad_edge=False)
    for heading in ("", "unit", "least", "median", "greatest", "without"):
        table.add_column(heading, justify="left" if heading in ("", "unit") else "right")
    for metric in METRICS:
        if metric in sweep:
            values = sweep[metric].values
            some = values[np.isfinite(values)]
            spread = [f"{value:.5g}" for value in (some.min(), np.median(some), some.max())] if some.size else ["-"] * 3
            table.add_row(metric, METRICS[metric].unit, *spread, str(values.size - some.size or ""))
    console.print(table)
    _show_failures(console, sweep)
    for path in paths:
        console.print(f"wrote {path}", markup=False, soft_wrap=True)


def _show_failures(console: Console, sweep: xr.Dataset) -> None:
    count = failures(sweep)
    if not count:
        return
    console.print(f"{count} runs failed:")
    reasons = Counter(str(text) for text in sweep["message"].values if text)
    for message, times in reasons.most_common(MOST_MESSAGES):
        console.print(f"  {times} x {message}", markup=False, soft_wrap=True)
    if len(reasons) > MOST_MESSAGES:
        console.print(f"  and {len(reasons) - MOST_MESSAGES} other messages, in the store")
