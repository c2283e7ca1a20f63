"""`hitch stability`: the shunting mode by linear theory, for any parameters."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from overrun_hitch.commands.hints import hint
from overrun_hitch.commands.numbers import evenly, numbers
from overrun_hitch.commands.options import ParametersOption, SetOption, asked_changes, file_stem
from overrun_hitch.parameters import CASES, DATUM, Parameters, named
from overrun_hitch.scenarios import name_with

DAMPERS = "0:3200"  # N.s/m, the paper's range
SPEED = 20.0  # m/s, at which the paper draws its root loci
SPEEDS = 4  # values of a range of V: 10:40, the range of the paper, gives 10, 20, 30, 40


def stability(
    case: Annotated[str | None, typer.Option(help=f"The paper's case: {', '.join(CASES)} (else its datum).")] = None,
    set_: SetOption = None,
    parameters: ParametersOption = None,
    C: Annotated[
        str | None, typer.Option("--C", metavar="N.s/m", help=f"Damper: 200; 50,100,200; A:B; A:B:N ({DAMPERS}).")
    ] = None,
    V: Annotated[
        str | None, typer.Option("--V", metavar="m/s", help=f"Speed: 20; 10,20,40; A:B; A:B:N ({SPEED:g}).")
    ] = None,
    deceleration: Annotated[
        float, typer.Option(metavar="m/s2", help="Steady braking about which to look (0: gentle).")
    ] = 0.0,
    json: Annotated[bool, typer.Option("--json", help="Print one JSON document instead of tables.")] = False,
    output: Annotated[Path, typer.Option(help="Folder for the files written.")] = Path("build/stability"),
) -> int:
    """Growth, frequency and shape of the shunting mode over damper and speed, the stability boundary, the root locus.

    Where --C or --V is not given, a C or V_0 of --parameters or --set is looked at as well, or instead of 20 m/s.
    """
    start = DATUM if case is None else named("case", case, CASES)
    changes = asked_changes(parameters, set_)
    changed = start.changed(changes)
    dampers, speeds = asked_values(changed, changes, C, V)
    without = start.changed({"C": changed.C, "V_0": changed.V_0})  # they are no part of the name
    others = {"deceleration": deceleration} if deceleration else {}  # no part of the parameters, but of the name
    name = name_with("datum" if case is None else f"case {case}", without, changed, others)

    # Imported here, because SciPy, xarray and matplotlib would slow down `hitch --help` and wrong options.
    from overrun_hitch.modes import figure as stability_figure
    from overrun_hitch.modes import table as stability_table
    from overrun_hitch.modes.study import csv_columns, document
    from overrun_hitch.modes.study import stability as analyse
    from overrun_hitch.show import files, terminal, traces

    with terminal.patience("Solving for the modes"):
        result = analyse(name, changed, dampers, speeds, deceleration)
    hint(changed.changed({"V_0": max(speeds)}))
    stem = output / file_stem(name)
    paths = [stem.with_name(f"{stem.name}.{kind}") for kind in ("csv", "png", "svg")]
    with terminal.patience("Drawing"):
        figure = stability_figure.draw(result)
        files.write_csv(paths[0], csv_columns(result))
        traces.save(figure, stem)
    if json:
        print(files.json_text(document(result, paths)))
    else:
        stability_table.show(result, paths)
    return 0


def asked_values(
    parameters: Parameters, changes: Mapping[str, Any], C: str | None, V: str | None
) -> tuple[list[float], list[float]]:
    """Dampers (N.s/m) and speeds (m/s) to look at."""
    dampers = numbers("--C", DAMPERS if C is None else C, doubling)
    if C is None and "C" in changes:
        dampers = sorted({*dampers, parameters.C})
    if V is not None:
        return dampers, numbers("--V", V, lambda low, high: evenly(low, high, SPEEDS))
    return dampers, [parameters.V_0 if "V_0" in changes else SPEED]


def doubling(low: float, high: float) -> list[float]:
    """0, 50, 100, 200, ... between `low` and `high`, both included: each step moves a root locus about as far again."""
    series = [0.0, *(50.0 * 2.0**n for n in range(1000))]
    return [low, *(value for value in series if low < value < high), high]
