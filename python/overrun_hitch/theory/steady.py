"""Steady deceleration of the combination and of the car alone (the paper's equation 15)."""

from __future__ import annotations

from dataclasses import dataclass

from overrun_hitch.parameters import HitchError, Parameters


@dataclass(frozen=True)
class Steady:
    """Steady braking. Accelerations are positive forward, so braking gives negative ones."""

    A: float  # m/s2, acceleration of the combination
    A_c: float  # m/s2, acceleration of the car alone under the same brake torque
    ratio: float  # A / A_c (1), the price of the trailer: 1 would be a trailer that brakes for itself
    D: float  # m, drawbar compression, clearance included


def steady(parameters: Parameters, brake_torque: float) -> Steady:
    """Solve the paper's equation 15, with wheel accelerations A/R (slip is neglected beside 1) and a threshold F_0.

        A (M_t + I_t/R_t^2) = -(F_0 + k d) - d r/R_t
        A (M_c + I_c/R_c^2) =   F_0 + k d  - brake_torque/R_c        d = D - eps - F_0/k_t

    A push within F_0 leaves the trailer unbraked, and D = eps + push/k_t. brake_torque in N.m. HitchError where nothing
    holds or brakes the trailer (k = r = 0).
    """
    p = parameters
    if p.k + p.r <= 0.0:
        raise HitchError("k = 0 N/m and r = 0 N.m/m leave no steady state: one of them must be greater than 0")
    car = p.M_c + p.I_c / p.R_c**2
    trailer = p.M_t + p.I_t / p.R_t**2
    # The car carries the share of the trailer's inertia force that the drawbar spring, not the trailer brake, supplies.
    share = p.k / (p.k + p.r / p.R_t)
    A_c = -brake_torque / p.R_c / car
    ratio = car / (car + share * trailer)
    A = ratio * (A_c + (1.0 - share) * p.F_0 / car)
    d = -(A * trailer + p.F_0) / (p.k + p.r / p.R_t)
    if d >= 0.0:
        return Steady(A=A, A_c=A_c, ratio=A / A_c if p.F_0 > 0.0 else ratio, D=p.gives_from + d)
    A = car / (car + trailer) * A_c
    D = p.eps - A * trailer / p.F_0 * (p.gives_from - p.eps)
    return Steady(A=A, A_c=A_c, ratio=car / (car + trailer), D=D)
