"""Where small motions are looked at: the drawbar at rest on a piece of its spring, the tyres under a force.

There the combination moves as one with the paper's linear drawbar, whose k and r are those of the piece (none of the
brake within a threshold), and whose tyres have the slope that friction leaves them: the magic formula of Tyre.mo (H. B.
Pacejka, Tyre and Vehicle Dynamics, 2nd ed. 2006, section 4.3) at the force that the deceleration asks of them, its
curvature such that a locked wheel (slip 1) brakes with mu_slide of the peak.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from overrun_hitch.parameters import DATUM, PIECES, HitchError, Parameters, with_unit
from overrun_hitch.theory.steady import braking_at, pieces

g_n = 9.80665  # m/s2, standard acceleration of free fall
C_x = 1.685  # shape of the magic formula, as in Tyre.mo
E_x1, X_peak = 0.344, 1.5329258834444335  # its curvature where a wheel locks before the peak, and the argument there
NEWTON_STEPS = 50  # from below, without overshooting: more than it takes up to the peak


@dataclass(frozen=True)
class WorkingPoint:
    """A steady state, and the combination that the paper's equations take for small motions about it."""

    linear: Parameters  # k, r, C_kc, C_kt of the point; no threshold, no other stiffness, no friction limit
    deceleration: float  # m/s2; 0: so gentle that the drawbar has just begun to give
    compression: float  # m
    stiffness: str  # the parameter that tells the stiffness here
    reach: tuple[float, float]  # m: between these compressions it holds


def working_point(parameters: Parameters, deceleration: float = 0.0) -> WorkingPoint:
    """Steady braking of the combination by `deceleration` (m/s2).

    At 0 the drawbar is where it begins to give, beyond clearance and threshold. HitchError where friction does not
    allow the deceleration, or nothing holds the trailer.
    """
    p = parameters
    if not (0.0 <= deceleration < math.inf):
        raise HitchError(f"deceleration = {deceleration:g} m/s2 is not allowed: a finite number, at least 0 m/s2, is")
    every = pieces(p)
    if deceleration > 0.0:
        piece, D, _ = braking_at(p, deceleration)
    else:
        piece, D = next(piece for piece in reversed(every) if piece.start <= p.gives_from), p.gives_from
    after = every[every.index(piece) + 1 :]
    push = piece.force + piece.slope * (D - piece.start)
    forces = (p.M_c * deceleration + push, p.M_t * deceleration - push) if deceleration > 0.0 else (0.0, 0.0)
    asked = f"{deceleration:g} m/s2"
    linear = p.changed(
        {
            "k": piece.slope,
            "r": p.r if piece.start >= p.gives_from else 0.0,
            "C_kc": p.C_kc * tyre_slope(forces[0], p.mu * p.M_c * g_n, curvature(p.C_kc, p.M_c, p), asked),
            "C_kt": p.C_kt * tyre_slope(forces[1], p.mu * p.M_t * g_n, curvature(p.C_kt, p.M_t, p), asked),
        }
    )
    end = after[0].start if after else math.inf
    reach = (piece.start, end if end < DATUM.travel else math.inf)  # the defaults are out of reach
    return WorkingPoint(linear, deceleration, D, piece.stiffness, reach)


def check_one_piece(parameters: Parameters, what: str) -> None:
    """HitchError, naming it, for what large motions meet and `what` takes no notice of: limits, other stiffnesses."""
    names = (
        *parameters.off_default("small", "large"),
        *(name for name in PIECES if getattr(parameters, name) != getattr(DATUM, name)),
    )
    for name in names:
        value = with_unit(getattr(parameters, name), Parameters.unit(name))
        raise HitchError(f"{what} does not know {name} = {value}; allowed: {getattr(DATUM, name):g}")


def curvature(C_k: float, M: float, parameters: Parameters) -> float:
    """E_x (1) of tyres with C_k (N) under M (kg), that of Tyre.mo: force(slip = 1) = mu_slide mu M g_n."""
    locked = C_k / (C_x * parameters.mu * M * g_n)
    if locked <= X_peak:
        return E_x1
    bent = math.tan((math.pi - math.asin(parameters.mu_slide)) / C_x)
    return (locked - bent) / (locked - math.atan(locked))


def tyre_slope(force: float, most: float, E_x: float, asked: str) -> float:
    """Slope of the tyre force over slip at `force` (N), over that at zero slip (1).

    most (N) is friction's limit, E_x the curvature of the magic formula.

    HitchError, naming what is `asked`, where the limit does not allow it.
    """
    if not abs(force) < most:
        raise HitchError(f"mu does not allow {asked}: that takes {abs(force):.4g} N, friction gives {most:.4g} N")
    angle = math.asin(abs(force) / most) / C_x
    y = X = math.tan(angle)
    for _ in range(NEWTON_STEPS):  # y = X - E_x (X - atan X)
        X += (y - X + E_x * (X - math.atan(X))) / (1.0 - E_x * X**2 / (1.0 + X**2))
    return math.cos(C_x * angle) / (1.0 + y**2) * (1.0 - E_x * X**2 / (1.0 + X**2))
