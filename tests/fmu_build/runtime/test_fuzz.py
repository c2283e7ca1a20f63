"""A short run of what `python tests/fmu_build/runtime/fuzz.py` does at length."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest
from fuzz import fuzzer
from runtime_models import CAR_TRAILER, OSCILLATOR, Model


@pytest.mark.parametrize("fmi", [2, 3])
@pytest.mark.parametrize("model", [CAR_TRAILER, OSCILLATOR], ids=lambda m: m.name)
def test_random_calls(model: Model, fmi: int, tmp_path: Path) -> None:
    try:
        program = fuzzer(model, fmi, tmp_path)
    except subprocess.CalledProcessError:
        pytest.skip("no sanitizers")
    result = subprocess.run([program, "7", "10000"], capture_output=True, text=True, timeout=120)
    print(result.stdout)
    assert result.returncode == 0, result.stderr
