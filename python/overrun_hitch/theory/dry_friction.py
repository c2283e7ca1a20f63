"""What dry friction hides: an oscillation that linear theory lets grow, and that grows only beyond an amplitude.

Friction F_f takes 4 F_f a from a cycle of amplitude a, as much as a damper 4 F_f/(pi omega a): its describing function
(J. P. Den Hartog, Forced vibrations with combined Coulomb and viscous friction, Transactions of the ASME 53 (1931)
107-115). The smaller the amplitude, the stronger that damper. So with C below the critical damping C_crit small motions
decay, and those grow that exceed a* = 4 F_f/(pi (C_crit - C) omega).

The FMU's friction reverses over x_f = 0.1 mm (DrawbarFriction.mo), by which a* is less: x_f/a* of it.
"""

from __future__ import annotations

import math

from overrun_hitch.parameters import Parameters
from overrun_hitch.theory.boundary import critical_damping
from overrun_hitch.theory.linear import shunting_mode


def equivalent_damping(F_f: float, amplitude: float, omega: float) -> float:
    """The damper (N.s/m) that takes as much energy as friction F_f (N) from a cycle of amplitude (m), omega (1/s)."""
    return 4.0 * F_f / (math.pi * omega * amplitude)


def onset_amplitude(parameters: Parameters, V: float) -> float:
    """a* (m), the amplitude of the drawbar compression beyond which an oscillation grows at V (m/s).

    0 where the smallest grows, infinite where none does. On the linear drawbar, as long as it stays in compression.
    """
    p = parameters
    C_crit = critical_damping(p, V)
    lacking = 0.5 * (1.0 + p.rebound) * (C_crit - p.C)
    if lacking <= 0.0:
        return math.inf
    omega = float(shunting_mode(p.changed({"C": C_crit}), V).eigenvalue.imag)
    return 4.0 * p.F_f / (math.pi * lacking * omega)
