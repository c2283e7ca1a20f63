"""Car.fmu and Trailer.fmu coupled as masters couple them: step by step, speed one way and force the other.

What a scheme does to the oscillation, for light damping (k in N/m, H the step in s, m_c = M_c + I_c/R_c^2): a force
that reaches the car late by T takes damping away, and the growth rate of the shunting mode rises by k T / (2 m_c). A
force or a speed that is held over a step is late by H/2 on average; one taken from the end of the last step is held so.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from overrun_hitch.fmu.guest import Guest, GuestLost
from overrun_hitch.fmu.messages import StepRefused
from overrun_hitch.fmu.opening import opened
from overrun_hitch.fmu.settings import TIME_LIMIT, checked_time_limit
from overrun_hitch.fmu.unit import Unit
from overrun_hitch.parameters import HitchError, Parameters

Floats = NDArray[np.float64]

FORCES = {"F_hitch": 1.0, "F_hitch_mean": 2.0, "F_hitch_hold": 3.0}  # output: value of applied_force
TRAILER_OUTPUTS = ("compression", "v_rel", "v_trailer", "F_hitch", "coupling_energy", "ball.impulse", "ball.work")
CAR_OUTPUTS = ("v_car", "a_car", "car.body.x")
CAR_PARAMETERS = Parameters.having("of", "car", "both")
TRAILER_PARAMETERS = Parameters.having("of", "trailer", "link", "both")
AGREED = 1e-10  # m/s: iterations end when the car's speed at the end of a step moves by less
ITERATIONS = 50


@dataclass(frozen=True)
class Scheme:
    """How a master exchanges speed and force."""

    name: str
    what: str
    order: str  # "parallel", "trailer first", "car first" or "iterated"
    force: str  # the output of the trailer that the car gets
    extrapolation: float  # 1: the trailer extrapolates the car's speed inside a step; 0: it is held
    lateness: float  # steps by which force and speed are late in all: T / H of the closed form
    alone: bool = False  # Hitch.fmu between two bodies (trio.py) instead of Trailer.fmu behind a car


SCHEMES = (
    Scheme("jacobi", "Jacobi, values held", "parallel", "F_hitch", 0.0, 1.0),
    Scheme("jacobi-speed", "Jacobi, speed extrapolated", "parallel", "F_hitch", 1.0, 0.5),
    Scheme("jacobi-hold", "Jacobi, speed extrapolated, F_hitch_hold", "parallel", "F_hitch_hold", 1.0, 0.0),
    Scheme("trailer-first", "Gauss-Seidel, trailer first, speed held", "trailer first", "F_hitch", 0.0, 0.0),
    Scheme("trailer-mean", "Gauss-Seidel, trailer first, speed extrapolated, F_hitch_mean", "trailer first",
           "F_hitch_mean", 1.0, 0.0),
    Scheme("car-first", "Gauss-Seidel, car first, speed interpolated", "car first", "F_hitch", 0.0, 0.5),
    Scheme("iterated", "iterated with rollback, F_hitch_mean", "iterated", "F_hitch_mean", 0.0, 0.0),
    Scheme("alone", "hitch alone: Jacobi, values held", "parallel", "F_hitch", 0.0, 1.0, alone=True),
    Scheme("alone-hold", "hitch alone: Jacobi, speeds extrapolated, force and torque to hold", "parallel",
           "F_hitch_hold", 1.0, 0.0, alone=True),
)  # fmt: skip


@dataclass(frozen=True)
class Coupled:
    """A coupled run at the communication points (n,), SI units."""

    time: Floats
    values: Mapping[str, Floats]  # CAR_OUTPUTS and TRAILER_OUTPUTS
    given: Floats  # N.s, the impulse that the car has got
    created: Floats  # J, work done on the car less work that the trailer did: what the coupling has fed in


@dataclass(frozen=True)
class Pair:
    """Both units, open."""

    car: Unit
    trailer: Unit

    def run(
        self, scheme: Scheme, parameters: Parameters, brake_torque: float, duration: float, H: float, tolerance: float
    ) -> Coupled:
        """`duration` s in steps of H s, from the start of `parameters`, braked by `brake_torque` N.m."""
        p = parameters.model_dump()
        self.car.start_with({name: p[name] for name in CAR_PARAMETERS} | {"brake_torque": brake_torque}, tolerance)
        settings = {"v_car": p["V_0"], "extrapolation": scheme.extrapolation, "applied_force": FORCES[scheme.force]}
        self.trailer.start_with({name: p[name] for name in TRAILER_PARAMETERS} | settings, tolerance)
        force = self.trailer.get([scheme.force])[0]
        advance = ADVANCES[scheme.order]
        rows, given, created = [self._outputs()], [0.0], [0.0]
        for n in range(round(duration / H)):
            applied, force = advance(self, scheme, n * H, H, force)
            rows.append(self._outputs())
            given.append(given[-1] + applied * H)
            place, work = CAR_OUTPUTS.index("car.body.x"), len(CAR_OUTPUTS) + TRAILER_OUTPUTS.index("ball.work")
            moved, done = rows[-1][place] - rows[-2][place], rows[-1][work] - rows[-2][work]
            created.append(created[-1] + applied * moved - done)
        table = np.array(rows).T
        names = (*CAR_OUTPUTS, *TRAILER_OUTPUTS)
        time: Floats = np.arange(len(rows), dtype=np.float64) * H
        return Coupled(time, dict(zip(names, table, strict=True)), np.array(given), np.array(created))

    def _outputs(self) -> list[float]:
        return [*self.car.get(CAR_OUTPUTS), *self.trailer.get(TRAILER_OUTPUTS)]

    def speed(self) -> float:
        """The car's speed in m/s."""
        return self.car.get(["v_car"])[0]


def _parallel(pair: Pair, scheme: Scheme, time: float, H: float, force: float) -> tuple[float, float]:
    """One step; the force (N) that the car got, and the one that it is to get next."""
    pair.trailer.set({"v_car": pair.speed()})
    pair.car.set({"F_hitch": force})
    pair.trailer.step(time, H)
    pair.car.step(time, H)
    return force, pair.trailer.get([scheme.force])[0]


def _trailer_first(pair: Pair, scheme: Scheme, time: float, H: float, force: float) -> tuple[float, float]:
    pair.trailer.set({"v_car": pair.speed()})
    pair.trailer.step(time, H)
    force = pair.trailer.get([scheme.force])[0]
    pair.car.set({"F_hitch": force})
    pair.car.step(time, H)
    return force, force


def _car_first(pair: Pair, scheme: Scheme, time: float, H: float, force: float) -> tuple[float, float]:
    before = pair.speed()
    pair.car.set({"F_hitch": force})
    pair.car.step(time, H)
    pair.trailer.set({"v_car": before})
    pair.trailer.set_slopes({"v_car": (pair.speed() - before) / H})
    pair.trailer.step(time, H)
    return force, pair.trailer.get([scheme.force])[0]


def _iterated(pair: Pair, scheme: Scheme, time: float, H: float, force: float) -> tuple[float, float]:
    """Repeat the step until the speed that the trailer was given is the speed that the car then has."""
    before = pair.speed()
    end = before + H * pair.car.get(["a_car"])[0]
    with pair.car.saved() as back_car, pair.trailer.saved() as back_trailer:
        for _ in range(ITERATIONS):
            pair.trailer.set({"v_car": before})
            pair.trailer.set_slopes({"v_car": (end - before) / H})
            pair.trailer.step(time, H)
            force = pair.trailer.get([scheme.force])[0]
            pair.car.set({"F_hitch": force})
            pair.car.step(time, H)
            guess, end = end, pair.speed()
            if abs(end - guess) < AGREED:
                break
            back_car()
            back_trailer()
        else:
            raise StepRefused(f"at t = {time:g} s {ITERATIONS} iterations with H = {H:g} s do not converge")
    return force, force


ADVANCES: Mapping[str, Callable[[Pair, Scheme, float, float, float], tuple[float, float]]] = {
    "parallel": _parallel,
    "trailer first": _trailer_first,
    "car first": _car_first,
    "iterated": _iterated,
}


class Units(Protocol):
    """What makes a coupled run: Pair, trio.Trio, or either of them in a process of its own."""

    def run(
        self, scheme: Scheme, parameters: Parameters, brake_torque: float, duration: float, H: float, tolerance: float
    ) -> Coupled:
        """See Pair.run."""


def _run(units: Units, *arguments: Any) -> Coupled:
    return units.run(*arguments)


class GuestUnits:
    """Units in a process of their own, where their runs are made."""

    def __init__(self, guest: Guest) -> None:
        self._guest = guest

    def run(
        self, scheme: Scheme, parameters: Parameters, brake_torque: float, duration: float, H: float, tolerance: float
    ) -> Coupled:
        """As Pair.run; HitchError where that takes too long or crashes."""
        try:
            coupled: Coupled = self._guest.call(_run, scheme, parameters, brake_torque, duration, H, tolerance)
        except GuestLost as error:
            raise HitchError(f"{error}; the run was {scheme.name!r} with H = {H:g} s") from None
        return coupled


@contextmanager
def guest_pair(car: Path, trailer: Path, time_limit: float = TIME_LIMIT) -> Iterator[GuestUnits]:
    """Both FMU files open in one process, as masters have them: each of their thousands of calls is answered at once.

    `time_limit` in s, for each run.
    """
    limit = checked_time_limit(time_limit)
    with Guest(f"{car} with {trailer}", limit, opened_pair, car, trailer) as guest:
        yield GuestUnits(guest)


@contextmanager
def opened_pair(car: Path, trailer: Path) -> Iterator[Pair]:
    """Both FMU files open, in this process. HitchError as for unit.opened."""
    car_names = [*CAR_OUTPUTS, *CAR_PARAMETERS, "brake_torque", "F_hitch"]
    trailer_names = [*TRAILER_OUTPUTS, *TRAILER_PARAMETERS, *FORCES, "v_car", "extrapolation", "applied_force"]
    with opened(car, car_names, "a car") as first, opened(trailer, trailer_names, "a trailer") as second:
        yield Pair(first, second)
