"""How well a coupling follows a speed that it knows at the communication points only, and how a pair then oscillates.

All is linear here (k_push = k_pull), so that the truth is a matrix exponential.
"""

from __future__ import annotations

from collections.abc import Callable
from math import cos, log2, pi, sin

import numpy as np
import pytest
from scipy.linalg import expm

from tests.fmu_build.runtime.coupled_models import TOWED
from tests.fmu_build.runtime.runtime_unit import OK, Unit

Create = Callable[..., Unit]
M, K, D = 0.5, 20.0, 0.1  # of the model
SLOW, FAST = 2.0, 7.0


def speed(t: float) -> float:
    return sin(SLOW * t) + 0.3 * cos(FAST * t)


def acceleration(t: float) -> float:
    return SLOW * cos(SLOW * t) - 0.3 * FAST * sin(FAST * t)


def truth(t: float, damping: float = D) -> np.ndarray:
    """x, v, impulse at t, from rest; u is the sum of two oscillators."""
    a = np.zeros((7, 7))
    u = np.array([0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.3])
    force = np.array([K, damping, 0.0, 0.0, 0.0, 0.0, 0.0]) - damping * u
    a[0, 1] = 1.0
    a[0] -= u
    a[1], a[2] = -force / M, force
    a[3:5, 3:5] = [[0.0, SLOW], [-SLOW, 0.0]]
    a[5:7, 5:7] = [[0.0, FAST], [-FAST, 0.0]]
    return (expm(t * a) @ [0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0])[:3]


def error(unit: Create, size: float, end: float, known: bool = False, **start: float) -> np.ndarray:
    """Of x, v, impulse at `end`, corrected for the last step's speed, too, which takes one more (short) step."""
    u = unit(TOWED)
    assert u.set(u=speed(0.0), **start) == OK
    assert u.setup(1e-11) == OK
    assert u.initialize() == OK
    last = 1e-9
    sizes = [size] * round(end / size) + [last]
    for i, h in enumerate(sizes):
        t = i * size
        assert u.set(u=speed(t), a=acceleration(t) if known else 0.0) == OK
        assert u.step(h, t) == OK, u.log
    return u.get("x", "v", "impulse") - truth(end + last, start.get("damping", D))


def observed_order(unit: Create, **options: float) -> float:
    coarse, fine = (np.abs(error(unit, size, 3.0, **options)).max() for size in (0.02, 0.01))
    print(f"{coarse:.2e} {fine:.2e}")
    return log2(coarse / fine)


def test_the_error_falls_with_the_third_power_of_the_step(unit: Create) -> None:
    assert observed_order(unit) > 2.8
    assert observed_order(unit, known=True) > 2.8
    assert 0.9 < observed_order(unit, extrapolation=0.0) < 1.2  # held: this is what is avoided
    assert np.abs(error(unit, 0.01, 3.0)).max() < 1e-3 * np.abs(error(unit, 0.01, 3.0, extrapolation=0.0)).max()


@pytest.mark.full
def test_the_error_does_not_grow_in_a_thousand_seconds(unit: Create) -> None:
    """The motion is periodic by then (in pi / 5, about)."""
    early = max(np.abs(error(unit, 0.02, end)[:2]).max() for end in (19.0, 19.4, 19.8, 20.2))
    late = max(np.abs(error(unit, 0.02, end)[:2]).max() for end in (999.0, 999.4, 999.8, 1000.2))
    print(early, late)
    assert late < 1.2 * early < 1e-3


@pytest.mark.parametrize("damping", [1e2, 1e4])
def test_a_stiff_unit_is_corrected_within_bounds(unit: Create, damping: float) -> None:
    """v follows u at once (a rate of 200 or 20000 1/s at steps of 0.02 s): a plain df/du e h / 2 would throw it off."""
    x, v, _ = error(unit, 0.02, 3.0, damping=damping)
    late = np.abs(speed(3.0) - 2.0 * speed(2.98) + speed(2.96))  # the error of the extrapolated speed
    print(x, v, late)
    assert abs(v) < late
    assert abs(x) < 1e-3


# A pair: a car of mass M_CAR under the force that it is given, held over its step, and the trailer behind it.
M_CAR = 1.0


def pair(
    unit: Create, size: float, steps: int, force: str = "hold", sequential: bool = False, **start: float
) -> tuple[np.ndarray, Unit]:
    """Rows of x, u, impulse, work, energy at the communication points; `sequential`: the trailer steps first."""
    trailer = unit(TOWED)
    assert trailer.set(x=0.1, **start) == OK
    assert trailer.setup(1e-11) == OK
    assert trailer.initialize() == OK
    car, rows = 0.0, []
    for i in range(steps):
        applied = trailer.get(force)[0]  # before the new speed is known to it: both step at the same time
        assert trailer.set(u=car) == OK
        rows.append([*trailer.get("x", "impulse", "work", "energy"), car])
        assert trailer.step(size, i * size) == OK, trailer.log
        if sequential:
            applied = trailer.get(force)[0]
        car += size * applied / M_CAR
    rows.append([*trailer.get("x", "impulse", "work", "energy"), car])
    return np.array(rows), trailer


def growth(x: np.ndarray, size: float) -> float:
    """Of the one oscillation in x, 1/s: it obeys x[n + 1] = a x[n] + b x[n - 1] after the first steps."""
    tail = x[20:]
    system = np.column_stack([tail[1:-1], tail[:-2]])
    _, b = np.linalg.lstsq(system, tail[2:], rcond=None)[0]
    return float(0.5 * np.log(-b) / size)


def whole_growth() -> float:
    return -0.5 * D * (1.0 / M + 1.0 / M_CAR)


@pytest.mark.parametrize("size", [0.005, 0.01, 0.02])
def test_a_pair_decays_as_the_whole_does(unit: Create, size: float) -> None:
    """The mode is of 7.7 rad/s. The force of the step's end, held, is late by half a step."""
    steps = round(6.0 / size)
    hold, _ = pair(unit, size, steps)
    plain, _ = pair(unit, size, steps, "force", extrapolation=0.0, applied=1.0)
    mean, _ = pair(unit, size, steps, "mean", sequential=True, applied=2.0)
    errors = [growth(rows[:, 0], size) - whole_growth() for rows in (hold, plain, mean)]
    print(size, errors)
    assert abs(errors[0]) < 0.03 * abs(errors[1]) * (size / 0.01)
    assert abs(errors[2]) < 0.03 * abs(errors[1]) * (size / 0.01)


def test_momentum_of_a_pair_is_kept_but_for_what_is_owed(unit: Create) -> None:
    size = 0.01
    rows, _ = pair(unit, size, 6000)
    missing = rows[:, 1] - M_CAR * rows[:, 4]
    assert np.abs(missing).max() < size * size * 20.0  # the step's change of the force, at most
    assert np.abs(missing[-1000:]).max() <= np.abs(missing[:1000]).max()
    rows, _ = pair(unit, size, 6000, "mean", sequential=True, applied=2.0)
    car = M_CAR * rows[-1, 4]
    assert car == pytest.approx(rows[-1, 1], abs=1e-14)


@pytest.mark.parametrize("steps", [3, 100, 300])
@pytest.mark.parametrize("force", ["force", "mean", "hold"])
def test_the_account_of_energy_is_that_of_the_pair(unit: Create, force: str, steps: int) -> None:
    """The car's kinetic energy less the work that the trailer has done on it, corrected for the last speed; so one more
    short step has to be made."""
    applied = {"force": 1.0, "mean": 2.0, "hold": 3.0}[force]
    rows, trailer = pair(unit, 0.01, steps, force, sequential=force == "mean", applied=applied)
    car = rows[-1, 4]
    assert trailer.set(u=car) == OK
    assert trailer.step(1e-12, steps * 0.01) == OK
    work, told = trailer.get("work", "energy")
    made = 0.5 * M_CAR * car**2 - work
    print(made, told)
    assert abs(told) > 1e-7
    assert told == pytest.approx(made, abs=1e-11)


def test_the_energy_that_is_made_vanishes_with_the_step(unit: Create) -> None:
    ends = {}
    for name, start in (("hold", {}), ("force", {"applied": 1.0, "extrapolation": 0.0})):
        ends[name] = [abs(pair(unit, size, round(1.0 / size), name, **start)[0][-1, 3]) for size in (0.004, 0.002)]
    print(ends)
    assert log2(ends["force"][0] / ends["force"][1]) == pytest.approx(1.0, abs=0.2)
    assert log2(ends["hold"][0] / ends["hold"][1]) > 1.8
    assert ends["hold"][1] < 1e-2 * ends["force"][1]


def test_the_period_of_the_closed_form() -> None:
    """The truth itself, against a known case: undamped and at its own frequency nothing is missing."""
    assert truth(0.0) == pytest.approx([0.0, 0.0, 0.0])
    assert truth(1e-6)[0] == pytest.approx(-0.3e-6, rel=1e-4)
    assert truth(pi)[2] == pytest.approx(-M * truth(pi)[1], rel=1e-12)
