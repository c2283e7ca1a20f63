"""The command line `hitch`.

Exit status: 0 agreement, 1 what is compared differs, 2 bad input or no place for output, 70 a fault of ours, 130
interrupted, 141 nobody reads the output any more.
"""

from __future__ import annotations

import os
import sys
import traceback
from collections.abc import Sequence
from importlib.metadata import PackageNotFoundError
from importlib.metadata import version as installed_version
from typing import Annotated, TextIO

import typer

from overrun_hitch.commands.cases import cases
from overrun_hitch.commands.couple import couple
from overrun_hitch.commands.crosscheck import crosscheck
from overrun_hitch.commands.fit import fit
from overrun_hitch.commands.live import live
from overrun_hitch.commands.optimise import optimise
from overrun_hitch.commands.paper import paper
from overrun_hitch.commands.parameters import parameters
from overrun_hitch.commands.reference import reference
from overrun_hitch.commands.report import report
from overrun_hitch.commands.run import run
from overrun_hitch.commands.sensitivity import sensitivity
from overrun_hitch.commands.stability import stability
from overrun_hitch.commands.sweep import sweep
from overrun_hitch.extras import what_is_missing_told
from overrun_hitch.parameters import HitchError
from overrun_hitch.show.words import printable

app = typer.Typer(
    help="Longitudinal oscillations of a car and its overrun-braked trailer (Sharp 1982).",
    context_settings={"help_option_names": ["-h", "--help"]},
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit status; bad input costs one line on stderr."""
    try:
        with what_is_missing_told():
            status = app(args=arguments, prog_name="hitch", standalone_mode=False)
        print(end="", flush=True)  # which knows that there may be no standard output at all
    except (HitchError, typer.TyperException) as error:
        message = error.format_message() if isinstance(error, typer.TyperException) else str(error)
    except (BrokenPipeError, SystemExit):  # the latter is what typer makes of the former
        _arrives("", sys.stdout)
        return 141  # as a shell tells of a tool that SIGPIPE has ended
    except OSError as error:
        place = error.filename or (None if _arrives("", sys.stdout) else "standard output")
        message = ": ".join(filter(None, [place, error.strerror or str(error)]))
    except (KeyboardInterrupt, typer.Abort):
        return 130
    except Exception:  # Python's own status for it, 1, would say that something differs
        traceback.print_exc()
        return 70  # EX_SOFTWARE of sysexits.h
    else:
        return status if isinstance(status, int) else 0
    _arrives(f"hitch: {printable(' '.join(message.split()))}", sys.stderr)
    return 2


def _arrives(line: str, stream: TextIO) -> bool:
    """Print, and say whether it arrives. Where it does not, the rest is dropped: Python would try again at its end."""
    try:
        print(line, file=stream, flush=True)
    except OSError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
        return False
    return True


def _show_version(wanted: bool) -> None:
    if wanted:
        try:
            print(f"hitch {installed_version('overrun_hitch')}")
        except PackageNotFoundError:
            print("hitch, not installed (run from its source)")
        raise typer.Exit


@app.callback(invoke_without_command=True)
def _hitch(
    context: typer.Context,
    version: Annotated[
        bool, typer.Option("--version", callback=_show_version, is_eager=True, help="Show the version.")
    ] = False,
) -> None:
    """Longitudinal oscillations of a car and its overrun-braked trailer (Sharp 1982)."""
    if context.invoked_subcommand is None:
        print(context.get_help())


app.command()(run)
app.command()(stability)
app.command()(crosscheck)
app.command()(reference)
app.command()(couple)
app.command()(sweep)
app.command()(sensitivity)
app.command()(optimise)
app.command()(fit)
app.command()(paper)
app.command()(report)
app.command()(live)
app.command()(cases)
app.command()(parameters)
