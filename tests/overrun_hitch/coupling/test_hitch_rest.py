"""Hitch.fmu where nothing is to happen: coasting, standing, reversing, drift, and steps taken back."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from overrun_hitch.coupling.pair import SCHEMES
from overrun_hitch.coupling.trio import Trio, opened_trio
from overrun_hitch.parameters import CASES, Parameters
from tests.sampling import sampled
from tests.unit import Unit

HOLD = next(scheme for scheme in SCHEMES if scheme.name == "alone-hold")
SEEN = ("compression", "F_hitch", "F_hitch_hold", "F_hitch_mean", "trailer_brake_torque", "trailer_brake_torque_mean",
        "trailer_brake_torque_hold", "coupling_energy", "v_rel")  # fmt: skip


@pytest.fixture(scope="module")
def trio(pair_fmus: dict[int, dict[str, Path]], hitch_fmu: Path) -> Iterator[Trio]:
    with opened_trio(pair_fmus[2]["Car"], hitch_fmu) as trio:
        yield trio


@pytest.fixture
def hitch(hitch_fmu: Path, tmp_path: Path) -> Iterator[Unit]:
    unit = Unit(hitch_fmu, tmp_path / "hitch")
    unit.slave.instantiate()
    yield unit
    unit.slave.freeInstance()


def driven(
    trio: Trio, p: Parameters, duration: float, H: float, torque: float = 0.0, grade: float = 0.0, push: float = 0.0
) -> dict[str, np.ndarray]:
    """What the hitch shows, and both speeds and the gap, under Jacobi; `push` (N) acts on the front body too."""
    trio.start(HOLD, p, torque, 1e-8)
    for unit in (trio.front, trio.rear):
        unit.set({"grade": grade})
    gap = p.compression_start
    rows = []
    for n in range(round(duration / H)):
        force, brake_torque = trio.hitch.get(["F_hitch_hold", "trailer_brake_torque_hold"])
        trio.hitch.set(trio.speeds())
        trio.front.set({"F_hitch": force + push})
        trio.rear.set({"F_hitch": -force, "brake_torque": brake_torque})
        for unit in (trio.front, trio.rear, trio.hitch):
            unit.step(n * H, H)
        (x_c,), (x_t,) = trio.front.get(["car.body.x"]), trio.rear.get(["car.body.x"])
        rows.append([*trio.hitch.get(SEEN), *trio.speeds().values(), gap + x_t - x_c])
    return dict(zip((*SEEN, "v_car", "v_trailer", "gap"), np.array(rows).T, strict=True))


@pytest.mark.parametrize("duration", sampled([50.0, 1000.0], {50.0}))
def test_coasting_leaves_no_drift(trio: Trio, duration: float) -> None:
    """At 25 m/s, released 2 cm in: it swings out, and then there is nothing; the gap between the bodies stays known.

    What a start with a jolt has cost, within the wheels' 6 ms while a step is 20, stays too.
    """
    p = CASES["ii"].changed({"V_0": 25.0, "compression_start": 0.02, "C": 2000.0})
    seen = driven(trio, p, duration, 0.02)
    off = seen["compression"] - seen["gap"]
    drift = np.ptp(off[round(20.0 / 0.02) :])
    print(f"{duration:g} s: {off[-1]:.1e} m off, drift {drift:.1e} m, force {seen['F_hitch'][-1]:.1e} N")
    assert abs(off[-1]) < 1e-4 and drift < 1e-7
    assert abs(seen["F_hitch"][-1]) < 1e-2 and 0.0 <= seen["trailer_brake_torque_hold"][-1] < 1e-2


def test_speeds_that_stand_leave_everything_as_it_is(hitch: Unit) -> None:
    """1000 s at 25 m/s, which is exact in binary, bit for bit."""
    hitch.start(v_car=25.0, v_trailer=25.0, compression_start=0.0625)
    before = hitch.get("compression", "F_hitch", "trailer_brake_torque")
    for n in range(8000):
        hitch.slave.doStep(0.125 * n, 0.125)
    np.testing.assert_array_equal(hitch.get("compression", "F_hitch", "trailer_brake_torque"), before)


@pytest.mark.parametrize(("grade", "braked"), [(0.1, False), (-0.1, True)])
def test_standing_on_a_slope(trio: Trio, grade: float, braked: bool) -> None:
    """Uphill the trailer hangs on the ball, and its brakes do nothing; downhill it leans on the car, and they act."""
    p = CASES["ii"].changed({"V_0": 0.0, "mu": 1.0, "C": 2000.0})
    seen = driven(trio, p, 10.0, 0.01, torque=5000.0, grade=grade)
    assert np.abs([seen["v_car"][-1], seen["v_trailer"][-1]]).max() < 1e-4
    torque = seen["trailer_brake_torque_hold"]
    print(f"grade {grade:g}: force {seen['F_hitch'][-1]:.1f} N, torque {torque[-1]:.2f} N.m")
    assert (torque[-1] > 10.0) if braked else (torque[100:] == 0.0).all()
    assert torque.min() >= 0.0
    assert (seen["F_hitch"][-1] > 0.0) == braked


@pytest.mark.parametrize("share", [0.0, 1.0])
def test_reversing(trio: Trio, share: float) -> None:
    """The car pushes the trailer back: with a lock-out it goes on, without one the brakes act and hold it."""
    p = CASES["ii"].changed({"V_0": -2.0, "reverse_braking": share, "mu": 1.0, "C": 2000.0, "C_rr": 0.02})
    seen = driven(trio, p, 5.0, 0.01, push=-500.0)
    assert seen["compression"][-1] > 0.0
    for kind in ("", "_mean", "_hold"):
        torque = seen[f"trailer_brake_torque{kind}"]
        assert (torque == 0.0).all() if share == 0.0 else torque[-1] > 5.0
    speed = seen["v_trailer"][-1]
    print(f"share {share:g}: {speed:.4f} m/s after 5 s, force {seen['F_hitch'][-1]:.1f} N")
    assert speed < -2.0 if share == 0.0 else abs(speed) < 1e-3


def moved(unit: Unit, first: int, count: int, **more: float) -> np.ndarray:
    """Outputs (count, n) after each of so many steps of speeds that change."""
    rows = []
    for n in range(first, first + count):
        unit.set(v_car=20.0 + 0.5 * np.sin(0.9 * n), v_trailer=20.0 + 0.4 * np.sin(0.7 * n), **more)
        unit.slave.doStep(0.01 * n, 0.01)
        rows.append(unit.get(*SEEN))
    return np.array(rows)


def test_steps_that_are_taken_back_leave_no_trace(hitch_fmu: Path, tmp_path: Path) -> None:
    """Bit for bit, in the instance itself and in another that gets the state as bytes."""
    one, other = Unit(hitch_fmu, tmp_path / "one"), Unit(hitch_fmu, tmp_path / "other")
    for unit in (one, other):
        unit.slave.instantiate()
        unit.start(v_car=20.0, v_trailer=20.0, eps=0.002, F_f=50.0, tau_b=0.05, M_front=1000.0, M_rear=500.0)
    moved(one, 0, 20)
    state = one.slave.getFMUstate()
    expected = moved(one, 20, 30)
    assert np.ptp(expected, axis=0).min() > 0.0
    one.slave.setFMUstate(state)
    np.testing.assert_array_equal(moved(one, 20, 30), expected)
    one.slave.setFMUstate(state)
    data = one.slave.serializeFMUstate(state)
    other.slave.setFMUstate(other.slave.deSerializeFMUstate(data))
    np.testing.assert_array_equal(moved(other, 20, 30), expected)
    for unit in (one, other):
        unit.slave.freeInstance()


def test_the_gap_takes_drift_away_and_makes_no_speed(hitch: Unit) -> None:
    """A compression that is 1 cm off approaches the gap with T_gap; the damper and v_rel see nothing."""
    T, off = 2.0, 0.01
    hitch.start(v_car=20.0, v_trailer=20.0, compression_start=0.05 + off, compression_in=0.05, T_gap=T, C=5000.0)
    for n in range(600):
        hitch.slave.doStep(0.01 * n, 0.01)
    compression, force, v_rel = hitch.get("compression", "F_hitch", "v_rel")
    assert compression - 0.05 == pytest.approx(off * np.exp(-6.0 / T), rel=1e-4)
    assert v_rel == 0.0
    assert force == pytest.approx(5480.0 * compression, rel=1e-12)
