"""What `hitch sweep` shows in a terminal: the spread of each metric, and the runs that failed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from rich.console import Console

from overrun_hitch.measure.metrics import METRICS
from overrun_hitch.measure.oscillation import FITS
from overrun_hitch.show.table import Column, Numbers, Row, console, show_written, table
from overrun_hitch.sweeps.layout import FAILED

Floats = NDArray[np.float64]

COLUMNS = (Column(), Column("unit"), *(Numbers(heading) for heading in ("least", "median", "greatest", "without")))
MOST_MESSAGES = 3


def failures(sweep: xr.Dataset) -> int:
    """How many runs failed."""
    return int((sweep["status"] == FAILED).sum())


def show(name: str, sweep: xr.Dataset, paths: Sequence[Path]) -> None:
    """Print the least, median and greatest of each metric, why runs failed, and the files written."""
    out = console()
    out.print(f"{name}: {sweep.sizes['run']} runs")
    out.print(table(COLUMNS, (_cells(metric, sweep[metric].values) for metric in METRICS if metric in sweep)))
    _show_misfits(out, sweep)
    _show_failures(out, sweep)
    show_written(out, paths)


def _cells(metric: str, values: Floats) -> Row:
    some = values[np.isfinite(values)]
    spread = [f"{value:.5g}" for value in (some.min(), np.median(some), some.max())] if some.size else ["-"] * 3
    return (metric, METRICS[metric].unit, *spread, str(values.size - some.size or ""))


def _show_misfits(out: Console, sweep: xr.Dataset) -> None:
    """Why runs have no growth rate: how many do not oscillate, and in how many no exponential fits."""
    if "fit_residual" not in sweep:
        return
    residual = sweep["fit_residual"].values[sweep["status"].values != FAILED]
    misfits, still = int((residual > FITS).sum()), int(np.isnan(residual).sum())
    if misfits:
        out.print(f"in {misfits} runs no exponential fits the oscillation (fit_residual over {FITS:g})")
    if still:
        out.print(f"in {still} runs the drawbar does not oscillate long enough to measure")


def _show_failures(out: Console, sweep: xr.Dataset) -> None:
    count = failures(sweep)
    if not count:
        return
    out.print(f"{count} runs failed:")
    reasons = Counter(str(text) for text in sweep["message"].values if text)
    for message, times in reasons.most_common(MOST_MESSAGES):
        out.print(f"  {times} x {message}", markup=False, soft_wrap=True)
    if len(reasons) > MOST_MESSAGES:
        out.print(f"  and {len(reasons) - MOST_MESSAGES} other messages, in the store")
