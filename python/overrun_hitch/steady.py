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
    """Solve the paper's equation 15, with wheel accelerations A/R (slip is neglected beside 1).

        A (M_t + I_t/R_t^2) = -d (k + r/R_t)
        A (M_c + I_c/R_c^2) =  k d - brake_torque/R_c        d = D - eps

    brake_torque in N.m. HitchError where nothing holds or brakes the trailer (k = r = 0).
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
    return Steady(A=ratio * A_c, A_c=A_c, ratio=ratio, D=p.eps - ratio * A_c * trailer / (p.k + p.r / p.R_t))
