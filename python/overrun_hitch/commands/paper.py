"""`hitch paper`: every figure and every claim of the paper, recomputed."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from overrun_hitch.commands.options import FmuOption, TimeLimitOption, chosen_fmu


def paper(
    fmu: FmuOption = None,
    time_limit: TimeLimitOption = 60.0,
    json: Annotated[bool, typer.Option("--json", help="Print one JSON document instead of tables.")] = False,
    output: Annotated[Path, typer.Option(help="Folder for the figures written.")] = Path("build/paper"),
) -> int:
    """Recompute all figures and claims of the paper, in theory and on the FMU, and judge each claim.

    The exit status is 1 if a claim does not hold.
    """
    # Imported here, because fmpy, xarray and matplotlib would slow down `hitch --help` and wrong options.
    from overrun_hitch.paper.claims import table as claims_table
    from overrun_hitch.paper.claims.all import all_claims
    from overrun_hitch.paper.figures.all import figures, stem
    from overrun_hitch.paper.study import study
    from overrun_hitch.show import files, terminal
    from overrun_hitch.show.traces import KINDS, rendered

    unit = chosen_fmu(fmu)
    with terminal.patience("Recomputing the paper") as say:
        computed = study.study(unit, say, time_limit)
        claims = all_claims(computed)
        contents = {  # written when all are there, so that an interrupted run leaves nothing
            output / f"{stem(name)}.{kind}": rendered(figure, kind)
            for name, figure in figures(computed, say).items()
            for kind in KINDS
        }
    paths = files.write(contents)
    if json:
        print(files.json_text(claims_table.document(computed, claims, paths)))
    else:
        claims_table.show(claims, paths)
    return 0 if all(claim.verdict == "holds" for claim in claims) else 1
