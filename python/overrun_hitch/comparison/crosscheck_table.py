"""What a crosscheck says: tables in the terminal, and all of its numbers as one JSON document."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

from overrun_hitch.comparison.crosscheck import LABELS, Allowed, Comparison, Crosscheck, Distance
from overrun_hitch.fmu.settings import Settings
from overrun_hitch.measure.judged import Judged
from overrun_hitch.results import values
from overrun_hitch.show.terminal import COLOURS, NARROW

MOST_PASSAGES = 6  # in a table; figure 6a has 22


def show(checks: Sequence[Crosscheck], fmus: Sequence[Path], allowed: Allowed, paths: Sequence[Path]) -> None:
    """Print what the labels mean, two tables a figure, the verdict on each FMU and the files written."""
    console = Console(highlight=False)
    for label, fmu in zip(LABELS, fmus, strict=False):
        console.print(f"{label}  {fmu}", markup=False, soft_wrap=True)
    console.print(
        f"funnel: {100.0 * allowed.funnel:g} % of the range in A up and down, "
        f"{1000.0 * allowed.funnel_time:g} ms to either side"
    )
    for check in checks:
        _show_figure(console, check)
    console.print()
    for label, comparisons in zip(LABELS[1:], zip(*(check.comparisons for check in checks), strict=True), strict=False):
        differing = {check.scenario.name: c.differing for check, c in zip(checks, comparisons, strict=True)}
        agreeing = [name for name, names in differing.items() if not names]
        if agreeing:
            console.print(f"{label} agrees with A in {', '.join(agreeing)}", soft_wrap=True)
        for name, names in differing.items():
            if names:
                console.print(f"{label} differs from A in {name}: {', '.join(names)}", soft_wrap=True)
    for path in paths:
        console.print(f"wrote {path}", markup=False, soft_wrap=True)


def document(
    checks: Sequence[Crosscheck], fmus: Sequence[Path], settings: Settings, allowed: Allowed, paths: Sequence[Path]
) -> str:
    """Every number and verdict as JSON, SI units, null for what is not finite. Its keys: docs/openmodelica.md."""
    guids = [run.attrs["guid"] for run in checks[0].runs]
    content = {
        "agrees": not any(comparison.differing for check in checks for comparison in check.comparisons),
        "fmus": [
            {"label": label, "path": str(fmu), "guid": guid}
            for label, fmu, guid in zip(LABELS, fmus, guids, strict=False)
        ],
        "settings": {**settings.model_dump(), **allowed.model_dump()},
        "figures": [
            {
                "name": check.scenario.name,
                "brake_torque": check.scenario.brake_torque,
                "duration": check.scenario.duration,
                "parameters": check.scenario.parameters.model_dump(),
                "comparisons": [_comparison(comparison) for comparison in check.comparisons],
            }
            for check in checks
        ],
        "files": [str(path) for path in paths],
    }
    return json.dumps(_finite(content), indent=2, allow_nan=False) + "\n"


def _comparison(comparison: Comparison) -> dict[str, Any]:
    def row(judged: Distance | Judged) -> dict[str, Any]:
        return {**asdict(judged), "verdict": judged.verdict}

    def number(judged: Judged) -> dict[str, Any]:
        return {**row(judged), "difference": judged.difference}

    return {
        "fmu": comparison.label,
        "agrees": not comparison.differing,
        "variables": [row(distance) for distance in comparison.distances],
        "numbers": [number(judged) for judged in comparison.numbers],
        "passages": [number(judged) for judged in comparison.passages],
    }


def _finite(content: Any) -> Any:
    """JSON knows neither NaN nor infinity."""
    if isinstance(content, dict):
        return {name: _finite(value) for name, value in content.items()}
    if isinstance(content, list):
        return [_finite(value) for value in content]
    return None if isinstance(content, float) and not math.isfinite(content) else content


def _show_figure(console: Console, check: Crosscheck) -> None:
    last = float(values(check.runs[0], "time")[-1])
    speed = check.scenario.parameters.V_0
    console.print(f"\n{check.scenario.name}: {check.scenario.brake_torque:g} N.m at {speed:g} m/s, {last:g} s")
    distances = [(c.label, distance) for c in check.comparisons for distance in c.distances]
    numbers = [(c.label, number) for c in check.comparisons for number in (*c.numbers, *_farthest(c.passages))]
    if console.width >= NARROW:
        console.print(_distance_table(distances))
        console.print(_number_table(numbers))
    else:
        for label, distance in distances:
            far = f"{_small(distance.largest)} {distance.unit} away at {_number(distance.at)} s"
            console.print(f"{label} {distance.variable}: {far}, {_coloured(distance.verdict)}")
        for label, number in numbers:
            pair = f"{_number(number.expected)} and {_number(number.found)}"
            console.print(f"{label} {number.quantity} ({number.unit}): {pair}, {_coloured(number.verdict)}")
    for c in check.comparisons:
        if len(c.passages) > MOST_PASSAGES:
            console.print(f"{c.label}: of {len(c.passages)} drawbar passages the {MOST_PASSAGES} farthest apart")
    for reason in dict.fromkeys(number.not_judged for _, number in numbers if number.not_judged):
        console.print(f"not judged: {reason}")


def _distance_table(rows: Sequence[tuple[str, Distance]]) -> Table:
    table = _table("variable", "distance", "of range", "at (s)", "leaves (s)")
    for label, row in rows:
        cells = (_small(row.largest), _percent(row), _number(row.at, 2), _number(row.leaves, 2))
        table.add_row(label, row.variable, row.unit, *cells, _coloured(row.verdict))
    return table


def _number_table(rows: Sequence[tuple[str, Judged]]) -> Table:
    table = _table("", "A", "other", "difference", "allowed")
    for label, row in rows:
        cells = (_number(row.expected), _number(row.found), _small(row.difference), _small(row.allowed))
        table.add_row(label, row.quantity, row.unit, *cells, _coloured(row.verdict))
    return table


def _table(what: str, *headings: str) -> Table:
    table = Table(box=None, pad_edge=False)
    for heading in ("", what, "unit"):
        table.add_column(heading)
    for heading in headings:
        table.add_column(heading, justify="right")
    table.add_column("verdict")
    return table


def _farthest(passages: Sequence[Judged]) -> list[Judged]:
    """The passages farthest apart, those of one FMU alone before all others, in order of time."""
    order = sorted(passages, key=lambda row: -math.inf if math.isnan(row.difference) else -abs(row.difference))
    chosen = order[:MOST_PASSAGES]
    return [row for row in passages if any(row is one for one in chosen)]


def _coloured(verdict: str) -> str:
    return f"[{COLOURS[verdict]}]{verdict}[/]"


def _percent(row: Distance) -> str:
    return f"{_small(100.0 * row.largest / row.range)} %" if row.range > 0.0 else "-"


def _number(value: float, digits: int = 5) -> str:
    return f"{value:.{digits}f}" if math.isfinite(value) else "-"


def _small(value: float) -> str:
    return "0" if value == 0.0 else f"{value:.1e}" if math.isfinite(value) else "-"
