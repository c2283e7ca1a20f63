"""`hitch reference`: our own trajectories, for others to check against without installing anything."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from overrun_hitch.commands.options import FmuOption, TimeLimitOption, chosen_fmu

MAPPING = "names.toml"
INDEX = "reference.json"


def reference(
    fmu: FmuOption = None,
    time_limit: TimeLimitOption = 60.0,
    json: Annotated[bool, typer.Option("--json", help="Print one JSON document instead of a table.")] = False,
    output: Annotated[Path, typer.Option(help="Folder for the files written.")] = Path("build/reference"),
) -> int:
    """Write the trajectories of the paper's figures, of stops and of other devices, each by two solvers that agree.

    As CSV, with the parameters, a mapping of names, and inside copies of the FMUs (FMI-LS-REF).
    """
    # Imported here, because fmpy, xarray and pandas would slow down `hitch --help` and wrong options.
    from overrun_hitch import results
    from overrun_hitch.fmu.files import siblings
    from overrun_hitch.reference import table
    from overrun_hitch.reference.cases import REFERENCES
    from overrun_hitch.reference.layered_standard import with_references
    from overrun_hitch.reference.trajectories import trajectory
    from overrun_hitch.show import files, terminal

    ours = chosen_fmu(fmu)
    with terminal.patience("Computing") as tell:
        found = {}
        for name, scenario in REFERENCES.items():
            tell(f"Computing {name}")
            found[name] = trajectory(ours, scenario, time_limit)
    units = {output / one.parent.name / one.name: with_references(one, found) for one in siblings(ours)}
    contents = {output / f"{name}.toml": table.parameters(one) for name, one in found.items()}
    contents |= {output / MAPPING: table.mapping(), **units}
    tables = {output / f"{name}.csv": results.columns(one.run) for name, one in found.items()}
    paths = [*tables, *contents, output / INDEX]
    text = files.json_text(table.document(ours, found, paths))
    for path, columns in tables.items():
        files.write_csv(path, columns)
    files.write({**contents, output / INDEX: f"{text}\n".encode()})
    if json:
        print(text)
    else:
        table.show(found, paths)
    return 1 if any(one.differing for one in found.values()) else 0
