"""Options that commands share, and what they mean."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from overrun_hitch.parameters import HitchError

SetOption = Annotated[list[str] | None, typer.Option("--set", metavar="NAME=VALUE", help="Change a parameter (SI).")]
FmuOption = Annotated[Path | None, typer.Option(help="FMU file to run instead of our own.")]


def assignments(changes: list[str] | None) -> dict[str, str]:
    """Name to value of every --set; HitchError for what is none."""
    pairs = [change.partition("=") for change in changes or []]
    for name, equals, _ in pairs:
        if not equals:
            raise HitchError(f"--set {name!r:.40} is not NAME=VALUE; for example --set C=200")
    return {name.strip(): value.strip() for name, _, value in pairs}


def chosen_fmu(fmu: Path | None) -> Path:
    """The FMU of the option, or our own, built first where it is missing or stale."""
    from overrun_hitch import terminal
    from overrun_hitch.fmu import CAR_TRAILER, build, is_current

    if fmu is None and not is_current():
        with terminal.patience("Building the FMU from Modelica"):
            build()
    return fmu or CAR_TRAILER
