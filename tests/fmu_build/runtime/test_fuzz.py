"""A short run of what `python tests/fmu_build/runtime/fuzz.py` does at length."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from tests.fmu_build.runtime.coupled_models import TOWED
from tests.fmu_build.runtime.fuzz import fuzzer
from tests.fmu_build.runtime.generated_models import EVENTS, generate
from tests.fmu_build.runtime.hand_written import Model
from tests.fmu_build.runtime.runtime_models import CAR_TRAILER, OSCILLATOR
from tests.sampling import spread

pytestmark = pytest.mark.usefixtures("sanitizers")


def named(value: Model | int) -> str:
    return value.name if isinstance(value, Model) else str(value)


@pytest.mark.full
@pytest.mark.parametrize("fmi", [2, 3])
@pytest.mark.parametrize("model", [CAR_TRAILER, OSCILLATOR, TOWED], ids=named)
def test_random_calls(model: Model, fmi: int) -> None:
    random_calls(fuzzer(model, fmi))


@pytest.mark.full
@pytest.mark.parametrize(("system", "fmi"), spread(["Trailer", "Hitch"], [2, 3]))
def test_random_calls_of_a_generated_model_with_a_coupling(system: str, fmi: int, modelica_library: Path) -> None:
    random_calls(fuzzer(generate(modelica_library, f"OverrunHitch.Systems.{system}"), fmi))


@pytest.mark.full
@pytest.mark.parametrize("fmi", [2, 3])
def test_random_calls_of_a_model_with_events(fmi: int, tmp_path: Path) -> None:
    (tmp_path / "Events.mo").write_text(EVENTS, encoding="utf-8")
    random_calls(fuzzer(generate(tmp_path / "Events.mo", "Events"), fmi))


def random_calls(program: Path) -> None:
    result = subprocess.run([program, "7", "10000"], capture_output=True, text=True, timeout=120)
    print(result.stdout)
    assert result.returncode == 0, result.stderr
