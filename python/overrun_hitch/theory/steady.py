"""Steady deceleration of the combination and of the car alone (the paper's equation 15)."""

from __future__ import annotations

import math
from dataclasses import dataclass

from overrun_hitch.parameters import HitchError, Parameters


@dataclass(frozen=True)
class Steady:
    """Steady braking. Accelerations are positive forward, so braking gives negative ones."""

    A: float  # m/s2, acceleration of the combination
    A_c: float  # m/s2, acceleration of the car alone under the same brake torque
    ratio: float  # A / A_c (1), the price of the trailer: 1 would be a trailer that brakes for itself
    D: float  # m, drawbar compression, clearance included


@dataclass(frozen=True)
class Piece:
    """A part of the drawbar's spring over which its stiffness is one."""

    stiffness: str  # the parameter that tells it
    start: float  # m, compression
    force: float  # N, at the start
    slope: float  # N/m


def steady(parameters: Parameters, brake_torque: float) -> Steady:
    """Solve the paper's equation 15, with wheel accelerations A/R (slip is neglected beside 1) and a threshold F_0.

        A (M_t + I_t/R_t^2) = -(F_0 + k d) - d r/R_t
        A (M_c + I_c/R_c^2) =   F_0 + k d  - brake_torque/R_c        d = D - eps - F_0/k_t

    A push within F_0 leaves the trailer unbraked, and D = eps + push/k_t. Where d passes another stiffness, the force
    of the spring takes the place of F_0 + k d. brake_torque in N.m. HitchError where nothing holds or brakes the
    trailer (k = r = 0). Drag and rolling resistance are left out.
    """
    p = parameters
    if p.k + p.r <= 0.0:
        raise HitchError("k = 0 N/m and r = 0 N.m/m leave no steady state: one of them must be greater than 0")
    car, trailer = inertias(p)
    # The car carries the share of the trailer's inertia force that the drawbar spring, not the trailer brake, supplies.
    share = p.k / (p.k + p.r / p.R_t)
    A_c = -brake_torque / p.R_c / car
    ratio = car / (car + share * trailer)
    A = ratio * (A_c + (1.0 - share) * p.F_0 / car)
    d = -(A * trailer + p.F_0) / (p.k + p.r / p.R_t)
    if d < 0.0:
        A = car / (car + trailer) * A_c
        D = p.eps - A * trailer / p.F_0 * (p.gives_from - p.eps)
        return Steady(A=A, A_c=A_c, ratio=car / (car + trailer), D=D)
    D = p.gives_from + d
    if p.linear_until < D:
        D, A = _on_any_piece(p, brake_torque)
        return Steady(A=A, A_c=A_c, ratio=A / A_c, D=D)
    return Steady(A=A, A_c=A_c, ratio=A / A_c if p.F_0 > 0.0 else ratio, D=D)


def inertias(parameters: Parameters) -> tuple[float, float]:
    """Mass of car and trailer with what their wheels add, I/R^2, in kg."""
    p = parameters
    return p.M_c + p.I_c / p.R_c**2, p.M_t + p.I_t / p.R_t**2


def pieces(parameters: Parameters) -> tuple[Piece, ...]:
    """The spring from the clearance on, as in DrawbarSpring.mo."""
    p = parameters
    end = max(p.gives_from, p.travel)
    second = min(max(p.gives_from, p.eps + p.x_2), end)
    third = min(max(second, p.eps + p.x_3), end)
    starts = {"k_t": p.eps, "k": p.gives_from, "k_2": second, "k_3": third, "k_buffer": end}
    found, force = [], 0.0
    for (name, start), stop in zip(starts.items(), [*list(starts.values())[1:], math.inf], strict=True):
        if stop > start:
            slope = float(getattr(p, name))
            found.append(Piece(name, start, force, slope))
            force += slope * (stop - start)
    return tuple(found)


def braking_at(parameters: Parameters, deceleration: float) -> tuple[Piece, float, float]:
    """The piece of the spring, the compression (m) and the car's brake torque (N.m) of a steady deceleration (m/s2)."""
    p = parameters
    car, trailer = inertias(p)
    piece, D = _resting(p, 1.0, trailer * deceleration)
    return piece, D, p.R_c * (car * deceleration + piece.force + piece.slope * (D - piece.start))


def _on_any_piece(parameters: Parameters, brake_torque: float) -> tuple[float, float]:
    """D (m) and A (m/s2): that of the car, car A = F - T, is that of the trailer, trailer A = -(F + B)."""
    p = parameters
    car, trailer = inertias(p)
    piece, D = _resting(p, 1.0 + trailer / car, trailer / car * brake_torque / p.R_c)
    return D, (piece.force + piece.slope * (D - piece.start) - brake_torque / p.R_c) / car


def _resting(parameters: Parameters, share: float, load: float) -> tuple[Piece, float]:
    """The piece and the compression (m) at which `share` of the spring's force, and the brakes, carry `load` (N)."""
    p = parameters
    for piece in reversed(pieces(p)):
        brake = p.r / p.R_t if piece.start >= p.gives_from else 0.0
        beyond = load - share * piece.force - brake * (piece.start - p.gives_from)
        if beyond >= 0.0:
            gives = share * piece.slope + brake
            if not gives > 0.0:
                raise HitchError(f"{piece.stiffness} = 0 N/m and r = 0 N.m/m hold no trailer that pushes")
            return piece, piece.start + beyond / gives
    raise HitchError("a drawbar that is not pushed has no piece of the spring to rest on")
