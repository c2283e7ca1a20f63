"""The paper's equations by SciPy: the least that a person writes who needs no FMU, as fast as it can be had.

States (delta, v_c, v_t, omega_c, omega_t), five instead of the FMU's ten: no place, no standstill, no locked wheels.
Right-hand side and Jacobian are in Python's floats, three times as fast as numpy's for so few of them, or compiled by
numba. The drawbar's regimes are branches; events would cost more. LSODA is odeint's, whose loop over the steps is
compiled; solve_ivp's takes seven times as long at the table's error.
"""

from __future__ import annotations

from collections.abc import Callable
from time import process_time
from typing import Any

import numpy as np
from scipy.integrate import odeint, solve_ivp

from benchmarks.contender import DURATION, SCENARIO, TIME, Contender, Floats, Run
from overrun_hitch.parameters import Parameters
from tests.oracles.radau import NOMINAL

try:
    from numba import njit
except ImportError:  # no wheel for this Python
    njit = None

Function = Callable[[float, Floats], Any]


def equations(p: Parameters, tau_c: float) -> tuple[Callable[..., Any], Callable[..., Any]]:
    """Rates of the five states, and their partial derivatives by them, each as a function of five floats."""
    M_c, M_t, I_c, I_t, R_c, R_t = p.M_c, p.M_t, p.I_c, p.I_t, p.R_c, p.R_t
    C_kc, C_kt, k, k_t, C, r, eps = p.C_kc, p.C_kt, p.k, p.k_t, p.C, p.r, p.eps

    def rates(delta: float, v_c: float, v_t: float, omega_c: float, omega_t: float) -> tuple[float, ...]:
        push, tau_t = C * (v_t - v_c), 0.0  # -F_h
        if delta >= eps:
            push += k * (delta - eps)
            tau_t = r * (delta - eps)
        elif delta < 0.0:
            push += k_t * delta
        F_c, F_t = C_kc * (v_c - R_c * omega_c) / v_c, C_kt * (v_t - R_t * omega_t) / v_t
        return (
            v_t - v_c,
            (push - F_c) / M_c,
            (-push - F_t) / M_t,
            (F_c * R_c - tau_c) / I_c,
            (F_t * R_t - tau_t) / I_t,
        )

    def partials(delta: float, v_c: float, v_t: float, omega_c: float, omega_t: float) -> tuple[tuple[float, ...], ...]:
        stiffness, braking = (k, r) if delta >= eps else (k_t if delta < 0.0 else 0.0, 0.0)
        spin_c, spin_t = -C_kc * R_c / v_c, -C_kt * R_t / v_t  # of F_c by omega_c, F_t by omega_t
        speed_c, speed_t = -spin_c * omega_c / v_c, -spin_t * omega_t / v_t  # by v_c, v_t
        return (
            (0.0, -1.0, 1.0, 0.0, 0.0),
            (stiffness / M_c, (-C - speed_c) / M_c, C / M_c, -spin_c / M_c, 0.0),
            (-stiffness / M_t, C / M_t, (-C - speed_t) / M_t, 0.0, -spin_t / M_t),
            (0.0, speed_c * R_c / I_c, 0.0, spin_c * R_c / I_c, 0.0),
            (-braking / I_t, 0.0, speed_t * R_t / I_t, 0.0, spin_t * R_t / I_t),
        )

    return rates, partials


def interpreted() -> tuple[Function, Function]:
    """Right-hand side and Jacobian, run by Python."""
    rates, partials = equations(SCENARIO.parameters, SCENARIO.brake_torque)
    return lambda t, y: rates(*y.tolist()), lambda t, y: np.array(partials(*y.tolist()))


def compiled() -> tuple[Function, Function]:
    """Right-hand side and Jacobian, compiled by numba at their first call."""
    rates, partials = map(njit, equations(SCENARIO.parameters, SCENARIO.brake_torque))

    @njit
    def right_hand_side(t: float, y: Floats) -> Floats:
        return np.array(rates(y[0], y[1], y[2], y[3], y[4]))

    @njit
    def jacobian(t: float, y: Floats) -> Floats:
        return np.array(partials(y[0], y[1], y[2], y[3], y[4]))

    return right_hand_side, jacobian


def contenders() -> list[Contender]:
    """Radau and LSODA, each on both right-hand sides; on numba's where it is installed."""
    ways = [("numpy", interpreted())] + ([("numba", compiled())] if njit else [])
    solvers = {"Radau": _radau, "LSODA": _lsoda}
    return [
        Contender(f"SciPy's {solver}, {way}", _started(solvers[solver], *functions))
        for solver in solvers
        for way, functions in ways
    ]


def _started(solver: Callable[..., Run], *functions: Function) -> Callable[[float, bool], Run]:
    p = SCENARIO.parameters
    start = np.array([p.compression_start, p.V_0, p.V_0, p.V_0 / p.R_c, p.V_0 / p.R_t])
    return lambda tolerance, count: solver(*functions, start, tolerance, count)


def _radau(f: Function, jacobian: Function, start: Floats, rtol: float, count: bool) -> Run:
    begin = process_time()
    found = solve_ivp(
        f,
        (0.0, DURATION),
        start,
        method="Radau",
        t_eval=TIME,
        jac=jacobian,
        rtol=rtol,
        atol=rtol * NOMINAL,
        dense_output=count,
    )
    cpu_time = process_time() - begin
    return Run(cpu_time, found.y[0], found.nfev, len(found.sol.ts) - 1 if count else None)


def _lsoda(f: Function, jacobian: Function, start: Floats, rtol: float, count: bool) -> Run:
    begin = process_time()
    states, told = odeint(f, start, TIME, tfirst=True, Dfun=jacobian, rtol=rtol, atol=rtol * NOMINAL, full_output=True)
    cpu_time = process_time() - begin
    return Run(cpu_time, states[:, 0], int(told["nfe"][-1]), int(told["nst"][-1]))
