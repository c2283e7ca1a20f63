"""What `hitch optimise` shows in a terminal."""

from __future__ import annotations

from rich.console import Console
from rich.table import Table

from overrun_hitch.design.optimise import Optimum, Wanted
from overrun_hitch.measure.metrics import METRICS
from overrun_hitch.parameters import Parameters
from overrun_hitch.show.terminal import COLOURS


def show(title: str, wanted: Wanted, found: Optimum) -> None:
    """Print the value found, theory against the FMU, and the cost."""
    console = Console(highlight=False)
    unit = Parameters.unit(found.name)
    before, after = (float(getattr(each, found.name)) for each in (found.before, found.after))
    console.print(
        f"{title}: {found.name} = {after:.6g} {unit} (was {before:.6g}) gives a damping ratio of {wanted.ratio:g} or "
        f"more from {wanted.V_low:g} to {wanted.V_high:g} m/s",
        soft_wrap=True,
    )
    damping = Table(box=None, pad_edge=False)
    for heading in ("", "theory", "FMU", "allowed", ""):
        damping.add_column(heading, justify="left" if not heading else "right")
    for one in found.damping:
        verdict = f"[{COLOURS[one.verdict]}]{one.verdict}[/]"
        damping.add_row(one.quantity, f"{one.expected:.5f}", f"{one.found:.5f}", f"{one.allowed:.5f}", verdict)
    console.print(damping)
    console.print(f"what it costs, step brake of 1000 N.m at {wanted.V_high:g} m/s:")
    costs = Table(box=None, pad_edge=False)
    for heading in ("", "unit", "before", "after"):
        costs.add_column(heading, justify="left" if heading in ("", "unit") else "right")
    for name, (old, new) in found.costs.items():
        costs.add_row(name, METRICS[name].unit, f"{old:.4g}", f"{new:.4g}")
    console.print(costs)
