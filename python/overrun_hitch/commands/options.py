"""Options that commands share, and what they mean."""

from __future__ import annotations

import hashlib
import re
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from overrun_hitch.parameters import HitchError, Parameters
from overrun_hitch.toml_file import read_toml

if TYPE_CHECKING:
    from overrun_hitch.fmu.settings import Use

LONGEST_STEM = 120  # characters; file systems allow 255 bytes with suffix

SetOption = Annotated[list[str] | None, typer.Option("--set", metavar="NAME=VALUE", help="Change a parameter (SI).")]
ParametersOption = Annotated[
    Path | None,
    typer.Option("--parameters", metavar="FILE.toml", help="Change the parameters in this file (SI); --set wins."),
]
ProfileOption = Annotated[
    Path | None,
    typer.Option("--profile", metavar="FILE", help="Brake torque over time instead: columns time, brake_torque."),
]
TimeLimitOption = Annotated[float, typer.Option("--time-limit", help="Time in s that a run of an FMU may take.")]
MapOption = Annotated[
    Path | None, typer.Option("--map", metavar="FILE.toml", help="Names, signs and units in the FMU of --fmu.")
]
TypeOption = Annotated[
    str | None,
    typer.Option("--type", metavar="cs|me", help="Co-Simulation (where it is offered) or Model Exchange."),
]
FmuOption = Annotated[Path | None, typer.Option(help="FMU file to run instead of our own.")]


def assignments(changes: list[str] | None, option: str = "--set", example: str = "C=200") -> dict[str, str]:
    """Name to value of every --set, or of another option's NAME=VALUE; HitchError for what is none."""
    pairs = [change.partition("=") for change in changes or []]
    for name, equals, _ in pairs:
        if not equals:
            raise HitchError(f"{option} {name!r:.40} is not NAME=VALUE; for example {option} {example}")
    return {name.strip(): value.strip() for name, _, value in pairs}


def asked_changes(file: Path | None, changes: list[str] | None) -> dict[str, Any]:
    """Name to value of what --parameters and --set change; --set goes before. HitchError as for each."""
    return {**(parameters_of(file) if file else {}), **assignments(changes)}


def parameters_of(file: Path) -> dict[str, float]:
    """Name to value (SI) of the parameters in a TOML file, at its top or under [parameters].

    HitchError, naming the file, where it can't be read, is no TOML, or holds anything but parameters and numbers in
    their ranges.
    """
    table = read_toml(file)
    if "parameters" in table:
        outside = next((name for name in table if name != "parameters"), None)
        if outside is not None:
            raise HitchError(
                f"{file}: {outside!r:.40} stands outside [parameters]; allowed: all inside, or all outside"
            )
        table = table["parameters"]
        if not isinstance(table, dict):
            raise HitchError(f"{file}: parameters = {table!r:.40} is not allowed; a table [parameters] is")
    for name, value in table.items():
        if name in Parameters.model_fields and (isinstance(value, bool) or not isinstance(value, int | float)):
            allowed = f"{Parameters.description(name)} must be {Parameters.allowed(name)}"
            raise HitchError(f"{file}: {name} = {value!r:.40} is not allowed: {allowed}")
    try:
        checked = Parameters(**table)
    except HitchError as error:
        raise HitchError(f"{file}: {error}") from None
    return {name: float(getattr(checked, name)) for name in table}


def file_stem(name: str) -> str:
    """A file's name without suffix for what is called `name`; a long one is cut and told apart by its digest."""
    stem = re.sub(r"[ ,]+", "-", name)
    if len(stem) <= LONGEST_STEM:
        return stem
    return f"{stem[: LONGEST_STEM - 9]}-{hashlib.sha256(name.encode()).hexdigest()[:8]}"


def asked_use(text: str | None) -> Use | None:
    """What --type asks for. HitchError for anything but cs and me."""
    if text is not None and text not in ("cs", "me"):
        raise HitchError(f"--type {text!r:.40} is not allowed; allowed: cs (Co-Simulation) and me (Model Exchange)")
    return text  # type: ignore[return-value]


def chosen_fmu(fmu: Path | None) -> Path:
    """The FMU of the option, or our own CarTrailer.fmu."""
    from overrun_hitch.fmu.files import CAR_TRAILER

    return our_fmu(CAR_TRAILER) if fmu is None else fmu


def our_fmu(fmu: Path) -> Path:
    """One of our own, built first where it is missing or stale."""
    from overrun_hitch.fmu.files import build, is_current
    from overrun_hitch.show import terminal

    if not is_current(fmu):
        with terminal.patience(f"Building {fmu.name} from Modelica"):
            build(fmu)
    return fmu
