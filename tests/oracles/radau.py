"""The paper's nonlinear equations solved by SciPy: the oracle for every trajectory.

Provenance: equations 1 to 8 of Sharp (1982) with the three-regime drawbar of its section 6, written down from the
paper and independently of the package; only the parameters' values come from `overrun_hitch.parameters`. Signs are
the paper's: F_h is positive in tension, tyre forces are positive retarding, delta = x_t - x_c.

States (delta, v_c, v_t, omega_c, omega_t): the paper's, with the place of the car left out because nothing depends on
it and a growing coordinate would only cost digits. In each regime of the drawbar the equations are smooth, so each is
integrated on its own and ended by a located event at delta = 0 or delta = eps; no step straddles a kink.

Method: Radau IIA (scipy.integrate.solve_ivp), rtol 1e-11, at most 5 ms a step. How well it is converged is tested in
tests/overrun_hitch/test_oracle.py against DOP853, a method of another family, at rtol 1e-13: for the
paper's figures the two are within 1e-11 m and 2e-10 m/s of each other over 6 s.
"""

from __future__ import annotations

import pickle
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from overrun_hitch.parameters import Parameters
from tests.kept import kept

Floats = NDArray[np.float64]

TENSION, CLEARANCE, COMPRESSION = range(3)
NOMINAL = np.array([0.01, 10.0, 10.0, 30.0, 30.0])  # m, m/s, m/s, rad/s, rad/s: scales the absolute tolerances


@dataclass(frozen=True)
class Trajectory:
    """Samples (n,) at `time` in s, in the FMU's names and signs (F_hitch = -F_h)."""

    time: Floats
    v_car: Floats
    v_trailer: Floats
    a_car: Floats
    a_trailer: Floats
    compression: Floats
    F_hitch: Floats
    slip_car: Floats
    slip_trailer: Floats
    trailer_brake_torque: Floats
    events: tuple[float, ...]  # s, where the drawbar passes delta = 0 or delta = eps


def drawbar(p: Parameters, regime: int, delta: Floats, rate: Floats) -> tuple[Floats, Floats]:
    """F_h (N, positive in tension) and tau_t (N.m); rate = x_t' - x_c'."""
    none = np.zeros_like(delta)
    if regime == COMPRESSION:
        return -p.C * rate - p.k * (delta - p.eps), p.r * (delta - p.eps)
    if regime == CLEARANCE:
        return -p.C * rate, none
    return -p.C * rate - p.k_t * delta, none


def forces(p: Parameters, regime: int, y: Floats) -> tuple[Floats, ...]:
    """F_h, tau_t, slip_car, slip_trailer for states (5,) or (5, n)."""
    delta, v_c, v_t, omega_c, omega_t = y
    F_h, tau_t = drawbar(p, regime, delta, v_t - v_c)
    return F_h, tau_t, (v_c - p.R_c * omega_c) / v_c, (v_t - p.R_t * omega_t) / v_t


def derivatives(p: Parameters, brake_torque: float, regime: int, y: Floats) -> Floats:
    """Rates of the states (5,) or (5, n), equations 1 to 4 and 7, 8 of the paper."""
    F_h, tau_t, slip_c, slip_t = forces(p, regime, y)
    F_c, F_t = p.C_kc * slip_c, p.C_kt * slip_t
    return np.array(
        [
            y[2] - y[1],
            (-F_h - F_c) / p.M_c,
            (F_h - F_t) / p.M_t,
            (F_c * p.R_c - brake_torque) / p.I_c,
            (F_t * p.R_t - tau_t) / p.I_t,
        ]
    )


def _boundaries(p: Parameters, regime: int) -> list[tuple[float, int, int]]:
    """(delta, direction, next regime) of each way out of a regime; without clearance two regimes touch."""
    if regime == COMPRESSION:
        return [(p.eps, -1, CLEARANCE if p.eps > 0.0 else TENSION)]
    if regime == CLEARANCE:
        return [(p.eps, 1, COMPRESSION), (0.0, -1, TENSION)]
    return [(0.0, 1, CLEARANCE if p.eps > 0.0 else COMPRESSION)]


def _event(limit: float, direction: int) -> Callable[[float, Floats], float]:
    def crossing(_: float, y: Floats) -> float:
        return float(y[0] - limit)

    crossing.terminal = True  # type: ignore[attr-defined]
    crossing.direction = direction  # type: ignore[attr-defined]
    return crossing


def _first_regime(p: Parameters) -> int:
    # A start at delta = 0 without clearance: braking the car pushes the trailer on, into compression.
    if p.compression_start > p.eps or (p.compression_start == p.eps == 0.0):
        return COMPRESSION
    return CLEARANCE if p.compression_start >= 0.0 else TENSION


def solve(
    p: Parameters,
    brake_torque: float,
    time: Floats,
    *,
    method: str = "Radau",
    rtol: float = 1e-11,
    max_step: float = 5e-3,
) -> Trajectory:
    """The step brake from steady running at V_0, sampled at `time` (s, ascending from 0)."""
    y = np.array([p.compression_start, p.V_0, p.V_0, p.V_0 / p.R_c, p.V_0 / p.R_t])
    regime, t, end = _first_regime(p), 0.0, float(time[-1])
    columns: list[Floats] = []
    events: list[float] = []
    while True:
        ways_out = _boundaries(p, regime)
        solution = solve_ivp(
            lambda _, y, regime=regime: derivatives(p, brake_torque, regime, y),
            (t, end),
            y,
            method=method,
            rtol=rtol,
            atol=rtol * NOMINAL,
            max_step=max_step,
            dense_output=True,
            events=[_event(limit, direction) for limit, direction, _ in ways_out],
        )
        assert solution.success, solution.message
        last = float(solution.t[-1])
        inside = (time >= t) & ((time < last) | (time == end) & (last == end))
        if inside.any():
            columns.append(_sample(p, brake_torque, regime, solution.sol(time[inside])))
        if solution.status == 0:
            break
        way = next(i for i, found in enumerate(solution.t_events) if found.size)
        t, y, regime = last, solution.y[:, -1], ways_out[way][2]
        events.append(t)
    return Trajectory(time, *np.concatenate(columns, axis=1), events=tuple(events))


def _sample(p: Parameters, brake_torque: float, regime: int, y: Floats) -> Floats:
    F_h, tau_t, slip_c, slip_t = forces(p, regime, y)
    rates = derivatives(p, brake_torque, regime, y)
    return np.array([y[1], y[2], rates[1], rates[2], y[0], -F_h, slip_c, slip_t, tau_t])


@lru_cache(maxsize=64)
def trajectory(p: Parameters, brake_torque: float = 1000.0, duration: float = 6.0, method: str = "Radau") -> Trajectory:
    """`solve` at the oracle's accuracy, every millisecond, computed once."""

    def make(folder: Path) -> None:
        solved = solve(p, brake_torque, np.arange(round(duration * 1000) + 1) / 1000.0, method=method)
        (folder / "trajectory").write_bytes(pickle.dumps(solved))

    code = Path(__file__).read_text(encoding="utf-8")
    folder = kept(make, "trajectory", code, repr(p), f"{brake_torque!r} {duration!r}", method)
    found: Trajectory = pickle.loads((folder / "trajectory").read_bytes())
    return found
