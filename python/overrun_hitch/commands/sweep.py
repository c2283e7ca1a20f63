"""`hitch sweep`: many runs, on all cores or a cluster."""

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
    assignments,
    chosen_fmu,
    file_stem,
    parameters_of,
)
from overrun_hitch.parameters import DATUM, HitchError

RepairOption = Annotated[bool, typer.Option("--repair", help="Run again exactly what is damaged in the store.")]


def sweep(
    spec: Annotated[Path, typer.Argument(metavar="SPEC.toml", help="What to run: see docs/sweep.md.")],
    set_: SetOption = None,
    parameters: ParametersOption = None,
    scheduler: SchedulerOption = None,
    tls_ca_file: CaFileOption = None,
    tls_cert: CertOption = None,
    tls_key: KeyOption = None,
    workers: WorkersOption = None,
    repair: RepairOption = False,
    map_: Annotated[
        list[str] | None,
        typer.Option("--map", metavar="METRIC", help="Draw this metric over the two axes of the grid."),
    ] = None,
    fmu: FmuOption = None,
    time_limit: TimeLimitOption = 60.0,
    output: Annotated[Path, typer.Option(help="Folder for the files written.")] = Path("build/sweep"),
) -> int:
    """Run every combination that SPEC.toml asks for and write metrics, on request trajectories, as a Zarr store.

    The same command goes on with a sweep that was interrupted. What SPEC.toml varies stays so, whatever --parameters
    has of it.
    """
    # Imported here, because Dask and xarray would slow down `hitch --help` and wrong options.
    from overrun_hitch.show import terminal, traces
    from overrun_hitch.sweeps import map as sweep_figures
    from overrun_hitch.sweeps import table as sweep_table
    from overrun_hitch.sweeps.engine import run_plan
    from overrun_hitch.sweeps.planner import planned
    from overrun_hitch.sweeps.spec import read_spec

    asked = read_spec(spec)
    same = {name: value for name, value in (parameters_of(parameters) if parameters else {}).items()
            if name not in asked.varied}  # fmt: skip
    single = assignments(set_)
    checked = DATUM.changed(single)
    asked = asked.changed({**same, **{name: getattr(checked, name) for name in single}})
    if asked.fmus and fmu:
        raise HitchError(f"--fmu and the fmus of {spec} exclude each other")
    fmus = [Path(path) for path in asked.fmus] or [chosen_fmu(fmu)]
    plan = planned(asked, fmus)
    for metric in map_ or ():
        sweep_figures.check_map(plan, metric)
    hint_sweep(plan)
    stem = output / file_stem(asked.name)
    store = stem.with_name(f"{stem.name}.zarr")
    with access(scheduler, tls_ca_file, tls_cert, tls_key), terminal.counting("Running") as told:
        result = run_plan(
            plan, store, scheduler=scheduler, workers=workers, repair=repair, time_limit=time_limit, progress=told
        )
    paths = [store]
    for metric in map_ or ():
        paths += traces.save(sweep_figures.draw_map(result, metric), stem.with_name(f"{stem.name}-{metric}"))
    sweep_table.show(asked.name, result, paths)
    return 1 if sweep_table.failures(result) else 0
