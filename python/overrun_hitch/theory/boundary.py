"""The stability boundary: the drawbar damper with which the shunting mode neither grows nor decays."""

from __future__ import annotations

from scipy.optimize import brentq

from overrun_hitch.parameters import HitchError, Parameters
from overrun_hitch.theory.linear import shunting_mode


def critical_damping(parameters: Parameters, V: float) -> float:
    """The damper coefficient (N.s/m) below which the shunting mode grows and above which it decays, at V (m/s).

    0 where the mode is stable without a damper; C of `parameters` does not count. Found by Brent's method between 0
    and a damper strong enough to hold the mode, to a relative 1e-12 but no better than eigenvalues are (1e-10 N.s/m
    for the paper's cases). HitchError where there is no shunting mode (k = r = 0).
    """

    def growth(C: float) -> float:
        return float(shunting_mode(parameters.changed({"C": C}), V).growth_rate)

    if growth(0.0) <= 0.0:
        return 0.0
    most = Parameters.limits("C")[1]
    upper = min(max(2.0 * light_damping_estimate(parameters, V), 1e-3), most)
    while growth(upper) >= 0.0:
        if upper == most:
            raise HitchError(f"no damper up to C = {most:g} N.s/m holds the shunting mode at V = {V:g} m/s")
        upper = min(2.0 * upper, most)
    return float(brentq(growth, 0.0, upper, xtol=1e-12 * upper, rtol=1e-12))


def light_damping_estimate(parameters: Parameters, V: float) -> float:
    """`critical_damping` (N.s/m) in closed form, to first order in the lags of the wheels; negative: no damper needed.

    With J = I/R^2 and m = M + J of car and trailer, slip passes on the trailer brake's force r/R_t and the wheels'
    inertia only after the lags T = J V / C_k. Of the paper's linear equations (section 5) there remains

        s^2 + (C s + k) (1/m_c(s) + 1/m_t(s)) + r/R_t / (m_t(s) (1 + s T_t)) = 0,    m(s) = M + J / (1 + s T),

    where the coefficient of s vanishes, to first order in C and T, at

        C = (r/R_t T_t M_t/m_t^2 - k (J_t T_t/m_t^2 + J_c T_c/m_c^2)) / (1/m_c + 1/m_t).

    So the boundary rises with V in proportion. The error is at most about (w T)^2 of the first term, w the frequency
    in rad/s and T the greater lag: for the paper's nine cases at 10, 20 and 40 m/s the estimate is too high by 0.007 %
    (vi, 10 m/s) to 0.37 % (ix, 40 m/s). With another damper in rebound, (1 + rebound)/2 C takes the place of C.

    A brake that lags by tau_b adds (r/R_t)/M_t tau_b/(1 + (w tau_b)^2) / (1/M_c + 1/M_t), w^2 = k (1/m_c + 1/m_t) +
    (r/R_t)/m_t: not small, and whatever the speed. Case ii at 5 to 40 m/s: off by 3 % at most up to tau_b = 50 ms.
    """
    p = parameters
    J_c, J_t = p.I_c / p.R_c**2, p.I_t / p.R_t**2
    m_c, m_t = p.M_c + J_c, p.M_t + J_t
    T_c, T_t = J_c * V / p.C_kc, J_t * V / p.C_kt
    fed = p.r / p.R_t * T_t * p.M_t / m_t**2
    drained = p.k * (J_t * T_t / m_t**2 + J_c * T_c / m_c**2)
    w2 = p.k * (1.0 / m_c + 1.0 / m_t) + p.r / p.R_t / m_t
    lagging = p.r / p.R_t / p.M_t * p.tau_b / (1.0 + w2 * p.tau_b**2) / (1.0 / p.M_c + 1.0 / p.M_t)
    return ((fed - drained) / (1.0 / m_c + 1.0 / m_t) + lagging) / (0.5 * (1.0 + p.rebound))
