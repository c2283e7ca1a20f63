"""`hitch run`: a step brake against linear theory."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from overrun_hitch.arguments import check_one_torque
from overrun_hitch.commands.hints import hint
from overrun_hitch.commands.options import (
    FmuOption,
    MapOption,
    ParametersOption,
    ProfileOption,
    SetOption,
    TimeLimitOption,
    TypeOption,
    asked_changes,
    asked_use,
    chosen_fmu,
    file_stem,
)
from overrun_hitch.parameters import CASES, FIGURES
from overrun_hitch.scenarios import asked_scenario
from overrun_hitch.show.words import printable

if TYPE_CHECKING:
    from overrun_hitch.experiments.torque import Torque


def run(
    figure: Annotated[str | None, typer.Option(help=f"Step brake of the paper's figure: {', '.join(FIGURES)}.")] = None,
    case: Annotated[str | None, typer.Option(help=f"Figure 8 with the paper's case: {', '.join(CASES)}.")] = None,
    set_: SetOption = None,
    parameters: ParametersOption = None,
    duration: Annotated[float | None, typer.Option(help="Length of the run in s (6).")] = None,
    brake_torque: Annotated[float | None, typer.Option(help="Brake torque on the car's wheels in N.m (1000).")] = None,
    profile: ProfileOption = None,
    grade: Annotated[float, typer.Option(help="Rise of the road over its run, positive uphill.")] = 0.0,
    tolerance: Annotated[float, typer.Option(help="Relative tolerance of the integrator.")] = 1e-6,
    step: Annotated[float, typer.Option(help="Communication step in s.")] = 0.01,
    fmu: FmuOption = None,
    map_: MapOption = None,
    type_: TypeOption = None,
    time_limit: TimeLimitOption = 60.0,
    output: Annotated[Path, typer.Option(help="Folder for the files written.")] = Path("build/run"),
) -> int:
    """Brake car and trailer by a step, compare with theory, draw the paper's traces and write them as CSV."""
    changes = asked_changes(parameters, set_)
    check_one_torque(profile, brake_torque)
    scenario = asked_scenario(figure, case, changes, duration=duration, brake_torque=brake_torque)
    if profile:  # what is drawn and written must not pass for the paper's
        scenario = scenario.changed(name=f"{scenario.name}, profile {profile.stem}")
    if grade:
        scenario = scenario.changed(name=f"{scenario.name}, grade={grade:g}")

    # Imported here, because fmpy, xarray and matplotlib would slow down `hitch --help` and wrong options.
    from overrun_hitch.fmu.guest_unit import guest_file
    from overrun_hitch.fmu.settings import Settings
    from overrun_hitch.foreign.mapping import NO_NAMES, read_mapping

    settings = Settings(relative_tolerance=tolerance, communication_step=step)
    names, use = read_mapping(map_) if map_ else NO_NAMES, asked_use(type_)
    with guest_file(chosen_fmu(fmu), time_limit, names, use) as unit:  # which gets ready while the rest is imported
        from overrun_hitch import results
        from overrun_hitch.comparison import theory_table
        from overrun_hitch.comparison.theory import compare
        from overrun_hitch.experiments.step_brake import brake, car_alone
        from overrun_hitch.show import files, terminal, traces

        with terminal.patience("Braking"):
            given: dict[str, Any] = {"torque": _torque(profile), "grade": grade}
            result = brake(unit, scenario, settings, **given)
            rows = compare(result, brake(unit, car_alone(scenario), settings, **given))
            guessed = unit.identity.notes
    hint(scenario.parameters, scenario.brake_torque)
    for note in guessed:
        print(f"hint: {printable(f'{unit.name} {note}')}", file=sys.stderr)
    stem = output / file_stem(scenario.name)
    table = stem.with_name(f"{stem.name}.csv")
    with terminal.patience("Drawing"):
        files.write_csv(table, results.columns(result))
        paths = [table, *traces.write(result, stem)]
    theory_table.show(scenario, result, rows, paths)
    return 1 if any(row.differs for row in rows) else 0


def _torque(profile: Path | None) -> Torque | None:
    if profile is None:
        return None
    from overrun_hitch.comparison.sources import read_profile  # which interpolates, by SciPy

    return read_profile(profile)
