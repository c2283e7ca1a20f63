"""The command line `hitch`. Exit status: 0 agreement, 1 theory and simulation differ, 2 bad input, 130 interrupted."""

from __future__ import annotations

import re
import sys
from collections.abc import Sequence
from importlib.metadata import PackageNotFoundError
from importlib.metadata import version as installed_version
from pathlib import Path
from typing import Annotated, Any

import typer

from overrun_hitch.parameters import CASES, FIGURES, HitchError, Scenario, named

app = typer.Typer(
    help="Longitudinal oscillations of a car and its overrun-braked trailer (Sharp 1982).",
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit status; bad input costs one line on stderr."""
    try:
        status = app(args=arguments, prog_name="hitch", standalone_mode=False)
        sys.stdout.flush()
    except (HitchError, typer.TyperException) as error:
        message = error.format_message() if isinstance(error, typer.TyperException) else str(error)
        print(f"hitch: {' '.join(message.split())}", file=sys.stderr)
        return 2
    except (KeyboardInterrupt, typer.Abort):
        return 130
    return status if isinstance(status, int) else 0


def _show_version(wanted: bool) -> None:
    if wanted:
        try:
            print(f"hitch {installed_version('overrun_hitch')}")
        except PackageNotFoundError:
            print("hitch, not installed (run from its source)")
        raise typer.Exit


@app.callback(invoke_without_command=True)
def _hitch(
    context: typer.Context,
    version: Annotated[
        bool, typer.Option("--version", callback=_show_version, is_eager=True, help="Show the version.")
    ] = False,
) -> None:
    """Longitudinal oscillations of a car and its overrun-braked trailer (Sharp 1982)."""
    if context.invoked_subcommand is None:
        print(context.get_help())


@app.command()
def run(
    figure: Annotated[str | None, typer.Option(help=f"Step brake of the paper's figure: {', '.join(FIGURES)}.")] = None,
    case: Annotated[str | None, typer.Option(help=f"Figure 8 with the paper's case: {', '.join(CASES)}.")] = None,
    set_: Annotated[
        list[str] | None, typer.Option("--set", metavar="NAME=VALUE", help="Change a parameter (SI).")
    ] = None,
    duration: Annotated[float | None, typer.Option(help="Length of the run in s (6).")] = None,
    brake_torque: Annotated[float | None, typer.Option(help="Brake torque on the car's wheels in N.m (1000).")] = None,
    tolerance: Annotated[float, typer.Option(help="Relative tolerance of the integrator.")] = 1e-6,
    step: Annotated[float, typer.Option(help="Communication step in s.")] = 0.01,
    fmu: Annotated[Path | None, typer.Option(help="FMU file to run instead of our own.")] = None,
    output: Annotated[Path, typer.Option(help="Folder for the files written.")] = Path("build/run"),
) -> int:
    """Brake car and trailer by a step, compare with theory, draw the paper's traces and write them as CSV."""
    scenario = _scenario(figure, case, set_ or [], duration=duration, brake_torque=brake_torque)

    # Imported here, because fmpy, xarray and matplotlib would slow down `hitch --help` and wrong options.
    from overrun_hitch import figures, results, terminal
    from overrun_hitch.compare import compare
    from overrun_hitch.fmu import CAR_TRAILER, build, is_current
    from overrun_hitch.run import car_alone, step_brake

    if fmu is None and not is_current():
        with terminal.patience("Building the FMU from Modelica"):
            build()
    accuracy: dict[str, Any] = {"fmu": fmu or CAR_TRAILER, "relative_tolerance": tolerance, "communication_step": step}
    with terminal.patience("Braking"):
        result = step_brake(scenario, **accuracy)
        rows = compare(result, step_brake(car_alone(scenario), **accuracy))
    stem = output / re.sub(r"[ ,]+", "-", scenario.name)
    with terminal.patience("Drawing"):
        results.write_csv(result, stem.with_name(f"{stem.name}.csv"))
        paths = [stem.with_name(f"{stem.name}.csv"), *figures.write(result, stem)]
    terminal.show(scenario, result, rows, paths)
    return 1 if any(row.differs for row in rows) else 0


def _scenario(figure: str | None, case: str | None, changes: list[str], **settings: float | None) -> Scenario:
    """The scenario that the options ask for; figure 8 unless they say otherwise."""
    if figure is not None and case is not None:
        raise HitchError("--figure and --case exclude each other: a case is figure 8 with that case's parameters")
    scenario: Scenario = named("figure", "8" if figure is None else figure, FIGURES)
    if case is not None:
        scenario = scenario.changed(name=f"case {case}", parameters=named("case", case, CASES))
    pairs = [change.partition("=") for change in changes]
    for name, equals, _ in pairs:
        if not equals:
            raise HitchError(f"--set {name!r:.40} is not NAME=VALUE; for example --set C=200")
    parameters = {name.strip(): value.strip() for name, _, value in pairs}
    given = {name: value for name, value in settings.items() if value is not None}
    changed = scenario.changed(parameters=scenario.parameters.changed(parameters), **given)
    # The name says what was changed: what is drawn and written must not pass for the paper's figure.
    changes_made = {name: getattr(changed.parameters, name) for name in parameters} | given
    name = ", ".join([changed.name, *(f"{name}={value:g}" for name, value in changes_made.items())])
    return changed.changed(name=name)
