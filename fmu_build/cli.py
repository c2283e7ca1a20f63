"""Command line: ``python -m fmu_build MODELICA CLASS``, with ``-o OUT.fmu`` or ``--show STAGE``.

Exit status: 0, 2 bad input or no place for output, 130 interrupted, 141 nobody reads the output any more.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Literal, TextIO

import typer

app = typer.Typer(add_completion=False, pretty_exceptions_enable=False, rich_markup_mode=None)


@app.command()
def build_fmu(
    modelica: Annotated[Path, typer.Argument(help="A Modelica file, or a library's folder.", metavar="MODELICA")],
    class_name: Annotated[str, typer.Argument(help="The class to build, with its full name.", metavar="CLASS")],
    output: Annotated[Path | None, typer.Option("--output", "-o", help="The FMU to write.", metavar="OUT.fmu")] = None,
    stage: Annotated[
        Literal["flat", "sorted", "jacobian", "c"] | None,
        typer.Option("--show", help="Print what this stage makes of the class, in place of an FMU.", metavar="STAGE"),
    ] = None,
    fmi: Annotated[int, typer.Option(help="Version of the standard.", min=2, max=3)] = 2,
    platforms: Annotated[
        str,
        typer.Option(
            help="host, all systems, wasm (WebAssembly), or names with commas between them.",
            metavar="host|all|wasm|NAME,NAME",
        ),
    ] = "host",
    libraries: Annotated[
        list[Path] | None,
        typer.Option(
            "--library", help="A library's folder, or one with libraries in it; may be repeated.", metavar="DIR"
        ),
    ] = None,
    verbose: Annotated[bool, typer.Option("--verbose", help="Show each stage and its time.")] = False,
) -> None:
    """Build an FMU from Modelica, for this machine or for others."""
    from .errors import BuildError
    from .rebuild import rebuild

    if stage is not None and output is None:
        from .pipeline import show

        typer.echo(show(modelica, class_name, stage, libraries or ()), nl=False)
        return
    if output is None or stage is not None:
        raise BuildError("name either the FMU to write (-o OUT.fmu) or a stage to look at (--show STAGE)")
    names = [name.strip() for name in platforms.split(",") if name.strip()]
    with _progress(shown=names != ["host"], verbose=verbose) as progress:
        rebuild(modelica, class_name, output, fmi, names, progress, libraries=libraries or ())
    typer.echo(output)


@contextmanager
def _progress(*, shown: bool, verbose: bool) -> Iterator[Callable[[str], object]]:
    """What to call with each stage: lines with times if asked for, else a line that changes, in a terminal alone."""
    from rich.console import Console

    console = Console(stderr=True, highlight=False)
    if verbose:
        with _timed() as begin:
            yield begin
    elif shown and console.is_terminal:
        with console.status("") as status:
            yield lambda stage: status.update(f"{stage} (the first time for a system takes minutes)")
    elif shown:
        yield lambda stage: _say(stage) if stage.startswith("compiling") else None
    else:
        yield lambda _: None


@contextmanager
def _timed() -> Iterator[Callable[[str], object]]:
    """What to call with each stage; its line gets its time when it ends."""
    start = begun = time.perf_counter()
    stage = ""

    def end() -> None:
        if stage:
            print(f"{time.perf_counter() - begun:8.2f} s", file=sys.stderr, flush=True)

    def begin(name: str) -> None:
        nonlocal begun, stage
        end()
        begun, stage = time.perf_counter(), name
        print(f"fmu_build: {name:<30}", end="", file=sys.stderr, flush=True)

    try:
        yield begin
    finally:
        end()
    _say(f"{'in all':<30}{time.perf_counter() - start:8.2f} s")


def _say(text: str) -> None:
    print(f"fmu_build: {text}", file=sys.stderr, flush=True)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit status; what fails costs one line on stderr."""
    from .errors import BuildError

    try:
        status = app(args=arguments, prog_name="fmu_build", standalone_mode=False)
        print(end="", flush=True)  # which knows that there may be no standard output at all
    except (BuildError, typer.TyperException) as error:
        message = error.format_message() if isinstance(error, typer.TyperException) else str(error)
    except (BrokenPipeError, SystemExit):  # the latter is what typer makes of the former
        _arrives("", sys.stdout)
        return 141  # as a shell tells of a tool that SIGPIPE has ended
    except OSError as error:
        place = error.filename or (None if _arrives("", sys.stdout) else "standard output")
        message = ": ".join(filter(None, [place, error.strerror or str(error)]))
    except (KeyboardInterrupt, typer.Abort):
        return 130
    else:
        return status if isinstance(status, int) else 0  # typer returns the status of what it stops itself
    _arrives(f"fmu_build: {' '.join(message.split())}", sys.stderr)
    return 2


def _arrives(line: str, stream: TextIO) -> bool:
    """Print, and say whether it arrives. Where it does not, the rest is dropped: Python would try again at its end."""
    try:
        print(line, file=stream, flush=True)
    except OSError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
        return False
    return True
