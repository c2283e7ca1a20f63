"""What a crosscheck says in the terminal."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import starmap
from pathlib import Path

from rich.console import Console

from overrun_hitch.comparison.alignment import Alignment
from overrun_hitch.comparison.crosscheck import Comparison, Crosscheck
from overrun_hitch.comparison.distances import Allowed, Distance
from overrun_hitch.comparison.numbers import FREQUENCY_ALLOWED, GROWTH_RATE_ALLOWED
from overrun_hitch.comparison.record import Compared
from overrun_hitch.measure.judged import Judged
from overrun_hitch.results import VARIABLES, values
from overrun_hitch.show.table import Column, Numbers, Row, coloured, console, number, show_rows, show_written, small
from overrun_hitch.show.words import printable

MOST_PASSAGES = 6  # in a table; figure 6a has 22
DISTANCES = (
    *(Column(heading) for heading in ("", "variable", "unit")),
    *(Numbers(heading) for heading in ("distance", "of range", "at (s)", "rms")),
    Column("verdict"),
)
NUMBERS = (
    *(Column(heading) for heading in ("", "", "unit")),
    *(Numbers(heading) for heading in ("A", "other", "difference", "allowed")),
    Column("verdict"),
)


def show(checks: Sequence[Crosscheck], compared: Sequence[Compared], allowed: Allowed, paths: Sequence[Path]) -> None:
    """Print what the labels mean, two tables a figure, the verdict on each file and the files written."""
    out = console()
    for one in compared:
        _say(out, f"{one.label}  {one.name}")
        for note in one.notes:
            _say(out, f"   {note}")
    out.print(
        f"funnel: {100.0 * allowed.funnel:g} % of the range in A up and down, "
        f"{1000.0 * allowed.funnel_time:g} ms to either side"
    )
    absolute, relative = GROWTH_RATE_ALLOWED
    out.print(
        f"growth rate: {absolute:g} 1/s + {100.0 * relative:g} %, frequency: {100.0 * FREQUENCY_ALLOWED:g} %; why: "
        "docs/crosscheck.md",
        soft_wrap=True,
    )
    for check in checks:
        _show_figure(out, check)
    out.print()
    for place, one in enumerate(compared[1:]):
        _show_verdict(out, one.label, {check.scenario.name: check.comparisons[place] for check in checks})
    show_written(out, paths)


def _say(out: Console, line: str) -> None:
    """A line that may have other people's words in it."""
    out.print(printable(line), markup=False, soft_wrap=True)


def aligned(found: Alignment) -> str:
    """What was found of a measured trace, in a sentence."""
    noises = ", ".join(f"{name} {small(sigma)} {VARIABLES[name][0]}" for name, sigma in found.noise.items())
    return (
        f"its time is {found.shift:.4f} s late, with 95 % confidence to {small(found.error)} s; "
        f"noise (standard deviation): {noises}"
    )


def _show_verdict(out: Console, label: str, comparisons: dict[str, Comparison]) -> None:
    agreeing: dict[tuple[str, ...], list[str]] = {}
    failing: dict[str, list[str]] = {}
    for name, comparison in comparisons.items():
        if comparison.failure:
            failing.setdefault(comparison.failure, []).append(name)
        elif not comparison.differing:
            agreeing.setdefault(tuple(comparison.not_compared), []).append(name)
    for absent, figures in agreeing.items():
        but = f" in all that can be compared; not compared: {', '.join(absent)}" if absent else ""
        _say(out, f"{label} agrees with A in {', '.join(figures)}{but}")
    for name, comparison in comparisons.items():
        if comparison.differing:
            but = f"; not compared: {', '.join(comparison.not_compared)}" if comparison.not_compared else ""
            _say(out, f"{label} differs from A in {name}: {', '.join(comparison.differing)}{but}")
            for row in comparison.distances:
                if row.hint:
                    _say(out, f"   {row.variable}: {row.hint}")
    for failure, figures in failing.items():
        _say(out, f"{label} could not be compared in {', '.join(figures)}: {failure}")


def _show_figure(out: Console, check: Crosscheck) -> None:
    last = check.scenario.duration if check.reference is None else float(values(check.reference, "time")[-1])
    speed = check.scenario.parameters.V_0
    out.print()
    _say(out, f"{check.scenario.name}: {check.scenario.brake_torque:g} N.m at {speed:g} m/s, {last:g} s")
    distances = [(c.label, row) for c in check.comparisons for row in c.distances if not row.not_judged]
    numbers = [(c.label, judged) for c in check.comparisons for judged in (*c.numbers, *_farthest(c.passages))]
    if distances:
        show_rows(out, DISTANCES, starmap(_distance_cells, distances), starmap(_distance_sentence, distances))
    show_rows(out, NUMBERS, starmap(_number_cells, numbers), starmap(_number_sentence, numbers))
    for c in check.comparisons:
        if c.alignment:
            _say(out, f"{c.label}: {aligned(c.alignment)}")
        if len(c.passages) > MOST_PASSAGES:
            out.print(f"{c.label}: of {len(c.passages)} drawbar passages the {MOST_PASSAGES} farthest apart")
    for reason in dict.fromkeys(judged.not_judged for _, judged in numbers if judged.not_judged):
        _say(out, f"not judged: {reason}")


def _distance_cells(label: str, row: Distance) -> Row:
    numbers = (small(row.largest), _percent(row), number(row.at, 2), small(row.rms))
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
