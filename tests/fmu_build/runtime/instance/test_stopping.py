"""CarTrailer from 30 m/s to standstill and 10 s beyond: steps and events stay few, rest is reached and kept.

The generated C and the runtime, as in the FMU, with a window to the runtime's counters; the tolerance is the default.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.fmu_build.runtime.generated_models import generate
from tests.fmu_build.runtime.runtime_unit import OK, Counters, Library, Unit, compile_model
from tests.sampling import sampled, spread

STEP = 0.01  # s
BEYOND = 10.0  # s
COASTING = 100.0  # N.s/m: such a damper takes 5 s to make a trailer in the clearance 2.7 times slower
NAMES = ("v_car", "v_trailer", "compression", "F_hitch", "a_car", "a_trailer", "slip_car", "slip_trailer")

# Strong enough to hold on any of the grades; with mu = 0.3 the second is beyond what the tyres can take.
TORQUES = {1.0: (2000.0, 4000.0), 0.3: (900.0, 1600.0)}  # N.m, by friction


@pytest.fixture(scope="module")
def car_trailer(modelica_library: Path) -> Library:
    model = generate(modelica_library, "OverrunHitch.Systems.CarTrailer")
    return compile_model(model)  # type: ignore[arg-type]


def tries(counters: Counters) -> int:
    return counters.steps + counters.rejected + counters.repeated


def stop(library: Library, **values: float) -> tuple[np.ndarray, list[Counters]]:
    """Rows of NAMES at the communication points, the counters there."""
    unit = Unit(library, logging=True)
    try:
        assert unit.setup() == OK
        assert unit.set(V_0=30.0, **values) == OK
        assert unit.initialize() == OK
        rows, counters, at_rest = [unit.get(*NAMES)], [unit.counters()], 0
        while at_rest * STEP < BEYOND:
            assert len(rows) * STEP < 100.0, "no rest"
            assert unit.step(STEP, (len(rows) - 1) * STEP) == OK, unit.log
            rows.append(unit.get(*NAMES))
            counters.append(unit.counters())
            at_rest = at_rest + 1 if np.abs(rows[-1][:2]).max() < 0.1 else 0
        return np.array(rows), counters
    finally:
        unit.free()


@pytest.mark.parametrize("seed", sampled(range(12), [0, 1, 2]))
def test_rough_input_around_standstill(car_trailer: Library, seed: int) -> None:
    """A minute of brake torques and grades that jump every 0.1 s, options at random: no error, few steps and events."""
    random = np.random.default_rng(seed)
    unit = Unit(car_trailer, logging=True)
    try:
        assert unit.setup() == OK
        options = {"C_rr": random.choice([0.0, 0.01]), "reverse_braking": random.choice([0.0, 1.0]), "CdA_t": 1.0}
        drawbar = {"C": random.choice([0.0, 100.0, 500.0]), "eps": random.choice([0.0, 0.02, 0.1])}
        assert unit.set(V_0=random.uniform(-3.0, 3.0), mu=random.choice([0.3, 1.0]), **options, **drawbar) == OK
        assert unit.initialize() == OK
        for n in range(600):
            grade = random.uniform(-0.1, 0.1) + 0.02 * float(np.clip(unit.get("v_car")[0], -5.0, 5.0))
            assert unit.set(brake_torque=random.choice([0.0, random.uniform(0.0, 4000.0)]), grade=grade) == OK
            for m in range(10):
                assert unit.step(STEP, (10 * n + m) * STEP) == OK, unit.log
            assert np.isfinite(unit.get(*NAMES)).all()
        print(f"at {unit.get('v_car')[0]:.2f} m/s: {unit.counters()}")
        assert unit.counters().events < 12 * 60
        assert tries(unit.counters()) < 5 * 6000
    finally:
        unit.free()


def check_stop(library: Library, rest_within: float, rate: float = 12.0, dying: float = 0.0, **values: float) -> None:
    """Rest is reached `rest_within` so many s of standstill, and kept.

    At most `rate` events a second happen before, and `dying` of them afterwards: a damper whose coefficient changes
    with the direction does so as long as the drawbar swings at all.
    """
    rows, counters = stop(library, **values)
    assert np.isfinite(rows).all()
    if values["C"] <= COASTING and 0.0 < rows[-1, 2] < values["eps"]:
        # The trailer has come to rest in the clearance, where nothing but a weak damper holds it.
        assert np.abs(rows[-1, :2]).max() < 0.1 and counters[-1].events < rate * len(rows) * STEP
        return
    slow = np.abs(rows[:, :2]).max(axis=1) < 1e-6
    stopped = np.flatnonzero(~slow)[-1] + 1  # the first point of the rest that lasts
    standstill = np.argmax(rows[:, 0] < 0.1)
    last, moving = counters[-1], counters[stopped]
    print(
        f"{values}: standstill at {standstill * STEP:.2f} s, "
        f"rest at {stopped * STEP:.2f} s of {(len(rows) - 1) * STEP:.2f} s; "
        f"{last.steps} steps, {last.rejected} rejected, {last.repeated} repeated, {last.events} events"
    )
    # Rest comes while the drawbar still swings, at the latest: it takes seconds where it has no damper.
    assert (stopped - standstill) * STEP < rest_within
    # An event is a passage of the drawbar through an end of its clearance: twice a period, of 0.2 s at least.
    assert last.events < rate * standstill * STEP
    assert tries(moving) < 5 * stopped + 100  # where the trailer shunts and its wheels lock, again and again
    # At rest there is nothing to do: a step for each communication step, and no events. (While the last
    # micrometres a second die away a step may yet be rejected.)
    events = last.events - moving.events
    assert events <= dying * BEYOND
    assert tries(last) - tries(moving) <= len(rows) - 1 - stopped + 10 + 2 * events
    np.testing.assert_array_less(np.abs(rows[stopped:, 2] - rows[-1, 2]), 1e-5)


@pytest.mark.parametrize(
    ("C", "eps", "mu", "grade"), spread([0.0, 100.0, 500.0, 3200.0], [0.0, 0.1], TORQUES, [-0.1, 0.0, 0.1])
)
def test_a_stop(car_trailer: Library, C: float, eps: float, mu: float, grade: float) -> None:
    for torque in TORQUES[mu]:
        if mu == 0.3 and torque > 1000.0 and grade < 0.0:
            continue  # wheels that slide hardly hold the weight on this slope: 80 s and 1 km
        check_stop(car_trailer, 8.0 if C == 0.0 else 4.5, C=C, eps=eps, mu=mu, grade=grade, brake_torque=torque)


@pytest.mark.parametrize("grade", [-0.1, 0.0, 0.1])
@pytest.mark.parametrize(("C", "rebound"), [(100.0, 1.0), (100.0, 5.0), (1000.0, 3.0)])
def test_a_stop_with_a_drawbar_as_sold(car_trailer: Library, C: float, rebound: float, grade: float) -> None:
    """Threshold, three stiffnesses, buffer: six kinks, and one of the damper, each passed twice a period."""
    drawbar = {
        "eps": 0.005, "F_0": 150.0, "x_2": 0.02, "k_2": 9000.0, "x_3": 0.035, "k_3": 15e3, "travel": 0.045,
        "k_buffer": 200e3, "rebound": rebound,
    }  # fmt: skip
    for mu, torques in TORQUES.items():
        for torque in torques:
            if mu == 0.3 and torque > 1000.0 and grade < 0.0:
                continue
            dying = 10.0 if rebound > 1.0 else 0.0
            check_stop(car_trailer, 6.0, 70.0, dying, C=C, mu=mu, grade=grade, brake_torque=torque, **drawbar)
