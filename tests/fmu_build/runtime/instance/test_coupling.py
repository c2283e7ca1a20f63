"""What a coupling adds: impulse, prediction, account of energy, and what it must leave alone.

The model is a mass behind a ball of given speed u, by a spring and a damper: linear where k_push = k_pull.
"""

from __future__ import annotations

from collections.abc import Callable
from math import cos, sin

import numpy as np
import pytest

from tests.fmu_build.runtime.coupled_models import TOWED, TOWED_PLAIN
from tests.fmu_build.runtime.runtime_fmi3 import Unit3
from tests.fmu_build.runtime.runtime_unit import DISCARD, ERROR, OK, Unit

Create = Callable[..., Unit]
REPLACED = ("mean", "hold", "energy")


def speed(t: float) -> float:
    return sin(2.0 * t) + 0.3 * cos(7.0 * t)


def towed(unit: Create, model: object = TOWED, **start: float) -> Unit:
    u = unit(model)
    assert u.set(u=speed(0.0), v=0.2, **start) == OK
    assert u.setup(1e-10) == OK
    assert u.initialize() == OK
    return u


def tow(u: Unit, sizes: list[float], *names: str) -> np.ndarray:
    """Rows of `names` after each step, the speed given by its values at the starts."""
    rows = []
    for size in sizes:
        assert u.set(u=speed(u.time)) == OK
        assert u.step(size) == OK, u.log
        rows.append(u.get(*names))
    return np.array(rows)


def odd_sizes(n: int) -> list[float]:
    return np.random.default_rng(3).choice([1e-4, 0.003, 0.01, 0.05], n).tolist()


def test_before_the_first_step_they_are_what_the_equations_make_them(unit: Create) -> None:
    u = towed(unit)
    force, *replaced = u.get("force", *REPLACED)
    assert force != 0.0 and replaced == [force, force, 0.0]
    assert u.set(u=2.0) == OK
    assert u.get("mean")[0] == u.get("force")[0] != force


def test_what_is_given_for_a_step_does_not_move_inside_it(unit: Create) -> None:
    """A master that copies output derivatives to inputs must not let a force move that is meant to be held."""
    u = towed(unit)
    tow(u, [0.01] * 20, "mean")
    status, slopes = u.output_slopes("force", *REPLACED)
    assert status == OK and abs(slopes[0]) > 1.0 and not slopes[1:].any()


@pytest.mark.parametrize("applied", [1.0, 2.0, 3.0])
def test_the_means_sum_up_to_the_impulse(unit: Create, applied: float) -> None:
    u = towed(unit, k_pull=300.0, applied=applied)
    sizes = odd_sizes(400)
    means = tow(u, sizes, "mean")[:, 0]
    impulse = u.get("impulse")[0]
    assert np.dot(means, sizes) == pytest.approx(impulse, abs=1e-12)
    assert np.ptp(means) > 1.0


def test_a_linear_speed_is_predicted_to_the_accuracy_of_the_integrator(unit: Create) -> None:
    u = towed(unit, applied=2.0)  # nothing is owed then
    rows = []
    for _ in range(60):
        assert u.set(u=0.5 * u.time) == OK
        assert u.step(0.02) == OK
        rows.append(u.get("mean", "hold", "force"))
    mean, hold, force = np.array(rows)[2:].T
    np.testing.assert_allclose(hold[:-1], mean[1:], atol=1e-9)
    assert np.abs(force[:-1] - mean[1:]).max() > 1e-3  # so that it is no small feat


def test_the_impulse_that_is_owed_is_paid_back(unit: Create) -> None:
    size = 0.01
    u = towed(unit, k_pull=60.0)
    first = u.get("hold")[0]
    impulse, hold, force = tow(u, [size] * 2000, "impulse", "hold", "force").T
    owed = impulse - size * np.cumsum([first, *hold[:-1]])
    assert np.abs(owed).max() < size * np.abs(np.diff(force)).max()  # one step's, whatever the number of steps
    assert np.abs(owed[-500:]).max() < 1.2 * np.abs(owed[:500]).max()


def test_what_is_owed_counts_what_has_been_applied(unit: Create) -> None:
    """hold less the prediction is what is owed, over the size; with F held for a step longer, that is known."""
    size = 0.01
    holds = {}
    for applied in (1.0, 2.0, 3.0):
        u = towed(unit, applied=applied)
        before = u.get("force", "impulse")
        rows = np.vstack([before, tow(u, [size] * 30, "force", "impulse")])
        holds[applied] = u.get("hold")[0]
        if applied == 1.0:
            debt = rows[-1, 1] - size * rows[:-1, 0].sum()
    assert holds[1.0] - holds[2.0] == pytest.approx(debt / size, rel=1e-9)
    assert 1e-4 < abs(holds[3.0] - holds[2.0]) < 0.2 * abs(debt / size)


def test_a_short_step_does_not_call_in_the_debt_of_long_ones(unit: Create) -> None:
    """It would be asked for in a moment, but held over the next long step."""
    u = towed(unit)
    tow(u, [0.05] * 20, "hold")
    force, hold = tow(u, [1e-9] * 3 + [1e-5], "force", "hold").T
    assert np.abs(hold - force).max() < 0.1 * np.abs(force).max()


def test_the_prediction_leaves_no_trace(unit: Create) -> None:
    """Held speed: the states, the counters and the logged events are those of the model without a coupling."""
    units = [unit(model, logging=True) for model in (TOWED, TOWED_PLAIN)]
    for u in units:
        assert u.set(u=speed(0.0), v=0.2, k_pull=400.0, extrapolation=0.0) == OK
        assert u.setup(1e-10) == OK
        assert u.initialize() == OK
    states = [tow(u, odd_sizes(300), "x", "v", "impulse", "work", "force") for u in units]
    assert np.array_equal(*states)
    assert units[0].counters() == units[1].counters()
    assert units[0].log == units[1].log
    assert len(units[0].event_times()) > 5


def test_a_prediction_that_fails_falls_back_to_the_force(unit: Create) -> None:
    """v falls below its minimum in the step after this one; that one is made and refused by itself."""
    u = unit(TOWED)
    assert u.set(u=-15.0, x=0.0, v=-15.0, k_push=0.0, k_pull=0.0, damping=100.0, applied=2.0) == OK
    assert u.setup(1e-10) == OK
    assert u.initialize() == OK
    assert u.set(a=-160.0) == OK
    assert u.step(0.02) == OK
    force, hold = u.get("force", "hold")
    assert hold == force
    assert u.messages() == []
    assert u.set(u=-15.0 - 3.2) == OK
    assert u.step(0.02) == DISCARD
    assert "v = " in u.messages("logStatusWarning")[-1]
    assert u.get("hold")[0] == hold


def test_where_the_slope_comes_from(unit: Create) -> None:
    u = towed(unit)
    size = 0.1
    ends = []
    for values, slope in (
        ({"u": 1.0}, None),
        ({"u": 1.5}, None),
        ({"u": 2.0, "a": -3.0}, None),
        ({"u": 2.0, "a": -3.0}, 7.0),
        ({"u": 2.0, "a": 4.0}, 0.0),
        ({"u": 3.0, "a": 0.0}, None),
    ):
        assert u.set(**values) == OK
        if slope is not None:
            assert u.slopes(u=slope) == OK
        assert u.step(size) == OK
        ends.append(u.get("u")[0])
    assert ends == pytest.approx([1.0, 2.0, 1.7, 2.7, 2.0, 4.0])


def test_no_slope_is_taken_from_a_step_that_is_mostly_rounding(unit: Create) -> None:
    size = 0.01
    u = towed(unit)
    tow(u, [size] * 5 + [1e-17], "u")
    assert u.time > 5 * size
    end = tow(u, [size], "u")[0, 0]
    assert abs(end - speed(u.time)) < 20.0 * size**2  # u'' is less than 20


def test_held_where_that_is_asked_for(unit: Create) -> None:
    u = towed(unit, extrapolation=0.0)
    rows = tow(u, [0.1] * 5, "u")
    assert rows[:, 0].tolist() == [speed(t) for t in (0.0, 0.1, 0.2, 0.1 + 0.2, 0.4)]


def test_an_input_that_is_not_set_stays_what_it_was(unit: Create) -> None:
    units = [towed(unit) for _ in range(2)]
    for step, value in enumerate([1.0, 1.4, 1.4, 1.4, 1.4, 0.9, 0.9]):
        for again, u in enumerate(units):
            if again or step in (0, 1, 5):
                assert u.set(u=value) == OK
            assert u.step(0.05) == OK
    assert units[0].state() == units[1].state()
    assert units[0].get("u")[0] == 0.9


def test_rollback_is_equal_bit_by_bit(unit: Create) -> None:
    u = towed(unit, k_pull=200.0)
    names = ["x", "v", "impulse", "work", "force", *REPLACED]
    for round_ in range(3):
        tow(u, odd_sizes(20), *names)
        before, saved, values = u.state(), u.save(), u.get(*names)
        first = tow(u, odd_sizes(40), *names)
        end = u.state()
        tow(u, [0.02] * (1 + round_), *names)
        status, again = u.deserialize(u.serialize(saved))
        assert status == OK
        assert u.restore(again if round_ else saved) == OK
        assert u.state() == before
        assert np.array_equal(u.get(*names), values)
        assert np.array_equal(tow(u, odd_sizes(40), *names), first)
        assert u.state() == end
        u.drop(saved)
        u.drop(again)


def test_back_to_before_the_first_step_and_reset(unit: Create) -> None:
    u = towed(unit)
    saved = u.save()
    first = tow(u, [0.01] * 30, "x", "force", *REPLACED)
    assert u.restore(saved) == OK
    assert np.array_equal(tow(u, [0.01] * 30, "x", "force", *REPLACED), first)
    u.drop(saved)
    assert u.call("fmi2Reset") == OK
    assert u.set(u=speed(0.0), v=0.2) == OK
    assert u.setup(1e-10) == OK
    assert u.initialize() == OK
    assert u.get("mean")[0] == u.get("force")[0]
    assert np.array_equal(tow(u, [0.01] * 30, "x", "force", *REPLACED), first)


def test_a_refused_step_changes_nothing(unit: Create) -> None:
    u = towed(unit)
    tow(u, [0.01] * 10, "x")
    assert u.set(u=3.0) == OK
    u.get("force")
    before = u.state()
    assert u.step(-0.01) == ERROR
    assert u.step(0.01, 99.0) == ERROR
    assert u.state() == before


def test_model_exchange_is_what_the_equations_are(unit: Create) -> None:
    u = unit(TOWED, exchange=True)
    assert u.set(u=1.0, v=0.2) == OK
    assert u.setup() == OK
    assert u.initialize() == OK
    force, *replaced = u.get("force", *REPLACED)
    assert force != 0.0 and replaced == [force, force, 0.0]


@pytest.mark.parametrize("early", [False, True])
def test_event_mode_and_early_return(unit3: Callable[..., Unit3], early: bool) -> None:
    """Steps end at the events; the means, each over what has been made, sum up all the same."""
    u = unit3(TOWED, events=True, early=early)
    assert u.set(u=speed(0.0), v=0.2, k_pull=300.0) == OK
    assert u.initialize(1e-9) == OK
    u.handle_event()
    total, events = 0.0, 0
    while u.time < 3.0:
        before = u.time
        assert u.set(u=speed(u.time)) == OK
        result = u.step(0.03)
        assert result.status == OK
        assert result.early == (result.event and early and result.time < before + 0.03)
        total += u.get("mean")[0] * (result.time - before)
        events += result.event
        if result.event:
            assert u.call("EnterEventMode") == OK
            u.handle_event()
    assert total == pytest.approx(u.get("impulse")[0], abs=1e-12)
    assert (events > 5) == early


def test_behind_an_event_that_waits_the_prediction_takes_the_new_truths(unit3: Callable[..., Unit3]) -> None:
    u = unit3(TOWED, events=True, early=True)
    assert u.set(x=-0.01, v=0.3, k_pull=300.0, applied=2.0) == OK
    assert u.initialize(1e-9) == OK
    u.handle_event()
    while not (result := u.step(0.02)).event:
        assert u.set(u=-0.5 * u.time) == OK
    hold = u.get("hold")[0]
    size = result.time % 0.02  # of the step that the event has ended
    assert u.call("EnterEventMode") == OK
    u.handle_event()
    assert u.set(u=-0.5 * u.time) == OK
    assert not u.step(size).event
    print(size, hold, u.get("mean", "force"))
    assert u.get("mean")[0] == pytest.approx(hold, rel=1e-7)


def test_a_step_that_an_event_ends_at_once_counts_for_nothing(unit3: Callable[..., Unit3]) -> None:
    """At rest, exactly on the surface x = 0, until the ball moves away."""
    u = unit3(TOWED, events=True, early=True)
    assert u.set(u=1.0, v=1.0, extrapolation=0.0) == OK
    assert u.initialize(1e-9) == OK
    u.handle_event()
    for _ in range(3):
        assert u.step(0.01).time == u.time
    assert u.set(u=0.5) == OK
    before = u.time
    result = u.step(0.01)
    assert (result.status, result.event, result.time) == (OK, True, before)
    assert u.get(*REPLACED).tolist() == [0.0, 0.0, 0.0]
    assert u.call("EnterEventMode") == OK
    u.handle_event()
    assert u.step(0.01).time == before + 0.01
    assert u.get("mean")[0] * 0.01 == pytest.approx(u.get("impulse")[0], rel=1e-12)


def test_intermediate_updates_show_the_last_step(unit3: Callable[..., Unit3]) -> None:
    seen: list[float] = []
    u = unit3(TOWED, update=lambda time: seen.append(float(u.get("mean")[0])))
    assert u.set(u=1.0) == OK
    assert u.initialize(1e-9) == OK
    assert u.step(0.1).status == OK
    mean = u.get("mean")[0]
    seen.clear()
    assert u.step(0.1).status == OK
    assert seen and set(seen) == {mean}
    assert u.get("mean")[0] != mean
