"""A coupling under a master that exchanges values more seldom than it steps, without saying when.

The model and the pair are those of test_coupling_accuracy.py, with several steps to an exchange.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest

from tests.fmu_build.runtime.coupled_models import TOWED
from tests.fmu_build.runtime.instance.test_coupling_accuracy import (
    M_CAR,
    K,
    M,
    growth,
    speed,
    truth,
    whole_growth,
)
from tests.fmu_build.runtime.runtime_unit import OK, Unit

Create = Callable[..., Unit]
STEPS = [1, 2, 5, 10, "random"]


def counts(steps: int | str, n: int) -> list[int]:
    """How many steps each of n exchanges has."""
    return np.random.default_rng(1).integers(1, 11, n).tolist() if steps == "random" else [int(steps)] * n


def begun(unit: Create, **start: float) -> Unit:
    u = unit(TOWED)
    assert u.set(**start) == OK
    assert u.setup(1e-11) == OK
    assert u.initialize() == OK
    return u


def exchange(u: Unit, value: float, end: float, steps: int, resent: bool = False) -> None:
    """u is set; the steps to `end`."""
    for i, (here, there) in enumerate(pairwise(np.linspace(u.time, end, steps + 1).tolist())):
        if resent or i == 0:
            assert u.set(u=value) == OK
        assert u.step(there - here, here) == OK, u.log


def pair(unit: Create, sizes: list[float], steps: list[int], resent: bool = False, **start: float) -> np.ndarray:
    """Rows of x, impulse, work, energy and the car's speed at the exchanges; the car gets the force to hold."""
    trailer = begun(unit, x=0.1, **start)
    car, end, rows = 0.0, 0.0, []
    for size, n in zip(sizes, steps, strict=True):
        applied = trailer.get("hold")[0]
        rows.append([*trailer.get("x", "impulse", "work", "energy"), car])
        end += size
        exchange(trailer, car, end, n, resent)
        car += size * applied / M_CAR
    rows.append([*trailer.get("x", "impulse", "work", "energy"), car])
    return np.array(rows)


def error(unit: Create, sizes: np.ndarray, steps: list[int]) -> float:
    """Of x, v, impulse after exchanges of these sizes, corrected for the last speed in one more (short) step."""
    ends, last = np.cumsum(sizes).tolist(), 1e-9
    u = begun(unit, u=speed(0.0))
    for start, end, n in zip([0.0, *ends], [*ends, ends[-1] + last], [*steps, 1], strict=True):
        exchange(u, speed(start), end, n)
    return float(np.abs(u.get("x", "v", "impulse") - truth(ends[-1] + last)).max())


@pytest.mark.parametrize("steps", STEPS)
def test_a_pair_decays_as_the_whole_does_however_often_it_steps(unit: Create, steps: int | str) -> None:
    size, n = 0.01, 600
    rows = pair(unit, [size] * n, counts(steps, n))
    single = pair(unit, [size] * n, [1] * n)
    missing = np.abs(rows[:, 1] - M_CAR * rows[:, 4])
    print(steps, growth(rows[:, 0], size) - whole_growth(), missing.max(), missing[-1])
    assert growth(rows[:, 0], size) == pytest.approx(growth(single[:, 0], size), abs=2e-5)
    assert growth(rows[:, 0], size) == pytest.approx(whole_growth(), abs=1e-3)
    assert missing.max() < size * size * 20.0  # what a step may owe at one step to an exchange


@pytest.mark.parametrize("extrapolation", [0.0, 1.0])
@pytest.mark.parametrize("steps", STEPS)
def test_equal_values_that_are_set_again_leave_no_trace(unit: Create, steps: int | str, extrapolation: float) -> None:
    ends = []
    for resent in (False, True):
        u = begun(unit, extrapolation=extrapolation, k_pull=200.0)
        for i, n in enumerate(counts(steps, 200)):
            exchange(u, speed(0.01 * i), 0.01 * (i + 1), n, resent)
        ends.append(u.state())
    assert ends[0] == ends[1]


@pytest.mark.parametrize("lengths", [(10, 10), (5, 15), (10, 20)])
@pytest.mark.parametrize("steps", STEPS)
def test_the_error_is_that_of_one_step_to_an_exchange(unit: Create, steps: int | str, lengths: tuple[int, int]) -> None:
    """Exchanges of equal or random lengths in ms. The first two are of one step: see the next test."""
    sizes = 1e-3 * np.random.default_rng(2).integers(lengths[0], lengths[1] + 1, 300)
    errors = [error(unit, sizes, [1, 1, *counts(number, 298)]) for number in (steps, 1)]
    print(steps, lengths, errors)
    assert errors[0] < 2.0 * errors[1] + 1e-5 < 1e-3


@pytest.mark.parametrize("repeats", [75, 300])
@pytest.mark.parametrize("multiples", [[1, 2], [2, 3], [1, 2, 3, 2]])
def test_steps_that_do_not_divide_an_exchange(unit: Create, multiples: list[int], repeats: int) -> None:
    """Exchanges every 1.5 or 2.5 steps: by turns of one length and of another. One stand is misjudged in all."""
    size = 0.006
    steps = [1, 1, *multiples * repeats]
    sizes = size * np.array(steps)
    errors = [error(unit, sizes, number) for number in (steps, [1] * len(steps))]
    print(multiples, errors)
    change = 2.0 * size * 2.0  # of u over two steps at the start
    one = 0.5 * size * change  # of x, from u that is taken to have changed in the second of them only
    impulse = one * np.sqrt(K * M)  # that x makes in a quarter period
    assert errors[0] < 2.0 * errors[1] + 1.5 * impulse


@pytest.mark.parametrize("ratio", [2.0, 2.5, 4.0, 10.0])
@pytest.mark.parametrize("between", [3, 9])
def test_how_long_an_exchange_may_be(unit: Create, between: int, ratio: float) -> None:
    """One in several is longer than the others. No call says that it goes on: a car that stands still makes the same
    ones. So it is told by its length: twice the longest of the last ones, which each further one forgets by a tenth."""
    short, n = 0.005, 600
    pattern = [short] * between + [short * ratio]
    sizes = pattern * (n // round(between + ratio))
    several = [round(4 * size / short) for size in sizes]
    period = sum(pattern)
    rates = [growth(pair(unit, sizes, steps)[:: len(pattern), 0], period) for steps in (several, [1] * len(sizes))]
    is_told = ratio <= 2.0 * max(1.0, ratio * 0.9**between)
    off = abs(rates[0] - rates[1])
    print(f"{ratio} times as long, once after {between}: off by {off:.5f} 1/s, {'told' if is_told else 'not told'}")
    assert (off < 2e-5) == is_told
    assert off < 0.03


@pytest.mark.parametrize("steps", STEPS)
def test_what_is_lost_before_the_length_of_an_exchange_is_known(unit: Create, steps: int | str) -> None:
    """The first change of u, by the first exchange: u is taken to have jumped at its end."""
    size = 0.01
    lost = error(unit, np.full(300, size), counts(steps, 300)) - error(unit, np.full(300, size), [1] * 300)
    print(steps, lost)
    assert lost < 1.1 * size * abs(speed(size) - speed(0.0))


@pytest.mark.parametrize("steps", STEPS)
def test_means_are_over_the_exchange(unit: Create, steps: int | str) -> None:
    u = begun(unit, k_pull=300.0)
    total = 0.0
    for i, n in enumerate(counts(steps, 200)):
        exchange(u, speed(0.01 * i), 0.01 * (i + 1), n)
        total += 0.01 * u.get("mean")[0]
        if i == 4:  # by then it is known how long an exchange is
            before = total - u.get("impulse")[0]
    assert total - u.get("impulse")[0] == pytest.approx(before, abs=1e-12)


@pytest.mark.parametrize("steps", STEPS)
@pytest.mark.parametrize("n", [100, 300])
def test_the_account_of_energy_is_that_of_the_pair(unit: Create, steps: int | str, n: int) -> None:
    """As at one step to an exchange: the car's energy less the work done on it, with one more short step."""
    size = 0.01
    rows = pair(unit, [*[size] * n, 1e-12], [*counts(steps, n), 1])
    car, told, work = rows[-2, 4], rows[-1, 3], rows[-1, 2]
    made = 0.5 * M_CAR * car**2 - work
    print(steps, made, told)
    assert abs(told) > 1e-7
    assert told == pytest.approx(made, abs=1e-11)


@pytest.mark.parametrize("steps", [1, 2, 5])
def test_a_value_that_stands_is_exchanged_in_the_end(unit: Create, steps: int) -> None:
    """The ball stops: u goes on for one exchange at one step each, for another one where values are held for several
    steps. Then it is where it stopped, and so are the states."""
    u = begun(unit)
    for i in range(20):
        exchange(u, 0.1 * i, 0.01 * (i + 1), steps)
    seen = []
    for i in range(20, 40):
        exchange(u, 2.0, 0.01 * (i + 1), steps)
        seen.append(u.get("u")[0])
    late = 1 if steps == 1 else 2
    assert seen[late - 1] == pytest.approx(2.0 + 0.1 * late)
    assert seen[late:] == [2.0] * (20 - late)


def test_a_change_after_a_long_stand_is_one_of_the_last_step(unit: Create) -> None:
    """Where every step is an exchange, a ball that starts to move after a rest is followed at once."""
    u = begun(unit)
    for i, value in enumerate([0.1, 0.2, *[0.3] * 50, 0.4]):
        exchange(u, value, 0.01 * (i + 1), 1)
    assert u.get("u")[0] == pytest.approx(0.5)


def test_rollback_inside_an_exchange(unit: Create) -> None:
    u = begun(unit)
    for i in range(20):
        exchange(u, speed(0.01 * i), 0.01 * (i + 1), 5)
    exchange(u, speed(0.2), 0.203, 2)
    before, saved = u.state(), u.save()
    ends = []
    for _ in range(2):
        exchange(u, speed(0.2), 0.21, 3)
        exchange(u, speed(0.21), 0.22, 5)
        ends.append(u.state())
        assert u.restore(saved) == OK
        assert u.state() == before
    assert ends[0] == ends[1]
    u.drop(saved)
