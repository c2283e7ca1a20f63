"""Saved states: rollback, other processes, and what is refused."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from time import perf_counter

import numpy as np
import pytest
from numpy.random import default_rng

from tests.fmu_build.runtime.coupled_models import TOWED
from tests.fmu_build.runtime.generated_models import EVENTS, generate
from tests.fmu_build.runtime.hand_written import Model
from tests.fmu_build.runtime.runtime_models import CAR_TRAILER, OSCILLATOR, SINGULAR
from tests.fmu_build.runtime.runtime_unit import DISCARD, ERROR, OK, Library, Unit
from tests.sampling import sampled

NAMES = ["compression", "v_c", "v_t", "der_w_c"]


@pytest.fixture
def car(unit: Callable[..., Unit]) -> Unit:
    u = unit(CAR_TRAILER)
    assert u.set(brake_torque=1000.0, C=20.0) == OK
    return u


def test_run_on_and_back_is_equal_bit_by_bit(car: Unit) -> None:
    assert car.initialize() == OK
    for _ in range(3):
        car.run(car.time + 0.7, 0.07, NAMES)
        before, saved = car.state(), car.save()
        first = car.run(car.time + 1.4, 0.07, NAMES)
        end = car.state()
        assert car.set(brake_torque=200.0, M_t=700.0) == OK
        car.run(car.time + 0.3, 0.03, NAMES)
        assert car.restore(saved) == OK
        assert car.state() == before
        assert np.array_equal(car.run(car.time + 1.4, 0.07, NAMES), first)
        assert car.state() == end
        car.drop(saved)


def test_a_saved_state_is_reused_and_outlives_what_comes_later(car: Unit) -> None:
    saved = car.save()
    assert car.initialize() == OK
    address = saved.value
    car.save(saved)
    assert saved.value == address
    state = car.state()
    assert car.step(0.5) == OK
    assert car.call("fmi2Terminate") == OK
    assert car.restore(saved) == OK
    assert car.state() == state
    assert car.call("fmi2Reset") == OK
    assert car.restore(saved) == OK
    assert car.step(0.5, 0.0) == OK
    car.drop(saved)
    assert car.call("fmi2FreeFMUstate", None) == OK


def test_before_initialization(car: Unit) -> None:
    saved = car.save()
    assert car.initialize() == OK
    assert car.step(0.1) == OK
    assert car.restore(saved) == OK
    assert car.step(0.1, 0.0) == ERROR
    assert car.initialize() == OK
    assert car.get("brake_torque")[0] == 1000.0
    car.drop(saved)


def test_back_from_a_step_that_has_been_discarded(unit: Callable[..., Unit]) -> None:
    u = unit(SINGULAR)
    assert u.initialize() == OK
    assert u.step(0.5) == OK
    saved = u.save()
    assert u.step(0.6) == DISCARD
    assert u.step(0.1) == OK
    assert u.restore(saved) == OK
    assert u.step(0.4) == OK
    assert u.get("x")[0] == pytest.approx(10.0, rel=1e-4)
    u.drop(saved)


OTHER_PROCESS = """
import sys
sys.path[:0] = [{here!r}]
from pathlib import Path
from tests.fmu_build.runtime.runtime_models import CAR_TRAILER
from tests.fmu_build.runtime.runtime_unit import OK, Library, Unit, load
u = Unit(Library(CAR_TRAILER, Path({library!r}), load(Path({library!r}))))
status, saved = u.deserialize(Path({file!r}).read_bytes())
assert status == OK and u.restore(saved) == OK
u.run(u.time + 1.4, 0.07, {names!r})
u.drop(saved)
sys.stdout.write(u.state().hex())
"""


def test_in_another_process(library: Callable[[Model], Library], car: Unit, tmp_path: Path) -> None:
    assert car.initialize() == OK
    car.run(0.7, 0.07, NAMES)
    saved = car.save()
    file = tmp_path / "state"
    file.write_bytes(car.serialize(saved))
    car.run(2.1, 0.07, NAMES)
    program = OTHER_PROCESS.format(
        here=str(Path(__file__).parents[4]), library=str(library(CAR_TRAILER).path), file=str(file), names=NAMES
    )
    result = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert bytes.fromhex(result.stdout) == car.state()
    car.drop(saved)


def test_bytes_that_are_refused(unit: Callable[..., Unit], car: Unit) -> None:
    assert car.initialize() == OK
    saved = car.save()
    data = car.serialize(saved)
    status, again = car.deserialize(data)
    assert status == OK
    assert car.serialize(again) == data
    car.drop(again)
    foreign = data.replace(b"hand-written", b"other-version")[: len(data)]
    for bad, message in (
        (b"", "not the bytes of a state"),
        (data[:100], "not complete"),
        (data[:-1], "not complete"),
        (data + b"\0", "not complete"),
        (bytes(len(data)), "not the bytes of a state"),
        (foreign, "another model"),
        (data[:-9] + bytes([data[-9] ^ 1]) + data[-8:], "damaged"),
    ):
        status, nothing = car.deserialize(bad)
        assert status == ERROR
        assert not nothing
        assert message in car.messages()[-1]
    car.drop(saved)


def test_state_of_another_kind_of_instance(unit: Callable[..., Unit]) -> None:
    u, other = unit(OSCILLATOR), unit(OSCILLATOR, exchange=True)
    saved = u.save()
    assert other.restore(saved) == ERROR
    assert "used in another way" in other.messages()[-1]
    u.drop(saved)


def with_checksum(data: bytes, state: bytes) -> bytes:
    """The saved bytes with another state and the checksum that goes with it (FNV-1a)."""
    total = 0xCBF29CE484222325
    for byte in state:
        total = (total ^ byte) * 0x100000001B3 & 0xFFFFFFFFFFFFFFFF
    return data[: -len(state) - 8] + total.to_bytes(8, sys.byteorder) + state


def live_on(u: Unit) -> None:
    """What every instance must bear: a few calls, of which none hangs and none is OK with what is not finite."""
    names = [name for name in u.references if name in ("time", "x", "h", "compression")]
    for _ in range(3):
        if u.step(0.05) == OK:
            assert np.isfinite(u.time)
        status, values = u.get_status(*names)
        assert status != OK or np.isfinite(values).all()


@pytest.mark.parametrize("which", sampled(["CarTrailer", "Oscillator", "Towed", "Events"], ["CarTrailer", "Towed"]))
def test_a_state_that_was_made_up_is_refused_or_harmless(unit: Callable[..., Unit], which: str, tmp_path: Path) -> None:
    """Every byte changed, the checksum right."""
    (tmp_path / "Events.mo").write_text(EVENTS, encoding="utf-8")
    models = {model.name: model for model in (CAR_TRAILER, OSCILLATOR, TOWED)}
    u = unit(models[which] if which in models else generate(tmp_path / "Events.mo", "Events"))
    assert u.initialize() == OK
    for _ in range(7):
        assert u.step(0.05) == OK
    good = u.save()
    data, state = u.serialize(good), u.state()
    assert with_checksum(data, state) == data
    random = default_rng(1)
    refused, slowest = 0, 0.0
    for place in range(len(state)):
        for change in (0x80, int(random.integers(1, 256))):
            made_up = state[:place] + bytes([state[place] ^ change]) + state[place + 1 :]
            status, saved = u.deserialize(with_checksum(data, made_up))
            if status != OK:
                assert not saved and u.messages()
                refused += 1
                continue
            start = perf_counter()
            if u.restore(saved) == OK:
                live_on(u)
            slowest = max(slowest, perf_counter() - start)
            u.drop(saved)
    print(f"{len(state)} bytes: {refused} of {2 * len(state)} refused; the others took at most {slowest:.3f} s")
    assert refused > 0 and slowest < 20.0
    assert u.restore(good) == OK
    assert u.step(0.05) == OK
    u.drop(good)


@pytest.mark.parametrize("place", [8, 9])
def test_a_truth_that_is_neither(unit: Callable[..., Unit], place: int) -> None:
    u = unit(OSCILLATOR)
    assert u.initialize() == OK
    saved = u.save()
    data, state = u.serialize(saved), u.state()
    status, _ = u.deserialize(with_checksum(data, state[:place] + b"l" + state[place + 1 :]))
    assert status == ERROR
    assert "this state cannot be that of an instance" in u.messages()[-1]
    u.drop(saved)
