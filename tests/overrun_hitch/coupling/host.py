"""A host that has both vehicles, as other simulators do, and lacks the hitch: two bodies on wheels with slip tyres."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

import numpy as np

from overrun_hitch.parameters import Parameters
from tests.unit import Unit

FINEST = 1e-3  # s: a quarter of the time of the wheels at 40 m/s
AGREED = 1e-10  # m/s
HELD = {1.0: "", 2.0: "_mean", 3.0: "_hold"}  # applied_force: what is appended to F_hitch and trailer_brake_torque


@dataclass
class Host:
    """The paper's equations 1 to 4, rolling forward on a level road; state: v_c, omega_c, v_t, omega_t, x_c, x_t."""

    p: Parameters
    state: np.ndarray = field(init=False)

    def __post_init__(self) -> None:
        p = self.p
        self.state = np.array([p.V_0, p.V_0 / p.R_c, p.V_0, p.V_0 / p.R_t, 0.0, p.compression_start])

    def rates(self, state: np.ndarray, F: float, T: float, brake_torque: float) -> np.ndarray:
        p = self.p
        v_c, omega_c, v_t, omega_t = state[:4].tolist()
        F_c = p.C_kc * (v_c - omega_c * p.R_c) / v_c
        F_t = p.C_kt * (v_t - omega_t * p.R_t) / v_t
        return np.array([(F - F_c) / p.M_c, (F_c * p.R_c - brake_torque) / p.I_c,
                         (-F - F_t) / p.M_t, (F_t * p.R_t - T) / p.I_t, v_c, v_t])  # fmt: skip

    def step(self, size: float, F: float, T: float, brake_torque: float) -> None:
        """By the classical method of Runge and Kutta, force and torques held."""
        n = max(1, round(size / FINEST))
        h, y = size / n, self.state
        for _ in range(n):
            a = self.rates(y, F, T, brake_torque)
            b = self.rates(y + 0.5 * h * a, F, T, brake_torque)
            c = self.rates(y + 0.5 * h * b, F, T, brake_torque)
            d = self.rates(y + h * c, F, T, brake_torque)
            y = y + h / 6.0 * (a + 2.0 * b + 2.0 * c + d)
        self.state = y

    @property
    def gap(self) -> float:
        return float(self.state[5] - self.state[4])

    @property
    def speeds(self) -> dict[str, float]:
        return {"v_car": float(self.state[0]), "v_trailer": float(self.state[2])}


@dataclass(frozen=True)
class Trace:
    """What came of a run, at the exchanges (n,), SI units."""

    time: np.ndarray
    compression: np.ndarray  # the unit's
    gap: np.ndarray  # the host's
    given: np.ndarray  # (n, 2) impulses that the host has applied, of force and torque
    transmitted: np.ndarray  # (n, 2) those of the unit
    told: np.ndarray  # J, coupling_energy
    created: np.ndarray  # J, work that the host has got by the force less the one of the unit


def masses(p: Parameters) -> dict[str, float]:
    """What the unit may be told of the host."""
    return {"M_front": p.M_c + p.I_c / p.R_c**2, "M_rear": p.M_t + p.I_t / p.R_t**2}


def coupled(
    hitch: Unit, p: Parameters, brake_torque: float, sizes: Iterable[float], order: str = "parallel",
    count: Callable[[], int] = lambda: 1, **settings: float,
) -> Trace:  # fmt: skip
    """Exchanges of these sizes (s), in the order "parallel", "hitch first" or "iterated"; or "late": parallel, but all
    that is exchanged comes one exchange later. The unit makes `count()` steps to each.
    """
    host = Host(p)
    own = {name: value for name, value in p.model_dump().items() if name in hitch.references}
    hitch.slave.reset()
    hitch.set(**(own | host.speeds | settings))
    hitch.slave.setupExperiment(tolerance=1e-9, startTime=0.0)
    hitch.slave.enterInitializationMode()
    hitch.slave.exitInitializationMode()
    end = HELD[settings.get("applied_force", 3.0)]
    outputs = (f"F_hitch{end}", f"trailer_brake_torque{end}")
    seen = ("compression", "coupling_energy", "drawbar.impulse", "brake_impulse", "drawbar.work")
    time, given, got = 0.0, np.zeros(2), 0.0
    rows = [(time, *host.state[4:], *hitch.get(*seen), *given, got)]
    old = host.speeds, hitch.get(*outputs)
    for size in sizes:
        before, new = host.state, (host.speeds, hitch.get(*outputs))
        (speeds, held), old = (old if order == "late" else new), new
        hitch.set(**speeds, compression_in=host.gap)
        if order == "iterated":
            held = _agreed(hitch, host, time, size, outputs, brake_torque)
        else:
            points = np.linspace(time, time + size, count() + 1)
            for here, length in zip(points[:-1], np.diff(points), strict=True):
                hitch.slave.doStep(here, length)
            held = hitch.get(*outputs) if order == "hitch first" else held
            host.step(size, *held, brake_torque)
        time, given = time + size, given + size * held
        got += held[0] * float((host.state - before)[4] - (host.state - before)[5])
        rows.append((time, *host.state[4:], *hitch.get(*seen), *given, got))
    t, x_c, x_t, compression, told, p_F, p_T, work, g_F, g_T, received = np.array(rows).T
    return Trace(t, compression, x_t - x_c, np.array([g_F, g_T]).T, np.array([p_F, p_T]).T, told, received - work)


def _agreed(
    hitch: Unit, host: Host, time: float, size: float, outputs: tuple[str, str], brake_torque: float
) -> np.ndarray:
    """Repeat the step, with the slopes of the speeds, until what the unit was told is what becomes of the host."""
    names = list(host.speeds)
    references = [hitch.references[name] for name in names]
    start, state, speeds = host.state, hitch.slave.getFMUstate(), np.array(list(host.speeds.values()))
    held, end = hitch.get(*outputs), speeds
    for _ in range(20):
        hitch.slave.setFMUstate(state)
        hitch.set(**dict(zip(names, speeds, strict=True)))
        hitch.slave.setRealInputDerivatives(references, [1, 1], ((end - speeds) / size).tolist())
        hitch.slave.doStep(time, size)
        host.state, held = start, hitch.get(*outputs)
        host.step(size, *held, brake_torque)
        guess, end = end, np.array(list(host.speeds.values()))
        if np.abs(end - guess).max() < AGREED:
            hitch.slave.freeFMUstate(state)
            return held
    raise AssertionError(f"no agreement at t = {time} s")
