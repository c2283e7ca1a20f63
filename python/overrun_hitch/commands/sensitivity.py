"""`hitch sensitivity`: which parameters damping and jerk depend on."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from overrun_hitch.commands.cluster import (
    CaFileOption,
    CertOption,
    KeyOption,
    SchedulerOption,
    WorkersOption,
    access,
)
from overrun_hitch.commands.hints import hint_sweep
from overrun_hitch.commands.options import (
    FmuOption,
    ParametersOption,
    SetOption,
    TimeLimitOption,
    asked_changes,
    chosen_fmu,
    file_stem,
)
from overrun_hitch.commands.sweep import RepairOption
from overrun_hitch.parameters import CASES, DATUM, named
from overrun_hitch.scenarios import name_with


def sensitivity(
    case: Annotated[str | None, typer.Option(help=f"The paper's case: {', '.join(CASES)} (else figure 8).")] = None,
    set_: SetOption = None,
    parameters: ParametersOption = None,
    spread: Annotated[float, typer.Option(help="Share by which each parameter varies to either side.")] = 0.2,
    samples: Annotated[int, typer.Option(help="A power of two; runs = samples x (parameters + 2).")] = 256,
    step: Annotated[float, typer.Option(help="Communication step in s.")] = 0.05,
    scheduler: SchedulerOption = None,
    tls_ca_file: CaFileOption = None,
    tls_cert: CertOption = None,
    tls_key: KeyOption = None,
    workers: WorkersOption = None,
    repair: RepairOption = False,
    fmu: FmuOption = None,
    time_limit: TimeLimitOption = 60.0,
    output: Annotated[Path, typer.Option(help="Folder for the files written.")] = Path("build/sensitivity"),
) -> int:
    """Sobol indices of damping and of peak jerk for every parameter, from step brakes of 6 s on the FMU."""
    start = DATUM if case is None else named("case", case, CASES)
    base = start.changed(asked_changes(parameters, set_))

    # Imported here, because Dask, SALib and xarray would slow down `hitch --help` and wrong options.
    from overrun_hitch.design import sensitivity_figure, sensitivity_table
    from overrun_hitch.design.sensitivity import Variation, analysed, plan_variation
    from overrun_hitch.show import terminal, traces
    from overrun_hitch.sweeps.engine import run_plan

    variation = Variation(spread=spread, samples=samples)
    changed = name_with("figure 8" if case is None else f"case {case}", start, base)
    name = f"{changed}, spread={spread:g}, samples={samples}, step={step:g}"
    plan = plan_variation(base, variation, chosen_fmu(fmu), "sensitivity", communication_step=step)
    hint_sweep(plan)
    stem = output / file_stem(name)
    store = stem.with_name(f"{stem.name}.zarr")
    with access(scheduler, tls_ca_file, tls_cert, tls_key), terminal.counting("Running") as told:
        sweep = run_plan(
            plan, store, scheduler=scheduler, workers=workers, repair=repair, time_limit=time_limit, progress=told
        )
    with terminal.patience("Analysing"):
        found = analysed(sweep, base, variation)
    title = f"{changed[:1].upper()}{changed[1:]}: every parameter by {spread:.0%} to either side"
    paths = traces.save(sensitivity_figure.draw(found, title), stem)
    sensitivity_table.show(title, found, [store, *paths])
    return 0
