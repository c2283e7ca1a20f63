"""`hitch report`: one page that shows what was recomputed of the paper, and what lies beyond it."""

from __future__ import annotations

import shlex
from pathlib import Path
from typing import Annotated

import typer

from overrun_hitch.commands.options import FmuOption, TimeLimitOption, chosen_fmu

FOLDER = Path("build/report")


def report(
    fmu: FmuOption = None,
    time_limit: TimeLimitOption = 60.0,
    output: Annotated[Path, typer.Option(help="Folder for index.html.")] = FOLDER,
) -> int:
    """Write index.html: the paper's figures and claims, both linearisations, the boundary, limit cycles, a conclusion.

    The exit status is 1 if a claim, or one of the page's own findings, does not hold.
    """
    # Imported here, because fmpy, xarray and matplotlib would slow down `hitch --help` and wrong options.
    from overrun_hitch.paper.report.page import COMMAND, page, report_of, show
    from overrun_hitch.paper.study import study
    from overrun_hitch.show import files, terminal

    unit = chosen_fmu(fmu)
    path = output / "index.html"
    with terminal.patience("Recomputing the paper") as say:
        found = report_of(study.study(unit, say, time_limit), _with_options(COMMAND, fmu, output), say)
        content = page(found).encode()
    files.write({path: content})
    show(found, path)
    return 0 if found.holds else 1


def _with_options(command: str, fmu: Path | None, output: Path) -> str:
    """What to type for the same page."""
    options = [] if fmu is None else ["--fmu", str(fmu)]
    if output != FOLDER:
        options += ["--output", str(output)]
    return shlex.join([*command.split(), *options])
