"""What `hitch stability` shows in a terminal: a table that stays readable in narrow terminals and pipes."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from pathlib import Path

from overrun_hitch.modes.study import Row, Stability
from overrun_hitch.show.table import Column, Numbers, console, show_rows, show_written
from overrun_hitch.theory.linear import REBOUND_REACH, rebound_error

COLUMNS = (
    Numbers("V", "m/s"), Numbers("C", "N.s/m"), Numbers("growth", "1/s"), Numbers("frequency", "Hz"),
    Numbers("damping\nratio"), Numbers("|x_t/x_c|", "1"), Numbers("phase", "deg"), Column(),
)  # fmt: skip


def show(result: Stability, paths: Sequence[Path]) -> None:
    """Print modes, steady state, boundary and the files written."""
    out = console()
    out.print(f"{result.name}: shunting mode by linear theory")
    for remark in _remarks(result):
        out.print(remark, soft_wrap=True)
    show_rows(out, COLUMNS, (_cells(row) for row in result.rows), map(_sentence, result.rows))
    for row in result.rows:
        if row.onset_amplitude is not None:
            out.print(_onset(row, result.parameters.F_f), soft_wrap=True)
    for boundary in result.boundaries:
        limit = f"C_crit = {_number(boundary.C_crit, 4)} N.s/m" if boundary.C_crit > 0.0 else "stable without a damper"
        out.print(f"at {boundary.V:g} m/s: {limit}")
    out.print(f"steady deceleration A/A_c = {result.A_over_A_c:.5f}")
    out.print(f"drawbar deflection D = {_number(result.D, 5)} m at {result.deceleration:g} m/s2")
    show_written(out, paths)


def _remarks(result: Stability) -> Iterable[str]:
    """What a reader must know who has set more than the paper's parameters: the working point and its reach."""
    point, p = result.point, result.parameters
    low, high = point.reach
    about = f"steady braking by {point.deceleration:g} m/s2" if point.deceleration > 0.0 else "gentle braking"
    if math.isfinite(high) or low > p.eps or point.deceleration > 0.0:
        until = f"to {high:.4g} m" if math.isfinite(high) else "on"
        slope = f"{point.stiffness} = {point.linear.k:g} N/m"
        yield f"small motions about {about}: {slope}, which holds from {low:.4g} m of compression {until}"
    if "mu" in p.off_default("small"):
        yield f"mu = {p.mu:g}: tyre stiffness C_kc = {point.linear.C_kc:.6g} N, C_kt = {point.linear.C_kt:.6g} N there"
    if "rebound" in result.approximate:
        error = max(rebound_error(point.linear.changed({"C": row.C}), row.V) for row in result.rows)
        off = f"{error:.1g} of itself or less" if error <= REBOUND_REACH else f"more than {REBOUND_REACH:g} of itself"
        yield (
            f"approximate for rebound = {p.rebound:g}: a damper of (1 + rebound)/2 C, equal in energy a cycle; "
            f"with the strongest damper here the damping ratio is off by {off}"
        )


def _onset(row: Row, F_f: float) -> str:
    return (
        f"at {row.V:g} m/s with C = {row.C:g} N.s/m: friction F_f = {F_f:g} N lets only motions grow whose compression "
        f"swings by more than {row.onset_amplitude:.3g} m"
    )


def _sentence(row: Row) -> str:
    V, C, growth, frequency, damping, amplitude, phase, verdict = _cells(row)
    return (
        f"V {V} m/s, C {C} N.s/m: growth {growth} 1/s, frequency {frequency} Hz, damping ratio {damping}, "
        f"|x_t/x_c| {amplitude}, phase {phase} deg, {verdict}"
    )


def _cells(row: Row) -> tuple[str, ...]:
    return (
        f"{row.V:.6g}",
        f"{row.C:.6g}",
        _number(row.growth_rate, 5),
        _number(row.frequency, 5),
        _number(row.damping_ratio, 5),
        _number(row.amplitude_ratio, 3),
        f"{row.phase:.2f}",
        "[bold red]self-excited[/]" if row.self_excited else "[green]stable[/]",
    )


def _number(value: float, decimals: int) -> str:
    """With so many decimals where that shows three digits at least and does not run out of the column."""
    if value == 0.0 or 10.0 ** (2 - decimals) <= abs(value) < 1e5:
        return f"{value:.{decimals}f}"
    return f"{value:.3g}"
