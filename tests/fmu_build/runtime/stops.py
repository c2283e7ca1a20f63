"""Step brakes from 30 m/s to standstill and 10 s beyond on a grid, a row each: `make stops`.

Steps, events and times are those of a run at the default tolerance with communication steps of 10 ms. Energy is that of
a second run at 1e-8, sampled so finely that the account closes. The way is compared with the one that follows from the
energy: what the start had, less what else has gone, over what the car's brakes take from a metre, torque/R_c. Where the
car's wheels slide it is the force of a tyre that slides, from when they have locked for good. Exit status 1 where a
row is out of bounds.
"""

from __future__ import annotations

import multiprocessing
import sys
from dataclasses import dataclass
from functools import partial
from itertools import product
from pathlib import Path

import numpy as np

from overrun_hitch.parameters import DATUM, Parameters
from tests.energy import G_N, NAMES, Account, account
from tests.fmu_build.runtime.generated_models import GeneratedModel, generate
from tests.fmu_build.runtime.runtime_unit import OK, Library, Unit, compile_model, load

LIBRARY = Path(__file__).parents[3] / "modelica" / "OverrunHitch"
STEP, BEYOND, LONGEST = 0.01, 10.0, 300.0  # s
SAMPLES = (1e-3, 2.5e-4, 5e-5)  # s; the next where the account does not close
DAMPERS = (0.0, 20.0, 100.0, 500.0, 3200.0)  # N.s/m
CLEARANCES = (0.0, 0.1)  # m
GRADES = (-0.1, -0.05, 0.0, 0.05, 0.1)
TORQUES = {1.0: (2000.0, 4000.0), 0.3: (900.0, 1600.0)}  # N.m by friction; each second one locks the car's wheels
LIMITS = {"speed": 1e-6, "way": 1e-3, "energy": 1e-6}  # m/s, and relative
COASTING = 100.0  # N.s/m: such a damper takes 5 s to make a trailer in the clearance 2.7 times slower
LAGS, FRICTIONS = (0.02, 0.05), (0.0, 100.0)  # s, N: of a device that lags and rubs, on some of the grid
HEAD = (
    "|    C |  eps | tau_b |  F_f |  mu | grade | torque | standstill |   rest | steps | tries | events |   speed "
    "|      way |  off by | energy |"
)


@dataclass(frozen=True)
class Case:
    C: float
    eps: float
    mu: float
    grade: float
    torque: float
    tau_b: float = 0.0
    F_f: float = 0.0

    @property
    def locks(self) -> bool:
        """The car's wheels do, and stay locked."""
        return self.torque == TORQUES[self.mu][1]

    @property
    def parameters(self) -> Parameters:
        set_here = {name: getattr(self, name) for name in ("C", "eps", "mu", "tau_b", "F_f")}
        return DATUM.changed({"V_0": 30.0, **set_here})


@dataclass(frozen=True)
class Row:
    """s, counts, m/s, m, and relative."""

    standstill: float
    rest: float
    steps: int
    tries: int
    events: int
    speed: float
    way: float
    off: float
    energy: float
    duration: float
    coasts: bool  # nothing holds the trailer: it moves in the clearance, whose damper is weak

    def __str__(self) -> str:
        return (
            f"| {self.standstill:8.2f} s | {self.rest:4.1f} s | {self.steps:5d} | {self.tries:5d} | {self.events:6d} "
            f"| {self.speed:.1e} | {self.way:6.1f} m | {self.off:7.0e} | {self.energy:.0e} |"
        )

    @property
    def bad(self) -> list[str]:
        """What is out of bounds; NaN is."""
        points = self.duration / STEP
        found = {
            "no rest": self.coasts or self.rest <= self.duration - 0.5 * BEYOND,
            "speed": self.coasts or self.speed < LIMITS["speed"],
            "way": self.off < LIMITS["way"],
            "energy": self.energy < LIMITS["energy"],
            "steps": self.tries < 3.0 * points,
            "events": self.events < 12.0 * self.standstill,
        }
        return [name for name, good in found.items() if not good]


def started(library: Library, case: Case, tolerance: float) -> Unit:
    unit = Unit(library, logging=True)
    assert unit.setup(tolerance) == OK
    assert unit.set(brake_torque=case.torque, grade=case.grade, **case.parameters.model_dump()) == OK, unit.log
    assert unit.initialize() == OK, unit.log
    return unit


def stop(model: GeneratedModel, path: Path, case: Case) -> Row:
    """Both runs."""
    library = Library(model, path, load(path))  # type: ignore[arg-type]
    unit, speeds, slow = started(library, case, 1e-6), [], 0
    while slow * STEP < BEYOND and len(speeds) * STEP < LONGEST:
        assert unit.step(STEP, len(speeds) * STEP) == OK, unit.log
        speeds.append(np.abs(unit.get("v_car", "v_trailer")).max())
        slow = slow + 1 if speeds[-1] < 0.1 else 0
    counters = unit.counters()
    (compression,) = unit.get("compression")
    unit.free()
    moving = np.flatnonzero(~(np.array(speeds) < LIMITS["speed"]))
    duration = len(speeds) * STEP
    energy = closed(library, case, duration)
    way, expected = ways(case, energy)
    return Row(
        standstill=(len(speeds) - slow) * STEP,
        rest=(moving[-1] + 1) * STEP,
        steps=counters.steps,
        tries=counters.steps + counters.rejected + counters.repeated,
        events=counters.events,
        speed=float(speeds[-1]),
        way=way,
        off=abs(way / expected - 1.0),
        energy=energy.imbalance / energy.stored[0],
        duration=duration,
        coasts=case.C <= COASTING and 0.0 < compression < case.eps,
    )


def closed(library: Library, case: Case, duration: float) -> Account:
    """The account of a run at 1e-8, sampled more finely until it closes."""
    for h in SAMPLES:
        unit, rows = started(library, case, 1e-8), []
        for n in range(round(duration / h)):
            rows.append(unit.get(*NAMES))
            assert unit.step(h, n * h) == OK, unit.log
        unit.free()
        found = account(case.parameters, case.grade, h, np.array(rows))
        if found.imbalance < LIMITS["energy"] * found.stored[0]:
            break
    return found


def ways(case: Case, energy: Account) -> tuple[float, float]:
    """The car's way (m) until it stands, and what it is by the energy."""
    p, x, v = case.parameters, energy.values["car.body.x"], energy.values["car.body.v"]
    rolled = p.R_c * energy.values["car.wheel.omega"]
    last = int(np.argmax(v <= 0.0)) or len(v) - 1
    weight = (p.M_c + p.M_t) * G_N * np.sin(np.arctan(case.grade))
    left = energy.stored - weight * x + sum(gone for name, gone in energy.gone.items() if name != "car brakes")
    if not case.locks:
        slid = np.trapezoid((v - rolled)[: last + 1], energy.time[: last + 1])
        force = case.torque / p.R_c
        return float(x[last]), float((left[0] - left[last] + force * slid) / (force + weight))
    last = int(np.argmax(v <= 1.0))  # before the tyres take hold
    first = last - int(np.argmax(np.abs(rolled[last::-1]) > 1e-3 * v[last::-1])) + 1
    left -= energy.gone["car tyres"]
    force = p.mu * p.M_c * G_N * np.cos(np.arctan(case.grade)) * sliding(p, case.grade)
    return float(x[last] - x[first]), float((left[first] - left[last]) / (force + weight))


def sliding(p: Parameters, grade: float) -> float:
    """Force of the car's sliding tyres over the largest: the magic formula at a slip of 1."""
    level = p.C_kc / (1.685 * p.mu * p.M_c * G_N)
    E = (level - np.tan((np.pi - np.arcsin(p.mu_slide)) / 1.685)) / (level - np.arctan(level))
    X = level / np.cos(np.arctan(grade))
    return float(np.sin(1.685 * np.arctan(X - E * (X - np.arctan(X)))))


def main() -> int:
    """Print the table and what is out of bounds."""
    cases = [
        Case(C, eps, mu, grade, torque)
        for mu, C, eps, grade in product(TORQUES, DAMPERS, CLEARANCES, GRADES)
        for torque in TORQUES[mu]
    ]
    cases += [
        Case(500.0, 0.0, mu, grade, torque, tau_b, F_f)
        for mu, grade, tau_b, F_f in product(TORQUES, (-0.1, 0.0, 0.1), LAGS, FRICTIONS)
        for torque in TORQUES[mu]
    ]
    bad = 0
    print(HEAD)
    print("|".join("-" * len(cell) for cell in HEAD.split("|")))
    model = generate(LIBRARY, "OverrunHitch.Systems.CarTrailer")
    path = compile_model(model).path  # type: ignore[arg-type]
    with multiprocessing.Pool(2) as pool:
        for case, row in zip(cases, pool.imap(partial(stop, model, path), cases), strict=True):
            bad += bool(row.bad)
            device = f"| {case.C:4g} | {case.eps:4g} | {case.tau_b:5g} | {case.F_f:4g} "
            road = f"| {case.mu:3g} | {case.grade:5g} | {case.torque:6g} "
            print(f"{device}{road}{row} {', '.join(row.bad)}{' coasts' * row.coasts}", flush=True)
    print(f"{len(cases)} stops, {bad} out of bounds")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
