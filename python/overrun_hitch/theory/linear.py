"""Linear stability of steady running: the paper's section 5, in numpy alone.

The independent check of everything simulated: nothing here comes from the FMU. Slip denominators are held at the
speed V, so the matrices are those of the nonlinear model at zero slip and differ from it by terms of the order of the
slip (about 0.01) when braking.

Beyond the paper's parameters (docs/theory.md): tyres whose force lags by `sigma` add a state each, a brake torque that
lags by `tau_b` another, exactly. A damper
that is another in `rebound` is taken as one of C (1 + rebound)/2, which takes as much energy from a harmonic motion:
its describing function, whatever the amplitude (A. Gelb and W. E. Vander Velde, Multiple-Input Describing Functions and
Nonlinear System Design, McGraw-Hill 1968, chapter 2). What theory does not know is refused.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from overrun_hitch.parameters import HitchError, Parameters, with_unit

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]

REBOUND_REACH = 0.1  # relative: where one damper for two costs more, how much is not told by `rebound_error`


def equations_of_motion(parameters: Parameters, V: float, s: float = 0.0) -> tuple[Floats, Floats, Floats]:
    """Mass, damping and stiffness matrix (4, 4) of M q'' + B q' + K q = 0, q = (x_c, x_t, theta_c, theta_t).

    The paper's homogeneous equations at the end of section 5. V: speed in m/s; s: weak spring from the car to ground
    in N/m, which keeps the rigid-body mode off zero. HitchError for what they do not know, the lags `sigma` and `tau_b`
    among it.
    """
    for name in ("sigma", "tau_b"):
        if getattr(parameters, name) > 0.0:
            value = f"{getattr(parameters, name):g} {parameters.unit(name)}"
            raise HitchError(f"the paper's equations do not know {name} = {value}")
    mass, damping, stiffness = _without_tyres(parameters, V, s)
    p = parameters
    g_c, g_t = p.C_kc / V, p.C_kt / V
    tyres = np.array(
        [
            [g_c, 0.0, -g_c * p.R_c, 0.0],
            [0.0, g_t, 0.0, -g_t * p.R_t],
            [-g_c * p.R_c, 0.0, g_c * p.R_c**2, 0.0],
            [0.0, -g_t * p.R_t, 0.0, g_t * p.R_t**2],
        ]
    )
    return mass, damping + tyres, stiffness


def _without_tyres(parameters: Parameters, V: float, s: float = 0.0) -> tuple[Floats, Floats, Floats]:
    """The three matrices of `equations_of_motion` but for what the tyres add to the damping."""
    check_known(parameters)
    if not V > 0.0:
        raise HitchError(f"V_0 = {V:g} m/s is not allowed: linear theory needs a speed greater than 0 m/s")
    p = parameters
    C = 0.5 * p.C * (1.0 + p.rebound)
    mass = np.diag([p.M_c, p.M_t, p.I_c, p.I_t])
    damping = np.zeros((4, 4))
    damping[:2, :2] = [[C, -C], [-C, C]]
    stiffness = np.array(
        [
            [p.k + s, -p.k, 0.0, 0.0],
            [-p.k, p.k, 0.0, 0.0],
            [0.0, 0.0, 0.0, 0.0],
            [-p.r, p.r, 0.0, 0.0],
        ]
    )
    return mass, damping, stiffness


def check_known(parameters: Parameters) -> None:
    """HitchError, naming it, if there is a parameter that linear theory does not know and that is not neutral."""
    for name in parameters.off_default("neutral"):
        value = with_unit(getattr(parameters, name), parameters.unit(name))
        default = f"{Parameters.model_fields[name].default:g}"
        raise HitchError(f"linear theory does not know {name} = {value}; allowed: {default}")


def dynamic_matrix(parameters: Parameters, V: float, s: float = 0.0) -> Floats:
    """The paper's dynamic matrix (8, 8) for (x_c, x_t, theta_c, theta_t) and their rates; V in m/s, s in N/m.

    Wheel angles act on nothing, so two of its eigenvalues are zero whatever s is.
    """
    mass, damping, stiffness = equations_of_motion(parameters, V, s)
    inverse = np.linalg.inv(mass)
    return np.block([[np.zeros((4, 4)), np.eye(4)], [-inverse @ stiffness, -inverse @ damping]])


def reduced_matrix(parameters: Parameters, V: float) -> Floats:
    """The dynamic matrix (6, 6) without wheel angles: (x_c, x_t, v_c, v_t, omega_c, omega_t); V in m/s.

    The rigid body (place, then uniform speed) leaves a double zero eigenvalue with one eigenvector.
    """
    keep = [0, 1, 4, 5, 6, 7]
    return dynamic_matrix(parameters, V)[np.ix_(keep, keep)]


def compression_matrix(parameters: Parameters, V: float) -> Floats:
    """The dynamic matrix (5, 5) for (x_t - x_c, v_c, v_t, omega_c, omega_t); V in m/s.

    Place drops out: of the rigid body one simple zero eigenvalue is left, and the others are those of the paper.
    With a lag `sigma` the slips of car and trailer are two more states, with a lag `tau_b` the trailer's brake torque
    is the last one.
    """
    p = parameters
    if p.tau_b > 0.0:
        return _with_lagging_brake(compression_matrix(p.changed({"tau_b": 0.0}), V), p)
    if p.sigma > 0.0:
        return _with_lagging_tyres(p, V)
    full = dynamic_matrix(p, V)
    matrix = np.zeros((5, 5))
    matrix[0, 1:3] = -1.0, 1.0
    # Without the weak spring forces depend on x_t - x_c alone, so the column of x_t is that of the difference.
    matrix[1:, 0] = full[4:, 1]
    matrix[1:, 1:] = full[4:, 4:]
    return matrix


def _with_lagging_brake(prompt: Floats, parameters: Parameters) -> Floats:
    """`compression_matrix` (n + 1, n + 1) with tau_b > 0 from that without: tau_b T' = r (x_t - x_c) - T."""
    p = parameters
    n = len(prompt)
    matrix = np.zeros((n + 1, n + 1))
    matrix[:n, :n] = prompt
    matrix[4, 0] += p.r / p.I_t  # what was there is the torque's
    matrix[4, n] = -1.0 / p.I_t
    matrix[n, 0] = p.r / p.tau_b
    matrix[n, n] = -1.0 / p.tau_b
    return matrix


def _with_lagging_tyres(parameters: Parameters, V: float) -> Floats:
    """`compression_matrix` (7, 7) with sigma > 0: sigma slip' = slip speed - V slip, tyre force C_k slip."""
    p = parameters
    mass, damping, stiffness = _without_tyres(p, V)
    slip_speeds = np.array([[1.0, 0.0, -p.R_c, 0.0], [0.0, 1.0, 0.0, -p.R_t]])
    inverse = np.linalg.inv(mass)
    matrix = np.zeros((7, 7))
    matrix[0, 1:3] = -1.0, 1.0
    matrix[1:5, 0] = -inverse @ stiffness[:, 1]
    matrix[1:5, 1:5] = -inverse @ damping
    matrix[1:5, 5:] = -inverse @ slip_speeds.T @ np.diag([p.C_kc, p.C_kt])
    matrix[5:, 1:5] = slip_speeds / p.sigma
    matrix[5:, 5:] = -V / p.sigma * np.eye(2)
    return matrix


@dataclass(frozen=True)
class ShuntingMode:
    """The mode in which car and trailer move against each other, at one or more speeds: arrays of the shape of V."""

    eigenvalue: Complexes  # 1/s, with imaginary part >= 0; real where the mode is overdamped (the slower root)
    shape: Complexes  # x_t / x_c (1)

    @property
    def oscillates(self) -> NDArray[np.bool_]:
        """False where the damper is so strong that the mode creeps back without oscillating."""
        return np.asarray(self.eigenvalue.imag > 0.0)

    @property
    def growth_rate(self) -> Floats:
        """1/s; positive: self-excited."""
        return np.asarray(self.eigenvalue.real)

    @property
    def frequency(self) -> Floats:
        """Hz; 0 where the mode does not oscillate."""
        return np.asarray(self.eigenvalue.imag / (2.0 * np.pi))

    @property
    def damping_ratio(self) -> Floats:
        """Damping over critical damping (1)."""
        return np.asarray(-self.eigenvalue.real / np.abs(self.eigenvalue))

    @property
    def amplitude_ratio(self) -> Floats:
        """|x_t / x_c| (1)."""
        return np.asarray(np.abs(self.shape))

    @property
    def phase(self) -> Floats:
        """Phase between x_t and x_c in degrees, 0 to 180: the paper gives no sign."""
        return np.asarray(np.abs(np.angle(self.shape, deg=True)))


def shunting_mode(parameters: Parameters, V: ArrayLike) -> ShuntingMode:
    """The shunting mode at the speeds V (m/s, any shape), from the linear drawbar: k, C, r without clearance.

    On another piece of the spring, or under friction: working_point.py.

    It is picked as the mode in which the drawbar compression participates most (participation factors: Perez-Arriaga,
    Verghese and Schweppe 1982, doi 10.1109/TPAS.1982.317524). Unlike "the slowest complex pair" this stays right where
    strong damping splits the pair into two real roots and the faster one pairs up with a wheel's. A motion that grows
    goes before: so the growth rate is positive exactly where any motion grows.
    HitchError where nothing returns the trailer to its place (k = r = 0), and for what theory does not know.
    """
    speed = np.asarray(V, dtype=np.float64)
    values, right, chosen = _modes(parameters, speed.ravel())
    every = np.arange(len(values))
    value = values[every, chosen]
    shape = right[every, 2, chosen] / right[every, 1, chosen]
    below = value.imag < 0.0  # of a conjugate pair either may have been chosen
    value, shape = np.where(below, value.conj(), value), np.where(below, shape.conj(), shape)
    return ShuntingMode(eigenvalue=value.reshape(speed.shape), shape=shape.reshape(speed.shape))


def rebound_error(parameters: Parameters, V: float) -> float:
    """What taking one damper for two may cost of the damping ratio at V (m/s), relative (1).

    A mass on a spring spends half a cycle on either damper, each with its own decrement. With z the damping ratio that
    the equivalent damper would give it, the whole is off by 1.5 ((rebound - 1)/(rebound + 1) z)^2 to first order; 2
    covers what lies beyond, as long as what comes out is not more than REBOUND_REACH.
    """
    p = parameters
    omega = float(np.abs(shunting_mode(p, V).eigenvalue))
    inverse_mass = 1.0 / (p.M_c + p.I_c / p.R_c**2) + 1.0 / (p.M_t + p.I_t / p.R_t**2)
    z = 0.5 * p.C * (1.0 + p.rebound) * inverse_mass / (2.0 * omega)
    return 2.0 * ((p.rebound - 1.0) / (p.rebound + 1.0) * z) ** 2


def wheel_decay_rate(parameters: Parameters, V: float) -> float:
    """The slowest decay rate (1/s) of the wheel-slip modes at V (m/s): what is left beside rigid body and shunting."""
    values, _, chosen = _modes(parameters, np.array([V]))
    shunting = values[0, chosen[0]]
    nearest = np.argsort(np.minimum(np.abs(values[0] - shunting), np.abs(values[0] - shunting.conj())))
    others = values[0, nearest[2:]]
    rigid = np.abs(others).argmin()
    return float(-np.delete(others, rigid).real.max())


def _modes(parameters: Parameters, speeds: Floats) -> tuple[Complexes, Complexes, NDArray[np.intp]]:
    """Eigenvalues (n, 5), eigenvectors in columns (n, 5, 5) and the place (n,) of the shunting mode; lags: to 8."""
    if parameters.k + parameters.r <= 0.0:
        raise HitchError("k = 0 N/m and r = 0 N.m/m leave no shunting mode: one of them must be greater than 0")
    values, right = np.linalg.eig(np.array([compression_matrix(parameters, float(value)) for value in speeds]))
    left = np.linalg.inv(right)
    participation = np.abs(right[:, 0, :] * left[:, :, 0])
    # Slip alone always decays, so a motion that grows is the shunting mode, however much of it is in the wheels.
    grows = values.real > 1e-9 * np.abs(values).max(axis=1, keepdims=True)
    participation = np.where(grows, np.inf, participation)
    return values.astype(np.complex128), right.astype(np.complex128), participation.argmax(axis=1)
