"""FMUs of the paper's equations made by hand with pythonfmu, see paper_slave.py."""

from __future__ import annotations

import platform
import subprocess
import sys
from pathlib import Path

import pytest

from tests.kept import kept

SLAVE = Path(__file__).with_name("paper_slave.py")


def hand_made(factor: float = 1.0, sign: float = 1.0) -> Path:
    """The unit with a drawbar that is `factor` as stiff, and with this sign of its hitch force."""
    if platform.machine().lower() not in ("x86_64", "amd64"):
        pytest.skip("pythonfmu has libraries for x86_64 alone")
    text = SLAVE.read_text(encoding="utf-8").replace("STIFFER, SIGN = 1.0, 1.0", f"STIFFER, SIGN = {factor}, {sign}")

    def make(folder: Path) -> None:
        script = folder / SLAVE.name
        script.write_text(text, encoding="utf-8")
        command = [sys.executable, "-m", "pythonfmu", "build", "-f", str(script), "-d", str(folder)]
        subprocess.run(command, check=True, capture_output=True, cwd=folder)

    return kept(make, "hand-made FMU", text) / "PaperSlave.fmu"
