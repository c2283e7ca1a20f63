"""Command line: ``python -m fmu_build MODELICA CLASS -o OUT.fmu``. Exit status: 0, 2 bad input, 130 interrupted."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer

app = typer.Typer(add_completion=False, pretty_exceptions_enable=False, rich_markup_mode=None)


@app.command()
def build_fmu(
    modelica: Annotated[Path, typer.Argument(help="A Modelica file, or a library's folder.", metavar="MODELICA")],
    class_name: Annotated[str, typer.Argument(help="The class to build, with its full name.", metavar="CLASS")],
    output: Annotated[Path, typer.Option("--output", "-o", help="The FMU to write.", metavar="OUT.fmu")],
    fmi: Annotated[int, typer.Option(help="Version of the standard.", min=2, max=3)] = 2,
    platforms: Annotated[
        str, typer.Option(help="host, all, or names with commas between them.", metavar="host|all|NAME,NAME")
    ] = "host",
) -> None:
    """Build an FMU from Modelica, for this machine or for others."""
    from .pipeline import build  # here, because sympy would slow down --help and wrong options

    names = [name.strip() for name in platforms.split(",") if name.strip()]
    with _progress(shown=names != ["host"]) as progress:
        build(modelica, class_name, output, fmi, names, progress)
    typer.echo(output)


@contextmanager
def _progress(*, shown: bool) -> Iterator[Callable[[str], object]]:
    """What to call with each thing that takes time: a line that changes in a terminal, lines elsewhere."""
    from rich.console import Console

    console = Console(stderr=True, highlight=False)
    if not shown:
        yield lambda _: None
    elif not console.is_terminal:
        yield lambda text: print(f"fmu_build: {text}", file=sys.stderr, flush=True)
    else:
        with console.status("reading Modelica") as status:
            yield lambda text: status.update(f"{text} (minutes, the first time)")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit status; what fails costs one line on stderr."""
    from .errors import BuildError

    try:
        status = app(args=arguments, prog_name="fmu_build", standalone_mode=False)
    except (BuildError, typer.TyperException) as error:
        message = error.format_message() if isinstance(error, typer.TyperException) else str(error)
    except OSError as error:
        message = f"{error.filename or 'a file'}: {error.strerror or error}"
    except (KeyboardInterrupt, typer.Abort):
        return 130
    else:
        return status if isinstance(status, int) else 0  # typer returns the status of what it stops itself
    print(f"fmu_build: {' '.join(message.split())}", file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main())
