"""How shunting grows and fades while the combination brakes to standstill: linear theory along the falling speed.

Braking steadily, speed falls as V = V_0 + A t (steady.py). It falls slowly against the oscillation, so at each moment
the shunting mode has the growth rate sigma(V) of linear.py, and a disturbance of the compression the amplitude

    a(t) = a(0) exp(integral of sigma(V) dt).

That is the first term of the WKB expansion. With y' = M(V) y, M r = lambda r, l M = lambda l, l r = 1, the next one
adds -l dr/dt to lambda. With r counted from the compression, that is how far the mode's shape (the lag of the wheels,
in proportion to V) changes from V_0 to rest, however slowly that happens: less than 0.1 % of the amplitude for case ii
from 40 m/s (tests/overrun_hitch/paper/test_envelope.py), so it is left out. Nothing of the kind is left out of
`integrated_compression`, the linear equations solved with falling speed.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import cumulative_trapezoid, solve_ivp
from scipy.optimize import brentq

from overrun_hitch.parameters import HitchError, Parameters, Scenario
from overrun_hitch.theory.linear import compression_matrix, shunting_mode
from overrun_hitch.theory.steady import steady
from overrun_hitch.theory.working_point import check_one_piece

Floats = NDArray[np.float64]

SPEEDS = 400  # at which the growth rate is computed: it is almost a straight line over V
RELATIVE_TOLERANCE = 1e-8
NOMINAL = np.array([0.01, 10.0, 10.0, 30.0, 30.0])  # m, m/s, m/s, rad/s, rad/s: scales the absolute tolerances


def speed(scenario: Scenario, time: Floats) -> Floats:
    """V (n,) in m/s of steady braking at `time` (n,) in s. HitchError for a time at which the combination stands,
    and, naming it, for a parameter that one linear equation cannot follow from there on (limits, other stiffnesses).
    """
    p = scenario.parameters
    check_one_piece(p, "the predicted envelope")
    V = p.V_0 + steady(p, scenario.brake_torque).A * time
    if not V.min() > 0.0:
        raise HitchError(
            f"t = {time.max():g} s is not allowed: the combination stands by then, linear theory needs speed"
        )
    return np.asarray(V)


def predicted_amplitude(scenario: Scenario, time: Floats) -> Floats:
    """Amplitude (n,) in m of the compression about its steady value at `time` (n,) in s.

    The disturbance is that of the start, `compression_start` less the steady D. The wheels, which start without slip,
    give another, a quarter of a period off: for case ii at 1000 N.m some 0.2 mm, which add 5 % to a start of 0.5 mm.
    """
    p = scenario.parameters
    instants = np.linspace(0.0, float(time.max()), SPEEDS)
    growth_rate = shunting_mode(p, speed(scenario, instants)).growth_rate
    exponent = cumulative_trapezoid(growth_rate, instants, initial=0.0)
    start = abs(p.compression_start - steady(p, scenario.brake_torque).D)
    return np.asarray(start * np.exp(np.interp(time, instants, exponent)))


def integrated_compression(scenario: Scenario, time: Floats) -> Floats:
    """Compression (n,) in m at `time` (n,) in s, ascending: the paper's linear equations with V falling as it does.

    Solved by SciPy's Radau (the wheels' modes stiffen as 1/V) from what the FMU starts with: wheels without slip.
    """
    p = scenario.parameters
    if p.sigma > 0.0:
        raise HitchError(f"the paper's equations do not know sigma = {p.sigma:g} m")
    A = steady(p, scenario.brake_torque).A
    torque = np.array([0.0, 0.0, 0.0, -scenario.brake_torque / p.I_c, 0.0])
    start = np.array([p.compression_start - p.eps, p.V_0, p.V_0, p.V_0 / p.R_c, p.V_0 / p.R_t])
    nominal = NOMINAL
    if p.tau_b > 0.0:  # the trailer's brake has followed
        torque, start = np.append(torque, 0.0), np.append(start, p.r * start[0])
        nominal = np.append(NOMINAL, p.r * NOMINAL[0])
    speed(scenario, time)
    # Tyres alone depend on V, in proportion to 1/V: two matrices hold all others.
    tyres = 2.0 * (compression_matrix(p, 1.0) - compression_matrix(p, 2.0))
    drawbar = compression_matrix(p, 1.0) - tyres

    def matrix(t: float, _: Floats) -> Floats:
        return np.asarray(drawbar + tyres / (p.V_0 + A * t))

    solution = solve_ivp(
        lambda t, y: matrix(t, y) @ y + torque,
        (0.0, float(time[-1])),
        start,
        method="Radau",
        jac=matrix,
        t_eval=time,
        rtol=RELATIVE_TOLERANCE,
        atol=RELATIVE_TOLERANCE * nominal,
    )
    return np.asarray(solution.y[0] + p.eps)


def turning_speed(parameters: Parameters, fastest: float) -> float:
    """The speed (m/s) below which shunting fades and above which it grows; NaN if there is none up to `fastest`."""

    check_one_piece(parameters, "the turning speed")

    def growth(V: float) -> float:
        return float(shunting_mode(parameters, V).growth_rate)

    if growth(fastest) <= 0.0 or growth(1e-3 * fastest) >= 0.0:
        return float("nan")
    return float(brentq(growth, 1e-3 * fastest, fastest))
