"""The command line `hitch`. Exit status: 0 agreement, 1 what is compared differs, 2 bad input, 130 interrupted."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib.metadata import PackageNotFoundError
from importlib.metadata import version as installed_version
from typing import Annotated

import typer

from overrun_hitch.commands.couple import couple
from overrun_hitch.commands.crosscheck import crosscheck
from overrun_hitch.commands.fit import fit
from overrun_hitch.commands.optimise import optimise
from overrun_hitch.commands.paper import paper
from overrun_hitch.commands.report import report
from overrun_hitch.commands.run import run
from overrun_hitch.commands.sensitivity import sensitivity
from overrun_hitch.commands.stability import stability
from overrun_hitch.commands.sweep import sweep
from overrun_hitch.parameters import HitchError

app = typer.Typer(
    help="Longitudinal oscillations of a car and its overrun-braked trailer (Sharp 1982).",
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit status; bad input costs one line on stderr."""
    try:
        status = app(args=arguments, prog_name="hitch", standalone_mode=False)
        sys.stdout.flush()
    except (HitchError, typer.TyperException) as error:
        message = error.format_message() if isinstance(error, typer.TyperException) else str(error)
        print(f"hitch: {' '.join(message.split())}", file=sys.stderr)
        return 2
    except (KeyboardInterrupt, typer.Abort):
        return 130
    return status if isinstance(status, int) else 0


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
app.command()(couple)
app.command()(sweep)
app.command()(sensitivity)
app.command()(optimise)
app.command()(fit)
app.command()(paper)
app.command()(report)
