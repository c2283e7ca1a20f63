"""The root loci of the paper's figures 4 and 5: whose, at which speed, at which damper coefficients."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from overrun_hitch.experiments.free_vibration import MeasuredMode, measured_mode
from overrun_hitch.fmu.unit import AnyUnit
from overrun_hitch.parameters import CASES, Parameters
from overrun_hitch.theory.linear import ShuntingMode, shunting_mode

# The text names C = 3200 N.s/m alone; halved six times it is lightly damped, and the printed amplitude ratios come out.
DAMPERS = tuple(50.0 * 2.0**n for n in range(7))  # N.s/m
V = 20.0  # m/s, unless the curve says otherwise


@dataclass(frozen=True)
class Curve:
    """A root locus over C; `parameters` are those of every point but for C."""

    label: str
    parameters: Parameters
    V: float = V  # m/s

    def theory(self, C: float) -> ShuntingMode:
        """The shunting mode at C (N.s/m) by the linear module."""
        return shunting_mode(self.parameters.changed({"C": C}), self.V)


def _scaled(k: float) -> Parameters:
    """Case ii with another k, and r/k as it was."""
    return CASES["ii"].changed({"k": k, "r": CASES["ii"].r / CASES["ii"].k * k})


CURVES: Mapping[str, tuple[Curve, ...]] = {
    "4": (
        Curve("case i", CASES["i"]),
        Curve("case ii", CASES["ii"]),
        Curve("case iii", CASES["iii"]),
        Curve("case ii, k halved", _scaled(0.5 * CASES["ii"].k)),
        Curve("case ii, V = 10 m/s", _scaled(5398.0), 10.0),
        Curve("case ii, V = 40 m/s", _scaled(5562.0), 40.0),
    ),
    "5": tuple(Curve(f"case {case}", CASES[case]) for case in ("iv", "v", "vi", "vii", "viii", "ix")),
}


@dataclass(frozen=True)
class Locus:
    """A curve with theory and the FMU at each of DAMPERS."""

    curve: Curve
    theory: tuple[ShuntingMode, ...]
    fmu: tuple[MeasuredMode, ...]

    def growth_rates(self, side: str) -> NDArray[np.float64]:
        """Growth rates (n,) in 1/s at DAMPERS, of `side` "theory" or "fmu"."""
        return np.array([float(mode.growth_rate) for mode in getattr(self, side)])

    def frequencies(self, side: str) -> NDArray[np.float64]:
        """Frequencies (n,) in Hz at DAMPERS, of `side` "theory" or "fmu"."""
        return np.array([float(mode.frequency) for mode in getattr(self, side)])


def locus(unit: AnyUnit, curve: Curve) -> Locus:
    """Theory and FMU along the curve."""
    return Locus(
        curve=curve,
        theory=tuple(curve.theory(C) for C in DAMPERS),
        fmu=tuple(measured_mode(unit, curve.parameters.changed({"C": C}), curve.V) for C in DAMPERS),
    )
