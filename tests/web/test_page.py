"""The live page in a browser without a window: its numbers are those of the command line, and it asks for nothing."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from fmu_build.fmu.compile import zig_compiler
from fmu_build.pipeline import build
from overrun_hitch.parameters import FIGURES
from overrun_hitch.theory.linear import shunting_mode
from tests.runs import step_brake
from tests.web.conftest import WEB

BROWSER = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
pytestmark = [
    pytest.mark.platforms,
    pytest.mark.skipif(BROWSER is None, reason="no browser is installed (Debian: chromium)"),
    pytest.mark.skipif(shutil.which("node") is None, reason="Node (node) is not installed"),
    pytest.mark.skipif(not (WEB / "node_modules").exists(), reason="the packages of web/ are not installed (make web)"),
    pytest.mark.skipif(zig_compiler() is None, reason="the package ziglang is not installed"),
]


@pytest.fixture(scope="module")
def page(modelica_library: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("page")
    fmu = folder / "CarTrailer.fmu"
    build(modelica_library, "OverrunHitch.Systems.CarTrailer", fmu, 3, ("wasm",), references=False)
    subprocess.run([sys.executable, WEB / "unit.py", fmu, folder], check=True)
    subprocess.run(["node", WEB / "bundle.mjs", folder, folder / "index.html"], check=True)
    return folder / "index.html"


def shown(page: Path, link: str) -> dict[str, str]:
    """The text of what has an id in the page behind a link, once it has drawn. Nothing may go wrong on its console."""
    command = [str(BROWSER), "--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr", "--dump-dom"]
    command += [f"--user-data-dir={page.parent / 'profile'}", f"{page.as_uri()}#{link}"]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=60)
    assert "CONSOLE" not in done.stderr, done.stderr
    return dict(re.findall(r'id="(\w+)"[^>]*>([^<]*)<', done.stdout)) | {
        "hidden": " ".join(re.findall(r'id="(\w+)" hidden', done.stdout))
    }


@pytest.mark.parametrize("figure", ["6a", "8"])
def test_the_numbers_are_those_of_theory_and_run(figure: str, page: Path, car_trailer_fmu: Path) -> None:
    scenario = FIGURES[figure]
    found = shown(page, f"C={scenario.parameters.C}")
    compression = 1e3 * step_brake(scenario, fmu=car_trailer_fmu)["compression"].values
    mode = shunting_mode(scenario.parameters, scenario.parameters.V_0)
    assert (found["largest"], found["last"]) == (f"{compression.max():.3f}", f"{compression[-1]:.3f}")
    assert found["growth"] == f"{float(mode.growth_rate):.3f}"
    assert found["frequency"] == f"{float(mode.frequency):.3f}"
    assert found["damping"] == f"{float(mode.damping_ratio):.4f}"
    assert found["verdict"].endswith("grows." if mode.growth_rate > 0.0 else "dies out.")
    assert (found["alert"], found["hidden"]) == ("", "clearance")


def test_theory_is_silent_where_there_is_clearance(page: Path, car_trailer_fmu: Path) -> None:
    found = shown(page, "eps=0.1")  # figure 10
    compression = 1e3 * step_brake(FIGURES["10"], fmu=car_trailer_fmu)["compression"].values
    assert (found["largest"], found["hidden"]) == (f"{compression.max():.3f}", "theory")


def test_the_unit_refuses_what_is_out_of_range(page: Path) -> None:
    assert shown(page, "C=-5")["alert"].startswith("C = -5 N.s/m is not allowed: its range is 0 N.s/m")
    assert "NaN" in shown(page, "C=much")["alert"].replace("nan", "NaN")


def test_it_is_one_file_that_may_fetch_nothing(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    assert "default-src 'none'" in text and not re.search(r"<(?:link|img|iframe)\b|<script[^>]*src=|@import", text)
