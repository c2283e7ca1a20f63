"""The live page in a real browser: what it shows and hands out is what the command line says, whatever is typed."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from lxml import etree

from overrun_hitch.commands.options import parameters_of
from overrun_hitch.parameters import CASES, FIGURES, Scenario
from overrun_hitch.results import VARIABLES, read_csv
from overrun_hitch.scenarios import asked_scenario
from overrun_hitch.theory.boundary import critical_damping
from tests.overrun_hitch.commands.test_live import served
from tests.runs import step_brake
from tests.web.conftest import WEB, NodeRunner

BROWSER = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
TOLERANCE = 1e-9  # relative to the largest value of a trace
SCENARIOS = {
    **{f"Figure {name}": scenario for name, scenario in FIGURES.items()},
    **{f"Case {name}": asked_scenario(None, name, {}) for name in CASES},
    "Link": asked_scenario(None, None, {"sigma": 0.25, "F_f": 50.0, "C_kt": 1.8e5, "M_t": 750.5}, brake_torque=812.5),
}
LINK = "sigma=0.25&F_f=50&C_kt=180000&M_t=750.5&brake_torque=812.5"
pytestmark = [
    pytest.mark.full,
    pytest.mark.platforms,
    pytest.mark.skipif(BROWSER is None, reason="no browser is installed (Debian: chromium)"),
]


def test_the_page(run_node: NodeRunner, unit_folder: Path, car_trailer_fmu: Path, tmp_path: Path) -> None:
    """All of web/test/page.test.ts in one test, because it takes a minute; then what it has taken from the page."""
    page = unit_folder / "index.html"
    with served(page) as address:
        run_node("page", PAGE=str(page), SERVED=address, BROWSER=str(BROWSER), LINK=LINK, OUT=str(tmp_path))
    shown = json.loads((tmp_path / "shown.json").read_text(encoding="utf-8"))
    for name, scenario in SCENARIOS.items():
        the_run_is_that_of_the_native_unit(tmp_path / f"{name}.csv", step_brake(scenario, fmu=car_trailer_fmu))
        what_repeats_the_run_says_the_same(tmp_path / f"{name}.toml", shown[name], scenario)
    the_picture_is_svg_by_itself(tmp_path / "run.svg")


def the_run_is_that_of_the_native_unit(table: Path, expected: xr.Dataset) -> None:
    found = read_csv(table)
    assert np.array_equal(found["time"], np.round(expected["time"], 9))
    distances = [float(abs(found[name] - expected[name]).max() / abs(expected[name]).max()) for name in VARIABLES]
    print(f"{table.stem}: {max(distances):.2g} of the largest value")
    assert max(distances) <= TOLERANCE


def what_repeats_the_run_says_the_same(file: Path, shown: dict[str, Any], scenario: Scenario) -> None:
    datum = FIGURES["8"].parameters
    assert datum.changed(parameters_of(file)) == scenario.parameters
    again = asked(shown["python"])
    assert (again.parameters, again.brake_torque) == (scenario.parameters, scenario.brake_torque)
    values = dict(pair.split("=") for pair in shown["link"][1:].split("&")[:-3])
    torque = values.pop("brake_torque", "1000")
    assert (datum.changed(values), float(torque)) == (scenario.parameters, scenario.brake_torque)
    command = "# hitch run --parameters hitch.toml" + (f" --brake-torque {torque}" if torque != "1000" else "")
    assert file.read_text(encoding="utf-8").splitlines()[0] == command
    critical = critical_damping(scenario.parameters, scenario.parameters.V_0)
    assert f"C_crit at V_0 N.s/m{critical:.4g}\N{EN DASH}" in shown["rows"]
    agreed = sum(row.endswith("agrees") for row in shown["rows"])  # the rest of the rows is test_comparison's
    assert agreed in (0, 6) and (agreed == 6) == (shown["reasons"] == "")


def asked(line: str) -> Scenario:
    """What the line asks `hitch.run` for."""
    calls: list[Scenario] = []

    class Hitch:
        @staticmethod
        def run(figure: str, brake_torque: float | None = None, **changes: float) -> None:
            calls.append(asked_scenario(figure, None, changes, brake_torque=brake_torque))

    exec(line.removeprefix("import overrun_hitch as hitch; "), {"hitch": Hitch})
    return calls[0]


def the_picture_is_svg_by_itself(picture: Path) -> None:
    text = picture.read_text(encoding="utf-8")
    assert text.startswith("<svg ") and "Acceleration" in text and "var(" not in text
    assert not re.search(r"(?:href|src)=", text)
    etree.fromstring(text)


def test_the_page_is_one_file_that_may_fetch_nothing(unit_folder: Path) -> None:
    text = (unit_folder / "index.html").read_text(encoding="utf-8")
    assert "default-src 'none'" in text
    assert not re.search(r"<(?:iframe|img)\b|<script[^>]*src=|<link[^>]*href=\"(?!data:,)|@import", text)
    assert "2-Clause BSD License" in text and "Rich Felker" in text  # headers of FMI, libm
    for package in ("uplot", "ml-matrix", "@observablehq/plot", "d3-scale"):
        assert re.search(rf"^{re.escape(package)} \d", text, re.MULTILINE), package  # and its licence after it


def test_the_page_is_small() -> None:
    lines = [
        line.strip() for file in (WEB / "src").glob("*.ts") for line in file.read_text(encoding="utf-8").split("\n")
    ]
    code = [line for line in lines if line and not line.startswith(("//", "/*", "*"))]
    print(f"{len(code)} lines of TypeScript")
    assert 1000 < len(code) < 1500
