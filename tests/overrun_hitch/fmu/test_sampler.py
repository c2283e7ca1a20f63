"""The compiled loop makes the calls that Python makes: the same bits, the same refusals."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from overrun_hitch.fmu import files, sampler
from overrun_hitch.fmu.messages import StepRefused
from overrun_hitch.fmu.opening import opened_unit
from overrun_hitch.fmu.unit import HitchUnit
from overrun_hitch.parameters import CASES

NAMES = ["compression", "a_car", "F_hitch"]
POINTS = np.append(0.025 * np.arange(240), 6.0)  # of more than two calls of the loop


def both(fmu: Path, monkeypatch: pytest.MonkeyPatch, sampled: Callable[[HitchUnit], object]) -> list[object]:
    """What comes by the compiled loop, and call by call."""
    assert sampler.compiled_loop() is not None
    with opened_unit(fmu) as unit:
        compiled = sampled(unit)
        monkeypatch.setattr(sampler, "compiled_loop", lambda: None)
        return [compiled, sampled(unit)]


@pytest.mark.parametrize("case", ["ii", "ix"])
@pytest.mark.parametrize("changed", [(), (0, 1, 57, 100, 239)])
def test_the_same_bits(
    case: str, changed: tuple[int, ...], car_trailer_fmu: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def sampled(unit: HitchUnit) -> np.ndarray:
        unit.start(CASES[case].changed({"eps": 0.03}), {"brake_torque": 1000.0}, 1e-6)
        changes = {step: lambda step=step: unit.set({"brake_torque": 10.0 * step}) for step in changed}
        return unit.sampler(NAMES, POINTS).run(changes).copy()

    compiled, by_calls = both(car_trailer_fmu, monkeypatch, sampled)
    np.testing.assert_array_equal(compiled, by_calls)
    assert np.ptp(compiled, axis=0).all()


@pytest.mark.parametrize(
    ("points", "said"),
    [(POINTS + 1.0, "communication point = 1 s"), (np.append(POINTS[:150], 3.0), "communication step size = -0.725 s")],
)
def test_the_same_refusal(
    points: np.ndarray, said: str, car_trailer_fmu: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of the first step, which does not go on from where the unit is, and of a later one that goes back."""

    def sampled(unit: HitchUnit) -> tuple[str, float]:
        unit.start(CASES["ii"], {"brake_torque": 1000.0}, 1e-6)
        with pytest.raises(StepRefused) as told:
            unit.sampler(NAMES, points).run()
        return str(told.value), unit.get(["compression"])[0]

    compiled, by_calls = both(car_trailer_fmu, monkeypatch, sampled)
    assert compiled == by_calls
    assert compiled[0].startswith(f"CarTrailer.fmu: {said}")


def test_without_a_library_python_calls(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Where none was made, and where it is none of this machine's."""
    monkeypatch.setattr(files, "LIBRARY", tmp_path / "none")
    monkeypatch.setattr(files, "BUILT", tmp_path)
    sampler.compiled_loop.cache_clear()
    assert sampler.compiled_loop() is None
    library = tmp_path / "sampler" / sampler.fmpy.platform_tuple / f"sampler{sampler.fmpy.sharedLibraryExtension}"
    library.parent.mkdir(parents=True)
    library.write_bytes(b"of another machine")
    sampler.compiled_loop.cache_clear()
    assert sampler.compiled_loop() is None
    sampler.compiled_loop.cache_clear()
