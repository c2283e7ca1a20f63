"""What a crosscheck says: tables in the terminal, and all of its numbers as one JSON document."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict
from itertools import starmap
from pathlib import Path
from typing import Any

from rich.console import Console

from overrun_hitch.comparison.crosscheck import LABELS, Allowed, Comparison, Crosscheck, Distance
from overrun_hitch.fmu.settings import Settings
from overrun_hitch.measure.judged import Judged
from overrun_hitch.results import values
from overrun_hitch.show.table import Column, Numbers, Row, coloured, console, number, show_rows, show_written, small

MOST_PASSAGES = 6  # in a table; figure 6a has 22
DISTANCES = (
    *(Column(heading) for heading in ("", "variable", "unit")),
    *(Numbers(heading) for heading in ("distance", "of range", "at (s)", "leaves (s)")),
    Column("verdict"),
)
NUMBERS = (
    *(Column(heading) for heading in ("", "", "unit")),
    *(Numbers(heading) for heading in ("A", "other", "difference", "allowed")),
    Column("verdict"),
)


def show(checks: Sequence[Crosscheck], fmus: Sequence[Path], allowed: Allowed, paths: Sequence[Path]) -> None:
    """Print what the labels mean, two tables a figure, the verdict on each FMU and the files written."""
    out = console()
    for label, fmu in zip(LABELS, fmus, strict=False):
        out.print(f"{label}  {fmu}", markup=False, soft_wrap=True)
    out.print(
        f"funnel: {100.0 * allowed.funnel:g} % of the range in A up and down, "
        f"{1000.0 * allowed.funnel_time:g} ms to either side"
    )
    for check in checks:
        _show_figure(out, check)
    out.print()
    for label, comparisons in zip(LABELS[1:], zip(*(check.comparisons for check in checks), strict=True), strict=False):
        differing = {check.scenario.name: c.differing for check, c in zip(checks, comparisons, strict=True)}
        agreeing = [name for name, names in differing.items() if not names]
        if agreeing:
            out.print(f"{label} agrees with A in {', '.join(agreeing)}", soft_wrap=True)
        for name, names in differing.items():
            if names:
                out.print(f"{label} differs from A in {name}: {', '.join(names)}", soft_wrap=True)
    show_written(out, paths)


def document(
    checks: Sequence[Crosscheck], fmus: Sequence[Path], settings: Settings, allowed: Allowed, paths: Sequence[Path]
) -> dict[str, Any]:
    """Every number and verdict for JSON, SI units. Its keys: docs/openmodelica.md."""
    guids = [run.attrs["guid"] for run in checks[0].runs]
    return {
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


def _comparison(comparison: Comparison) -> dict[str, Any]:
    def row(judged: Distance | Judged) -> dict[str, Any]:
        return {**asdict(judged), "verdict": judged.verdict}

    def pair(judged: Judged) -> dict[str, Any]:
        return {**row(judged), "difference": judged.difference}

    return {
        "fmu": comparison.label,
        "agrees": not comparison.differing,
        "variables": [row(distance) for distance in comparison.distances],
        "numbers": [pair(judged) for judged in comparison.numbers],
        "passages": [pair(judged) for judged in comparison.passages],
    }


def _show_figure(out: Console, check: Crosscheck) -> None:
    last = float(values(check.runs[0], "time")[-1])
    speed = check.scenario.parameters.V_0
    out.print(f"\n{check.scenario.name}: {check.scenario.brake_torque:g} N.m at {speed:g} m/s, {last:g} s")
    distances = [(c.label, distance) for c in check.comparisons for distance in c.distances]
    numbers = [(c.label, judged) for c in check.comparisons for judged in (*c.numbers, *_farthest(c.passages))]
    show_rows(out, DISTANCES, starmap(_distance_cells, distances), starmap(_distance_sentence, distances))
    show_rows(out, NUMBERS, starmap(_number_cells, numbers), starmap(_number_sentence, numbers))
    for c in check.comparisons:
        if len(c.passages) > MOST_PASSAGES:
            out.print(f"{c.label}: of {len(c.passages)} drawbar passages the {MOST_PASSAGES} farthest apart")
    for reason in dict.fromkeys(judged.not_judged for _, judged in numbers if judged.not_judged):
        out.print(f"not judged: {reason}")


def _distance_cells(label: str, row: Distance) -> Row:
    numbers = (small(row.largest), _percent(row), number(row.at, 2), number(row.leaves, 2))
    return (label, row.variable, row.unit, *numbers, coloured(row.verdict))


def _distance_sentence(label: str, row: Distance) -> str:
    far = f"{small(row.largest)} {row.unit} away at {number(row.at)} s"
    return f"{label} {row.variable}: {far}, {coloured(row.verdict)}"


def _number_cells(label: str, row: Judged) -> Row:
    numbers = (number(row.expected), number(row.found), small(row.difference), small(row.allowed))
    return (label, row.quantity, row.unit, *numbers, coloured(row.verdict))


def _number_sentence(label: str, row: Judged) -> str:
    return (
        f"{label} {row.quantity} ({row.unit}): {number(row.expected)} and {number(row.found)}, {coloured(row.verdict)}"
    )


def _farthest(passages: Sequence[Judged]) -> list[Judged]:
    """The passages farthest apart, those of one FMU alone before all others, in order of time."""
    order = sorted(passages, key=lambda row: -math.inf if math.isnan(row.difference) else -abs(row.difference))
    chosen = order[:MOST_PASSAGES]
    return [row for row in passages if any(row is one for one in chosen)]


def _percent(row: Distance) -> str:
    return f"{small(100.0 * row.largest / row.range)} %" if row.range > 0.0 else "-"
