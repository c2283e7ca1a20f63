"""`hitch fit`: a drawbar's parameters from what was measured on it."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from overrun_hitch.commands.options import (
    ParametersOption,
    SetOption,
    asked_changes,
    assignments,
    file_stem,
    our_fmu,
)
from overrun_hitch.parameters import DATUM, HitchError

COLUMNS = {
    "time": "time", "compression": "compression", "force": "F_hitch", "speed": "v_rel",
    "torque": "trailer_brake_torque",
}  # fmt: skip


def fit(
    trace: Annotated[Path, typer.Argument(metavar="TRACE", help="Measured columns: CSV, MAT, Parquet or MDF.")],
    time: Annotated[str | None, typer.Option(metavar="COLUMN", help="Time (time).")] = None,
    compression: Annotated[
        str | None, typer.Option(metavar="COLUMN", help="Travel, positive pushed in (compression).")
    ] = None,
    force: Annotated[
        str | None, typer.Option(metavar="COLUMN", help="Hitch force, positive pushing (F_hitch).")
    ] = None,
    speed: Annotated[
        str | None, typer.Option(metavar="COLUMN", help="Rate of compression (v_rel, or from the travel).")
    ] = None,
    torque: Annotated[
        str | None,
        typer.Option(metavar="COLUMN", help="Trailer's brake torque (trailer_brake_torque); r and tau_b need it."),
    ] = None,
    unit: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME=UNIT", help="Unit of time, compression, force, speed or torque: force=kN."),
    ] = None,
    names: Annotated[
        str | None, typer.Option("--fit", metavar="NAMES", help="Parameters to fit: k,C,F_f (what the columns tell).")
    ] = None,
    set_: SetOption = None,
    parameters: ParametersOption = None,
    json: Annotated[bool, typer.Option("--json", help="Print one JSON document instead of a table.")] = False,
    output: Annotated[Path, typer.Option(help="Folder for the files written.")] = Path("build/fit"),
) -> int:
    """A drawbar's parameters from measured force, travel, speed and brake torque, with standard errors.

    Says what the data cannot tell. What is not fitted is as in figure 8, or as --set and --parameters say.
    """
    base = DATUM.changed(asked_changes(parameters, set_))
    columns = {"time": time, "compression": compression, "force": force, "speed": speed, "torque": torque}
    given = {COLUMNS[option]: column for option, column in columns.items() if column is not None}
    units = {_variable(option): text for option, text in assignments(unit, "--unit", "force=kN").items()}

    # Imported here, because fmpy, pandas and SciPy would slow down `hitch --help` and wrong options.
    from overrun_hitch.fitting import figure, table
    from overrun_hitch.fitting.columns import read_trace
    from overrun_hitch.fitting.estimates import default_names
    from overrun_hitch.fitting.fit import check_names
    from overrun_hitch.fitting.fit import fit as search
    from overrun_hitch.fmu.files import BENCH
    from overrun_hitch.show import files, terminal, traces

    measured, guesses = read_trace(trace, given, units)
    has_torque = measured.trailer_brake_torque is not None
    wanted = default_names(base, has_torque) if names is None else [part.strip() for part in names.split(",")]
    check_names(wanted, has_torque)
    bench = our_fmu(BENCH)
    with terminal.patience("Fitting"):
        found = search(measured, base, wanted, bench)
    if not has_torque:
        guesses.append("no brake torque was measured: r and tau_b are not fitted")
    stem = output / file_stem(trace.stem)
    paths = [stem.with_name(f"{stem.name}.{kind}") for kind in ("csv", "toml", "png", "svg")]
    with terminal.patience("Drawing"):
        files.write_csv(paths[0], table.csv_columns(found))
        files.write({paths[1]: table.toml(found)})
        traces.save(figure.draw(trace.name, found), stem)
    if json:
        print(files.json_text(table.document(trace.name, found, guesses, paths)))
    else:
        table.show(trace.name, found, guesses, paths)
    return 0


def _variable(option: str) -> str:
    if option not in COLUMNS:
        raise HitchError(f"--unit {option!r:.40} is no column; allowed: {', '.join(COLUMNS)}")
    return COLUMNS[option]
