"""What `hitch stability` shows in a terminal: a table that stays readable in narrow terminals and pipes."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rich.console import Console
from rich.table import Table

from overrun_hitch.modes.study import HARD, Row, Stability

NARROW = 76  # columns that the table needs


def show(result: Stability, paths: Sequence[Path]) -> None:
    """Print modes, steady state, boundary and the files written."""
    console = Console(highlight=False)
    console.print(f"{result.name}: shunting mode by linear theory")
    if console.width >= NARROW:
        console.print(_table(result.rows))
    else:
        for row in result.rows:
            console.print(_sentence(row))
    for boundary in result.boundaries:
        limit = f"C_crit = {_number(boundary.C_crit, 4)} N.s/m" if boundary.C_crit > 0.0 else "stable without a damper"
        console.print(f"at {boundary.V:g} m/s: {limit}")
    console.print(f"steady deceleration A/A_c = {result.A_over_A_c:.5f}")
    console.print(f"drawbar deflection D = {_number(result.D, 5)} m at {HARD:g} m/s2")
    for path in paths:
        console.print(f"wrote {path}", markup=False, soft_wrap=True)


def _table(rows: Sequence[Row]) -> Table:
    table = Table(box=None, pad_edge=False)
    for heading in (
        "V\nm/s",
        "C\nN.s/m",
        "growth\n1/s",
        "frequency\nHz",
        "damping\nratio",
        "|x_t/x_c|\n1",
        "phase\ndeg",
    ):
        table.add_column(heading, justify="right", no_wrap=True)
    table.add_column("")
    for row in rows:
        table.add_row(*_cells(row).values(), _verdict(row))
    return table


def _sentence(row: Row) -> str:
    cell = _cells(row)
    return (
        f"V {cell['V']} m/s, C {cell['C']} N.s/m: growth {cell['growth']} 1/s, frequency {cell['frequency']} Hz, "
        f"damping ratio {cell['damping']}, |x_t/x_c| {cell['amplitude']}, phase {cell['phase']} deg, {_verdict(row)}"
    )


def _cells(row: Row) -> dict[str, str]:
    return {
        "V": f"{row.V:.6g}",
        "C": f"{row.C:.6g}",
        "growth": _number(row.growth_rate, 5),
        "frequency": _number(row.frequency, 5),
        "damping": _number(row.damping_ratio, 5),
        "amplitude": _number(row.amplitude_ratio, 3),
        "phase": f"{row.phase:.2f}",
    }


def _number(value: float, decimals: int) -> str:
    """With so many decimals where that shows three digits at least and does not run out of the column."""
    if value == 0.0 or 10.0 ** (2 - decimals) <= abs(value) < 1e5:
        return f"{value:.{decimals}f}"
    return f"{value:.3g}"


def _verdict(row: Row) -> str:
    return "[bold red]self-excited[/]" if row.self_excited else "[green]stable[/]"
