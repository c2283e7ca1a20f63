"""What a command says where the packages of its extra are not installed."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

EXTRAS = ["dask", "distributed", "locket", "zarr", "SALib", "jinja2"]
EXTRAS += ["rumoca", "sympy", "networkx", "nh3", "platformdirs"]
WITHOUT = "import sys; sys.modules.update(dict.fromkeys({packages!r})); "  # what is None there can't be imported
HITCH = "from overrun_hitch.__main__ import main; sys.exit(main())"
API = "import overrun_hitch as hitch; hitch.sweep({}, 'store')"
FMU_BUILD = "from fmu_build.__main__ import main; sys.exit(main())"


def ran(packages: list[str], code: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-c", WITHOUT.format(packages=packages) + code, *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False, timeout=60)


@pytest.mark.parametrize(
    ("packages", "code", "arguments", "told"),
    [
        (
            ["dask"],
            HITCH,
            ["sweep", "spec.toml"],
            "needs dask, which is not installed: pip install 'overrun-hitch[sweep]'",
        ),
        pytest.param(["SALib"], HITCH, ["sensitivity"], "pip install 'overrun-hitch[sweep]'", marks=pytest.mark.full),
        (["jinja2"], HITCH, ["report"], "pip install 'overrun-hitch[report]'"),
        (["sympy"], FMU_BUILD, ["M.mo", "M", "--show", "sorted"], "needs sympy: pip install 'overrun-hitch[build]'"),
    ],
)
def test_which_extra_brings_it(packages: list[str], code: str, arguments: list[str], told: str) -> None:
    done = ran(packages, code, *arguments)
    assert done.returncode == 2, done.stderr
    (line,) = done.stderr.splitlines()
    assert told in line


@pytest.mark.full
def test_a_script_is_told_as_well() -> None:
    done = ran(["zarr"], API)
    assert "HitchError: this needs zarr, which is not installed" in done.stderr


@pytest.mark.full
@pytest.mark.parametrize("command", [["cases"], ["stability", "--V", "20"], ["run", "--help"], ["sweep", "--help"]])
def test_the_rest_needs_none_of_them(command: list[str], tmp_path: Path) -> None:
    code = f"import os; os.chdir({str(tmp_path)!r}); {HITCH}"
    done = ran(EXTRAS, code, *command)
    assert done.returncode == 0, done.stderr


@pytest.mark.full
def test_runs_in_memory_need_none_of_them() -> None:
    many = "hitch.run_many({'C': [1.0]}, metrics=['growth_rate'])"
    done = ran(EXTRAS, f"import overrun_hitch as hitch; hitch.compare(hitch.run()); {many}")
    assert done.returncode == 0, done.stderr
