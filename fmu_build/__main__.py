"""Command line: ``python -m fmu_build MODELICA CLASS -o OUT.fmu``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .errors import BuildError
from .pipeline import build


def main(
    modelica: Annotated[Path, typer.Argument(help="A Modelica file, or a library's folder.", metavar="MODELICA")],
    class_name: Annotated[str, typer.Argument(help="The class to build, with its full name.", metavar="CLASS")],
    output: Annotated[Path, typer.Option("--output", "-o", help="The FMU to write.", metavar="OUT.fmu")],
    fmi: Annotated[int, typer.Option(help="Version of the standard.", min=2, max=2)] = 2,
) -> None:
    """Build an FMU (FMI 2.0, Co-Simulation) from Modelica, for the machine this runs on."""
    del fmi  # one version for now; the option keeps its place on the command line
    try:
        build(modelica, class_name, output)
    except BuildError as error:
        typer.echo(f"fmu_build: {error}", err=True)
        raise typer.Exit(2) from None
    except OSError as error:
        typer.echo(f"fmu_build: {error.filename or output}: {error.strerror or error}", err=True)
        raise typer.Exit(2) from None
    typer.echo(output)


if __name__ == "__main__":
    typer.run(main)
