"""Trailer.fmu stepped more often than it exchanges values with Car.fmu, by a master that says nothing about it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

import numpy as np
import pytest

from overrun_hitch.coupling.pair import SCHEMES, Coupled, Pair, opened_pair
from overrun_hitch.coupling.study import gentle_braking
from overrun_hitch.fmu.unit import Unit
from overrun_hitch.measure.oscillation import NoOscillation, measure
from overrun_hitch.parameters import CASES

HOLD = next(scheme for scheme in SCHEMES if scheme.name == "jacobi-hold")
STEPS = [1, 2, 5, 10, "random"]
V = 40.0


class Finer:
    """A unit of which each step is made in several."""

    def __init__(self, unit: Unit, count: Callable[[], int], resent: bool) -> None:
        self._unit, self._count, self._resent = unit, count, resent
        self._values: Mapping[str, float] = {}

    def __getattr__(self, name: str) -> object:
        return getattr(self._unit, name)

    def set(self, values: Mapping[str, float]) -> None:
        self._values = values
        self._unit.set(values)

    def step(self, time: float, size: float) -> None:
        points = np.linspace(time, time + size, self._count() + 1)
        for here, length in zip(points, np.diff(points), strict=False):
            if self._resent and here > time:
                self._unit.set(self._values)
            self._unit.step(here, length)


@pytest.fixture(scope="module")
def pair(pair_fmus: dict[int, dict[str, Path]]) -> Iterator[Pair]:
    with opened_pair(pair_fmus[2]["Car"], pair_fmus[2]["Trailer"]) as pair:
        yield pair


def run(pair: Pair, C: float, H: float, steps: int | str, resent: bool = False) -> Coupled:
    random = np.random.default_rng(1)
    finer = Finer(pair.trailer, lambda: int(random.integers(1, 11) if steps == "random" else steps), resent)
    braking = gentle_braking(CASES["ii"].changed({"C": C}), V)
    return Pair(pair.car, finer).run(  # type: ignore[arg-type]
        HOLD, braking.parameters, braking.brake_torque, braking.duration, H, 1e-9
    )


def growth(done: Coupled) -> float:
    seen = done.time >= 0.1
    found = measure(done.time[seen], done.values["compression"][seen])
    assert not isinstance(found, NoOscillation)
    return found.growth_rate


@pytest.mark.parametrize("C", [100.0, 500.0])
def test_growth_and_debt_are_those_of_one_step_to_an_exchange(pair: Pair, C: float) -> None:
    """Asked for: 0.001 1/s, and never more owed than an exchange transmits."""
    wanted = growth(run(pair, C, 0.01, 1))
    for steps in STEPS:
        for resent in (False, True):
            done = run(pair, C, 0.01, steps, resent)
            owed = np.abs(done.given - done.values["ball.impulse"])
            an_exchange = 0.01 * np.abs(done.values["F_hitch"]).max()
            told = np.abs(done.values["coupling_energy"]).max()
            print(f"C = {C:g}, {steps} steps, {'re-sent' if resent else 'set once'}: growth {growth(done):.5f} 1/s, "
                  f"owed at most {owed.max():.4f} of {an_exchange:.3f} N.s, {owed[-1]:.0e} at the end; "
                  f"coupling_energy at most {told:.1e} J")  # fmt: skip
            assert growth(done) == pytest.approx(wanted, abs=1e-5)
            assert owed.max() < 0.3 * an_exchange and owed[-1] < 1e-3 * an_exchange


@pytest.mark.parametrize("steps", STEPS)
@pytest.mark.parametrize("C", [100.0, 500.0])
def test_the_unit_tells_the_energy_that_is_created(pair: Pair, C: float, steps: int | str) -> None:
    """Within the bounds of one step to an exchange: see test_coupling.py."""
    done = run(pair, C, 0.005, steps)
    told, created = done.values["coupling_energy"][1:][20:], done.created[:-1][20:]
    print(f"C = {C:g}, {steps} steps: created {created[-1]:.3e} J, told {told[-1]:.3e} J")
    assert np.abs(told - created).max() < 0.01 * np.ptp(created) + 5e-5
