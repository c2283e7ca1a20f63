"""The FMU's own linearisation, from its directional derivatives, beside the paper's dynamic matrix (section 5).

The FMU's states are x_c, v_c, omega_c, v_t, omega_t and the compression delta = x_t - x_c, beside those of tyres and
brakes that hold at standstill, on which nothing else depends at speed and which are left out; the paper's are x_c, x_t,
the wheel angles and their rates. Wheel angles act on nothing, so the FMU has none, and here the paper's matrix is taken
without their rows and columns (linear.reduced_matrix). What is left differs by the exact change of coordinates
x_t = x_c + delta.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from overrun_hitch.fmu.unit import AnyUnit, HitchUnit
from overrun_hitch.parameters import Parameters
from overrun_hitch.results import VARIABLES
from overrun_hitch.theory.linear import reduced_matrix
from overrun_hitch.theory.steady import steady

Floats = NDArray[np.float64]

STATES = ("x_c", "x_t", "v_c", "v_t", "omega_c", "omega_t")
FMU_STATES = {  # of the FMU, by what takes their place in the paper's order
    "x_c": "car.body.x",
    "x_t": "drawbar.compression",
    "v_c": "car.body.v",
    "v_t": "trailer.body.v",
    "omega_c": "car.wheel.omega",
    "omega_t": "trailer.wheel.omega",
}
RELATIVE_TOLERANCE = 1e-10
SETTLED = 3.0  # s


@dataclass(frozen=True)
class Linearisation:
    """Both matrices (6, 6) in the order of STATES: rates by states. Units are SI's, 1/s and their products."""

    V: float  # m/s, the car's speed at the point of linearisation and theory's V
    slip_car: float  # 1
    slip_trailer: float  # 1
    fmu: Floats
    theory: Floats

    @property
    def difference(self) -> Floats:
        """|fmu - theory| (6, 6) relative to the larger of the two, 0 where both are 0."""
        larger = np.maximum(np.abs(self.fmu), np.abs(self.theory))
        return np.divide(np.abs(self.fmu - self.theory), larger, out=np.zeros_like(larger), where=larger > 0.0)

    @property
    def eigenvalues(self) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
        """Eigenvalues (6,) in 1/s of both matrices, sorted alike."""
        both = (np.linalg.eigvals(matrix).astype(np.complex128) for matrix in (self.fmu, self.theory))
        first, second = (values[np.lexsort((values.imag, values.real.round(6)))] for values in both)
        return first, second


def at_zero_slip(unit: AnyUnit, parameters: Parameters, V: float, compression: float = 0.01) -> Linearisation:
    """At the start of a run: wheels roll at V (m/s), the drawbar is pushed in by `compression` (m) beyond eps.

    There the paper's linearisation is exact.
    """
    start = parameters.changed({"V_0": V, "compression_start": parameters.eps + compression})
    return _linearisation(unit.perform(_linearised, start, 0.0, 0.0), start, V)


def at_steady_braking(unit: AnyUnit, parameters: Parameters, V: float, brake_torque: float) -> Linearisation:
    """After 3 s of braking by `brake_torque` (N.m), when the speed has fallen to about V (m/s).

    A tyre force C_k (v - R omega) / v has the slope C_k (1 - slip) / v by v, where the paper, holding the denominator
    at V, has C_k / V; the slope by omega, -C_k R / v, is the same. The trailer's speed is nearly the car's.
    """
    start = steady(parameters, brake_torque)
    changed = parameters.changed({"V_0": V - SETTLED * start.A, "compression_start": start.D})
    found = unit.perform(_linearised, changed, brake_torque, SETTLED)
    return _linearisation(found, parameters, found[2]["v_car"])


def _linearised(
    unit: HitchUnit, parameters: Parameters, brake_torque: float, after: float
) -> tuple[list[str], Floats, dict[str, float]]:
    """Names of the states, their Jacobian, and the outputs, `after` so many s of braking."""
    unit.start(parameters, {"brake_torque": brake_torque}, RELATIVE_TOLERANCE)
    if after:
        unit.step(0.0, after)
    return *unit.jacobian(), dict(zip(VARIABLES, unit.outputs(), strict=True))


def _linearisation(
    found: tuple[list[str], Floats, dict[str, float]], parameters: Parameters, V: float
) -> Linearisation:
    names, jacobian, outputs = found
    order = [names.index(FMU_STATES[state]) for state in STATES]
    ordered = jacobian[np.ix_(order, order)]
    # From (x_c, delta, ...) to (x_c, x_t, ...): T = d(paper's states)/d(FMU's).
    change = np.eye(len(STATES))
    change[1, 0] = 1.0
    back = np.eye(len(STATES))
    back[1, 0] = -1.0
    return Linearisation(
        V=V,
        slip_car=outputs["slip_car"],
        slip_trailer=outputs["slip_trailer"],
        fmu=change @ ordered @ back,
        theory=reduced_matrix(parameters, V),
    )
