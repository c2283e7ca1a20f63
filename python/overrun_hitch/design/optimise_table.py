"""What `hitch optimise` shows in a terminal."""

from __future__ import annotations

from overrun_hitch.design.optimise import Optimum, Wanted
from overrun_hitch.measure.judged import Judged
from overrun_hitch.measure.metrics import METRICS
from overrun_hitch.parameters import Parameters
from overrun_hitch.show.table import Column, Numbers, Row, coloured, console, number, table

DAMPING = (Column(), *(Numbers(heading) for heading in ("theory", "FMU", "allowed")), Column())
COSTS = (Column(), Column("unit"), Numbers("before"), Numbers("after"))


def show(title: str, wanted: Wanted, found: Optimum) -> None:
    """Print the value found, theory against the FMU, and the cost."""
    out = console()
    unit = Parameters.unit(found.name)
    before, after = (float(getattr(each, found.name)) for each in (found.before, found.after))
    out.print(
        f"{title}: {found.name} = {after:.6g} {unit} (was {before:.6g}) gives a damping ratio of {wanted.ratio:g} or "
        f"more from {wanted.V_low:g} to {wanted.V_high:g} m/s",
        soft_wrap=True,
    )
    out.print(table(DAMPING, map(_damping_cells, found.damping)))
    out.print(f"what it costs, step brake of 1000 N.m at {wanted.V_high:g} m/s:")
    costs = ((name, METRICS[name].unit, f"{old:.4g}", f"{new:.4g}") for name, (old, new) in found.costs.items())
    out.print(table(COSTS, costs))


def _damping_cells(one: Judged) -> Row:
    return (one.quantity, number(one.expected), number(one.found), number(one.allowed), coloured(one.verdict))
