"""`hitch crosscheck`: the same step brakes on several FMUs, compared with the first."""

from __future__ import annotations

from contextlib import ExitStack
from pathlib import Path
from typing import Annotated

import typer

from overrun_hitch.commands.options import TimeLimitOption, file_stem
from overrun_hitch.parameters import FIGURES, HitchError, named


def crosscheck(
    fmus: Annotated[
        list[Path], typer.Argument(metavar="FMU", help="Two FMUs or more; the first, A, is the reference.")
    ],
    figure: Annotated[
        list[str] | None, typer.Option(help=f"Step brake of this figure; may be repeated (all: {', '.join(FIGURES)}).")
    ] = None,
    tolerance: Annotated[float, typer.Option(help="Relative tolerance of the integrators.")] = 1e-6,
    step: Annotated[float, typer.Option(help="Communication step in s.")] = 0.01,
    funnel: Annotated[float, typer.Option(help="Allowed distance, relative to a variable's range in A.")] = 1e-3,
    funnel_time: Annotated[float, typer.Option(help="Allowed shift in time, in s.")] = 1e-4,
    time_limit: TimeLimitOption = 60.0,
    json: Annotated[bool, typer.Option("--json", help="Print one JSON document instead of tables.")] = False,
    output: Annotated[Path, typer.Option(help="Folder for the files written.")] = Path("build/crosscheck"),
) -> int:
    """Run FMUs of the same model, other tools' exports say, through the paper's figures and compare with the first."""
    if len(fmus) < 2:
        raise HitchError(f"{fmus[0]} alone cannot be compared: two FMUs at least are needed, the reference first")
    scenarios = [named("figure", name, FIGURES) for name in dict.fromkeys(figure or FIGURES)]

    # Imported here, because fmpy, xarray and matplotlib would slow down `hitch --help` and wrong options.
    from overrun_hitch.comparison import crosscheck_figures, crosscheck_table
    from overrun_hitch.comparison.crosscheck import LABELS, Allowed, compare_units
    from overrun_hitch.fmu.guest_unit import guest_file
    from overrun_hitch.fmu.settings import Settings
    from overrun_hitch.show import files, terminal, traces

    if len(fmus) > len(LABELS):
        raise HitchError(f"{len(fmus)} FMUs are too many: {len(LABELS)} at most")
    settings = Settings(relative_tolerance=tolerance, communication_step=step)
    allowed = Allowed(funnel=funnel, funnel_time=funnel_time)
    checks = []
    contents: dict[Path, bytes] = {}  # written when all are there, so that an interrupted run leaves nothing
    with terminal.patience("Crosschecking"), ExitStack() as stack:
        units = [stack.enter_context(guest_file(fmu, time_limit)) for fmu in fmus]
        for scenario in scenarios:
            checks.append(compare_units(scenario, units, settings, allowed))
            picture = crosscheck_figures.draw(checks[-1], crosscheck_figures.names(fmus), allowed)
            for kind in traces.KINDS:
                contents[output / f"{file_stem(scenario.name)}.{kind}"] = traces.rendered(picture, kind)
    document = output / "crosscheck.json"
    paths = [*contents, document]
    text = files.json_text(crosscheck_table.document(checks, fmus, settings, allowed, paths))
    files.write({**contents, document: f"{text}\n".encode()})
    if json:
        print(text)
    else:
        crosscheck_table.show(checks, fmus, allowed, paths)
    return 1 if any(comparison.differing for check in checks for comparison in check.comparisons) else 0
