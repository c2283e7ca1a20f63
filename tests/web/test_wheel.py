"""The wheel with the page in it, away from the clone, where there is neither a compiler nor Node."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import urllib.request
import zipfile
from pathlib import Path

import pytest

from tests.conftest import ROOT


@pytest.mark.full
def test_hitch_live_serves_it(tmp_path: Path) -> None:
    page = b"<!doctype html><title>The page, for which any will do</title>"
    clone = tmp_path / "clone"
    shutil.copytree(ROOT / "fmu_build", clone / "fmu_build", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copytree(
        ROOT / "python", clone / "python", ignore=shutil.ignore_patterns("__pycache__", "fmus", "*.egg-info")
    )
    for file in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / file, clone)
    place = clone / "python" / "overrun_hitch" / "fmus" / "live" / "index.html"  # where make dist puts it
    place.parent.mkdir(parents=True)
    place.write_bytes(page)
    build = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(tmp_path)]
    subprocess.run(build, cwd=clone, check=True, capture_output=True)
    (wheel,) = tmp_path.glob("*.whl")
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tmp_path / "installed")
    shutil.rmtree(clone)
    environment = {**os.environ, "PYTHONPATH": str(tmp_path / "installed"), "PATH": ""}
    command = [sys.executable, "-m", "overrun_hitch", "live", "--no-open"]
    with subprocess.Popen(command, cwd=tmp_path, env=environment, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout
        try:
            address = process.stdout.readline().split("at ")[1].split(" ")[0]
            with urllib.request.urlopen(address, timeout=10) as answer:
                assert answer.read() == page
        finally:
            process.send_signal(signal.SIGINT)
        assert process.wait(10) == 0
