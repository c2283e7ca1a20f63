"""`hitch optimise`: the smallest damper, or another parameter, that damps the shunting mode as wanted."""

from __future__ import annotations

from typing import Annotated

import typer

from overrun_hitch.commands.hints import hint
from overrun_hitch.commands.numbers import numbers
from overrun_hitch.commands.options import (
    FmuOption,
    ParametersOption,
    SetOption,
    TimeLimitOption,
    asked_changes,
    chosen_fmu,
)
from overrun_hitch.parameters import CASES, DATUM, HitchError, Parameters, named
from overrun_hitch.scenarios import name_with


def optimise(
    ratio: Annotated[float, typer.Option(help="Damping ratio to reach.")] = 0.1,
    V: Annotated[str, typer.Option("--V", metavar="A:B", help="At every speed from A to B in m/s.")] = "10:40",
    free: Annotated[str, typer.Option(metavar="NAME", help="The parameter to find.")] = "C",
    range_: Annotated[
        str | None,
        typer.Option("--range", metavar="A:B", help="Where to look for it, SI (0 to ten times the present)."),
    ] = None,
    case: Annotated[str | None, typer.Option(help=f"The paper's case: {', '.join(CASES)} (else figure 8).")] = None,
    set_: SetOption = None,
    parameters: ParametersOption = None,
    fmu: FmuOption = None,
    time_limit: TimeLimitOption = 60.0,
) -> int:
    """The smallest C (or --free) with enough damping, by linear theory; the FMU confirms it and tells what it costs.

    Exit status 1 where the FMU does not confirm.
    """
    start = DATUM if case is None else named("case", case, CASES)
    base = start.changed(asked_changes(parameters, set_))
    named("parameter", free, Parameters.model_fields)
    V_low, V_high = _ends("--V", V)

    # Imported here, because fmpy and SciPy would slow down `hitch --help` and wrong options.
    from overrun_hitch.design import optimise_table
    from overrun_hitch.design.optimise import Wanted, default_range
    from overrun_hitch.design.optimise import optimise as search
    from overrun_hitch.fmu.guest_unit import guest_unit
    from overrun_hitch.show import terminal

    wanted = Wanted(ratio=ratio, V_low=V_low, V_high=V_high)
    low, high = default_range(base, free) if range_ is None else _ends("--range", range_)
    for end in (low, high):
        base.changed({free: end})
    with terminal.patience("Looking"), guest_unit(chosen_fmu(fmu), time_limit) as unit:
        found = search(unit, base, free, low, high, wanted)
    hint(base.changed({"V_0": V_high}))
    optimise_table.show(name_with("figure 8" if case is None else f"case {case}", start, base), wanted, found)
    return 1 if any(one.differs for one in found.damping) else 0


def _ends(option: str, text: str) -> tuple[float, float]:
    if text.count(":") != 1:
        raise HitchError(f"{option} {text!r:.40} is no range; allowed: A:B, for example 10:40")
    low, high = numbers(option, text, lambda low, high: [low, high])
    return low, high
