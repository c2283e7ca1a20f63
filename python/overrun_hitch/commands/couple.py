"""`hitch couple`: what coupling Car.fmu and Trailer.fmu, or Hitch.fmu alone, does to the oscillation."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from overrun_hitch.commands.hints import hint
from overrun_hitch.commands.numbers import doubling, numbers
from overrun_hitch.commands.options import (
    ParametersOption,
    SetOption,
    TimeLimitOption,
    asked_changes,
    file_stem,
    name_with,
    our_fmu,
)
from overrun_hitch.parameters import CASES, named

STEPS = "0.001,0.002,0.005,0.01,0.02,0.05"


def couple(
    case: Annotated[str, typer.Option(help=f"The paper's case: {', '.join(CASES)}.")] = "ii",
    set_: SetOption = None,
    parameters: ParametersOption = None,
    V: Annotated[float, typer.Option("--V", help="Speed in m/s.")] = 40.0,
    H: Annotated[str, typer.Option("--H", help="Communication steps in s.")] = STEPS,
    car: Annotated[Path | None, typer.Option(help="Car FMU instead of our own.")] = None,
    trailer: Annotated[Path | None, typer.Option(help="Trailer FMU instead of our own.")] = None,
    hitch: Annotated[Path | None, typer.Option(help="Hitch FMU instead of our own.")] = None,
    whole: Annotated[Path | None, typer.Option(help="Car and trailer in one piece instead of our own.")] = None,
    time_limit: TimeLimitOption = 60.0,
    output: Annotated[Path, typer.Option(help="Folder for the files written.")] = Path("build/couple"),
) -> int:
    """Couple car and trailer by the schemes that masters have, and compare with the model in one piece."""
    base = named("case", case, CASES)
    changed = base.changed(asked_changes(parameters, set_))
    changed.changed({"V_0": V})  # a speed that is none is said so before anything is built
    steps = numbers("--H", H, doubling)

    # Imported here, because fmpy and matplotlib would slow down `hitch --help` and wrong options.
    from overrun_hitch.coupling.figure import draw_coupling
    from overrun_hitch.coupling.pair import guest_pair
    from overrun_hitch.coupling.study import check_step, study_coupling
    from overrun_hitch.coupling.table import csv_columns, show
    from overrun_hitch.coupling.trio import guest_trio
    from overrun_hitch.fmu.files import CAR, CAR_TRAILER, HITCH, TRAILER
    from overrun_hitch.fmu.guest_unit import guest_unit
    from overrun_hitch.show import files, terminal, traces

    for step in steps:
        check_step(step)
    one, first, second = (whole or our_fmu(CAR_TRAILER), car or our_fmu(CAR), trailer or our_fmu(TRAILER))
    between = hitch or our_fmu(HITCH)
    with (
        terminal.patience("Coupling") as told,
        guest_unit(one, time_limit) as unit,
        guest_pair(first, second, time_limit) as pair,
        guest_trio(first, between, time_limit) as trio,
    ):
        study = study_coupling(pair, trio, unit, changed, V, steps, told)
    hint(changed.changed({"V_0": V}))
    name = name_with(f"case {case}", base, changed)
    stem = output / file_stem(name)
    table = stem.with_name(f"{stem.name}.csv")
    with terminal.patience("Drawing"):
        paths = traces.save(draw_coupling(study), stem)
        files.write_csv(table, csv_columns(study))
    show(name, study, [table, *paths])
    return 0
