"""What a command loads before it works, which is most of its time. Times depend on the machine, this does not."""

from __future__ import annotations

import re
import subprocess
import sys
from contextlib import nullcontext
from importlib.metadata import packages_distributions, requires
from pathlib import Path

import pytest

from overrun_hitch import cli
from overrun_hitch.extras import NAME
from overrun_hitch.fmu.guest import Guest

LIGHT = {"pydantic", "typer", "mpl_toolkits"}  # what all commands are made of, and what comes with matplotlib
LOADED = """
import os, sys
from overrun_hitch.__main__ import main
with open(os.devnull, "w") as nowhere:
    out, sys.stdout = sys.stdout, nowhere
    status = main()
sys.stdout = out
print(status, *sys.modules)
"""
COMMANDS = [command.callback.__name__ for command in cli.app.registered_commands if command.callback]


def declared() -> set[str]:
    """Modules of the packages that the project asks for, extras among them, by their names in an import."""
    asked = {re.findall(r"[\w-]+", requirement)[0].lower() for requirement in requires(NAME) or []}
    return {
        module for module, packages in packages_distributions().items() if asked & {name.lower() for name in packages}
    }


def loaded(*arguments: str) -> set[str]:
    """The modules of a process behind the command."""
    done = subprocess.run([sys.executable, "-c", LOADED, *arguments], capture_output=True, text=True, check=True)
    status, *modules = done.stdout.split()
    assert status == "0", done.stderr
    return set(modules)


def heavy(modules: set[str]) -> set[str]:
    return {name.partition(".")[0] for name in modules} & declared() - LIGHT


@pytest.mark.parametrize(
    "arguments",
    [["--help"], pytest.param([], marks=pytest.mark.full), pytest.param(["--version"], marks=pytest.mark.full)],
)
def test_help_loads_nothing(arguments: list[str]) -> None:
    assert heavy(loaded(*arguments)) == set()


@pytest.mark.full
@pytest.mark.parametrize("command", COMMANDS)
def test_help_of_each_command_loads_nothing(command: str) -> None:
    assert heavy(loaded(command, "--help")) == set()


@pytest.mark.parametrize(
    ("arguments", "needed"),
    [
        pytest.param(["cases"], {"numpy", "rich", "scipy"}, marks=pytest.mark.full),
        pytest.param(["stability", "--C", "200"], {"matplotlib", "numpy", "rich", "scipy"}, marks=pytest.mark.full),
        (["run", "--fmu"], {"matplotlib", "numpy", "rich", "scipy"}),
    ],
)
def test_what_the_quick_commands_load(
    arguments: list[str], needed: set[str], car_trailer_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Neither xarray, which brings pandas, Pint and Dask, nor FMPy, which is the guest's; not all of SciPy."""
    monkeypatch.chdir(tmp_path)
    modules = loaded(*arguments, *([str(car_trailer_fmu)] if arguments[-1] == "--fmu" else []))
    assert heavy(modules) == needed
    assert not modules & {"matplotlib.pyplot", "scipy.integrate", "scipy.interpolate", "scipy.stats"}


@pytest.mark.full
def test_what_a_guest_loads() -> None:
    """It starts in every run."""
    code = "[__import__(name) for name in ('overrun_hitch.experiments.drive', 'overrun_hitch.fmu.opening')]"
    with Guest("modules", 60.0, nullcontext, f"{code} and set(__import__('sys').modules)") as guest:
        assert heavy(guest.call(eval)) == {"fmpy", "numpy"}
