"""The strongest check of the FMU: its own linearisation beside the paper's dynamic matrix, made ready to be shown."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from overrun_hitch.experiments.linearisation import STATES, Linearisation

Floats = NDArray[np.float64]

ALLOWED = 1e-9  # relative difference of an entry at zero slip
RIGID_BODY = 1e-3  # 1/s: nothing else is as near to zero
UNITS = {  # of each of STATES, and of its rate
    "x_c": ("m", "m/s"),
    "x_t": ("m", "m/s"),
    "v_c": ("m/s", "m/s2"),
    "v_t": ("m/s", "m/s2"),
    "omega_c": ("rad/s", "rad/s2"),
    "omega_t": ("rad/s", "rad/s2"),
}
QUOTIENTS = {  # of units: of a rate by that of a state
    ("m/s", "m"): "1/s",
    ("m/s2", "m/s"): "1/s",
    ("rad/s2", "rad/s"): "1/s",
    ("m/s", "m/s"): "1",
    ("m/s2", "m"): "1/s2",
    ("m/s2", "rad/s"): "m/(s.rad)",
    ("rad/s2", "m"): "rad/(m.s2)",
    ("rad/s2", "m/s"): "rad/(m.s)",
}
SPEEDS = {"v_c": ("omega_c", "slip_car"), "v_t": ("omega_t", "slip_trailer")}  # their wheels and slips


@dataclass(frozen=True)
class Eigenvalue:
    """One eigenvalue (1/s) from both sides, of a pair the one with positive imaginary part."""

    mode: str
    fmu: complex
    theory: complex

    @property
    def difference(self) -> float:
        """|fmu - theory| in 1/s."""
        return abs(self.fmu - self.theory)


@dataclass(frozen=True)
class Entry:
    """One entry of the matrix on which both sides differ; rates by states, SI units."""

    rate: str  # of this state
    state: str
    fmu: float
    theory: float
    relative: float  # |difference| (1)
    left: float  # of it, once theory's tyre slope is multiplied by 1 - slip

    @property
    def unit(self) -> str:
        """That of the rate over that of the state."""
        return QUOTIENTS[UNITS[self.rate][1], UNITS[self.state][0]]


def largest_difference(linearisations: Mapping[str, Linearisation]) -> float:
    """The largest relative difference of any entry (1)."""
    return max(float(found.difference.max()) for found in linearisations.values())


def eigenvalues(found: Linearisation) -> list[Eigenvalue]:
    """The modes, fastest first; the rigid body's double zero is one row, that of the larger value."""
    fmu, theory = found.eigenvalues
    rows, rigid = [], []
    for ours, papers in zip(fmu.tolist(), theory.tolist(), strict=True):
        if abs(papers) < RIGID_BODY:
            rigid.append(Eigenvalue("rigid body (double zero)", ours, papers))
        elif papers.imag > 0.0:
            rows.append(Eigenvalue("shunting", ours, papers))
        elif papers.imag == 0.0:
            rows.append(Eigenvalue("wheel slip", ours, papers))
    return [*rows, max(rigid, key=lambda row: abs(row.fmu))]


def differing_entries(found: Linearisation) -> list[Entry]:
    """Where the FMU and theory differ by more than ALLOWED, and what the slip leaves unexplained."""
    difference, left = found.difference, _relative(found.fmu, with_slip(found))
    return [
        Entry(
            STATES[row],
            STATES[column],
            float(found.fmu[row, column]),
            float(found.theory[row, column]),
            float(difference[row, column]),
            float(left[row, column]),
        )
        for row, column in np.argwhere(difference > ALLOWED)
    ]


def with_slip(found: Linearisation) -> Floats:
    """Theory's matrix (6, 6) with the tyre force's slope by the speed multiplied by 1 - slip: C_k (1 - slip) / V.

    The wheel's rate has nothing but that slope; the body's has the damper's beside it, which its other speed shows.
    """
    matrix: Floats = found.theory.copy()
    place = {state: n for n, state in enumerate(STATES)}
    for speed, other in (("v_c", "v_t"), ("v_t", "v_c")):
        wheel, slip = SPEEDS[speed][0], getattr(found, SPEEDS[speed][1])
        v = place[speed]
        matrix[v, v] -= slip * (found.theory[v, v] + found.theory[v, place[other]])
        matrix[place[wheel], v] *= 1.0 - slip
    return matrix


def _relative(one: Floats, other: Floats) -> Floats:
    larger = np.maximum(np.abs(one), np.abs(other))
    return np.asarray(np.divide(np.abs(one - other), larger, out=np.zeros_like(larger), where=larger > 0.0))
