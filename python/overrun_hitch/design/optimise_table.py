"""What `hitch optimise` shows in a terminal."""

from __future__ import annotations

import math
from collections.abc import Iterator

from overrun_hitch.design.optimise import Optimum, Wanted
from overrun_hitch.experiments.free_vibration import left_out
from overrun_hitch.measure.judged import Judged
from overrun_hitch.measure.metrics import METRICS
from overrun_hitch.parameters import Parameters, with_unit
from overrun_hitch.show.table import Column, Numbers, Row, coloured, console, number, table
from overrun_hitch.theory.working_point import working_point

DAMPING = (Column(), *(Numbers(heading) for heading in ("theory", "FMU", "allowed")), Column())
COSTS = (Column(), Column("unit"), Numbers("before"), Numbers("after"))


def show(title: str, wanted: Wanted, found: Optimum) -> None:
    """Print the value found, theory against the FMU, and the cost."""
    out = console()
    unit = Parameters.unit(found.name)
    before, after = (float(getattr(each, found.name)) for each in (found.before, found.after))
    out.print(
        f"{title}: {found.name} = {with_unit(after, unit)} (was {before:.6g}) gives a damping ratio of "
        f"{wanted.ratio:g} or more from {wanted.V_low:g} to {wanted.V_high:g} m/s",
        soft_wrap=True,
    )
    for remark in _remarks(found):
        out.print(remark, soft_wrap=True)
    out.print(table(DAMPING, map(_damping_cells, found.damping)))
    if math.isfinite(found.residual):
        out.print(f"the fits of the FMU's vibrations leave {found.residual:.1g} of them at most")
    out.print(f"what it costs, step brake of 1000 N.m at {wanted.V_high:g} m/s:")
    costs = ((name, METRICS[name].unit, *map(_cost, pair)) for name, pair in found.costs.items())
    out.print(table(COSTS, costs))


def _remarks(found: Optimum) -> Iterator[str]:
    """What the number alone does not tell."""
    name, unit, smallest, after = found.name, Parameters.unit(found.name), found.found, found.after
    if smallest.is_edge:
        edge = with_unit(smallest.value, unit)
        yield f"{name} = {edge} is the edge of the range: whether less is enough was not looked at"
    if math.isfinite(smallest.enough_until):
        yield f"more is not better: from {name} = {with_unit(smallest.enough_until, unit)} on it is too little again"
    if after.rebound != 1.0:
        yield "approximate: theory takes a damper of (1 + rebound)/2 C, and the FMU's is the logarithmic decrement"
    yield from left_out(after)
    low, high = working_point(after).reach
    if math.isfinite(high) or low > after.eps:
        until = f" to {high:.4g} m" if math.isfinite(high) else " on"
        yield f"for small motions about gentle braking, from {low:.4g} m of compression{until}"


def _cost(value: float) -> str:
    return f"{value:.4g}" if math.isfinite(value) else "-"


def _damping_cells(one: Judged) -> Row:
    return (one.quantity, number(one.expected), number(one.found), number(one.allowed), coloured(one.verdict))
