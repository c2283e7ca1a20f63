"""Growth rate and frequency of a free oscillation, measured from a sampled trace without any theory of the vehicle.

The trace is fitted, in least squares, by

    offset + exp(g(t)) (a cos phi(t) + b sin phi(t)),    g' = growth rate,    phi' = 2 pi frequency,

growth rate and frequency each a straight line in t, because speed falls during a run and both drift with it. offset,
a and b enter linearly and are eliminated by variable projection (G. H. Golub and V. Pereyra, SIAM J. Numer. Anal. 10
(1973) 413-432, doi 10.1137/0710036; Inverse Problems 19 (2003) R1-R26, doi 10.1088/0266-5611/19/2/201), so that four
nonlinear unknowns remain. They start from the matrix pencil method (Y. Hua and T. K. Sarkar, IEEE Trans. ASSP 38
(1990) 814-824, doi 10.1109/29.56027), which needs no guess.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import leastsq

Floats = NDArray[np.float64]

# Below two periods offset, decay and frequency explain each other's share of the trace.
FEWEST_PERIODS = 2.0
FEWEST_SAMPLES_A_PERIOD = 4.0
# What has faded so far is over: of a drawbar that sticks a fit would find the last trembling, -54 1/s at 6 Hz.
FADED = np.log(1e6)
# What a fit may leave, relative: with 0.04 growth rates were 2 % off, with 0.08 a damping ratio of 0.1 was 12 % off.
FITS = 0.05
PENCIL_SAMPLES = 300  # enough for a start, and keeps the singular value decomposition at milliseconds
MOST_TRIALS = 200  # of the fit; what oscillates needs 10 to 30
PENCIL_ORDERS = (3, 5, 7)  # offset and one, two or three pairs: a trace that is no clean sine has harmonics


@dataclass(frozen=True)
class Oscillation:
    """A fitted oscillation. Growth rate and frequency are means over the window."""

    growth_rate: float  # 1/s; positive: the oscillation grows
    frequency: float  # Hz
    offset: float  # in the unit of the trace
    residual: float  # root mean square of what the fit leaves, relative to that of trace - offset (1)
    periods: float  # length of the window in periods (1)
    _unknowns: tuple[float, ...]

    def offset_of(self, time: Floats, trace: Floats) -> float:
        """Offset of another trace (n,) of the same motion at the same `time` (n,), in that trace's unit."""
        return float(self._coefficients(time, trace)[0])

    def amplitude_of(self, time: Floats, trace: Floats) -> complex:
        """Complex amplitude of another trace (n,) of the same motion: ratios between traces are the mode's shape."""
        _, cosine, sine = self._coefficients(time, trace)
        return complex(cosine, -sine)

    def errors_of(self, time: Floats, trace: Floats) -> tuple[float, float]:
        """Standard errors of growth rate (1/s) and frequency (Hz), if what is left is white."""
        window, scaled, unknowns = _window(time), trace / float(np.ptp(trace)), np.array(self._unknowns)
        left, slopes = _remainder(unknowns, window, scaled), _slopes(unknowns, window, scaled)
        variance = float(left @ left) / (len(trace) - 7)  # four unknowns, and three that enter linearly
        growth, omega = np.sqrt(variance * np.diag(np.linalg.pinv(slopes.T @ slopes)))[:2]
        return float(growth), float(omega) / (2.0 * np.pi)

    def _coefficients(self, time: Floats, trace: Floats) -> Floats:
        basis = _basis(_window(time), np.array(self._unknowns))
        return np.asarray(np.linalg.lstsq(basis, trace, rcond=None)[0])


@dataclass(frozen=True)
class NoOscillation:
    """Why a trace could not be measured, in words that fit after "not judged:"."""

    reason: str
    misfit: bool = False  # it oscillates, but not as an exponential


def fitting(found: Oscillation | NoOscillation) -> Oscillation | NoOscillation:
    """The same, but none where the fit leaves more than FITS: such a motion has no growth rate."""
    if isinstance(found, Oscillation) and not found.residual <= FITS:
        reason = f"no exponential fits the oscillation: it leaves {found.residual:.2g}, over {FITS:g}"
        return NoOscillation(reason, misfit=True)
    return found


def measure(time: Floats, trace: Floats) -> Oscillation | NoOscillation:
    """Fit the oscillation in `trace` (n,), sampled evenly at `time` (n,) in s."""
    if len(time) < 2 * FEWEST_PERIODS * FEWEST_SAMPLES_A_PERIOD:
        return NoOscillation(f"only {len(time)} samples")
    swing = float(np.ptp(trace))
    if not swing > 1e-9 * float(np.abs(trace).max()):
        return NoOscillation("the trace is constant")
    window, scaled = _window(time), trace / swing
    starts = _starts(window, scaled)
    if not starts:
        return NoOscillation("the trace does not oscillate")
    best = min(starts, key=lambda unknowns: float(np.sum(_remainder(unknowns, window, scaled) ** 2)))
    scale = np.array([1.0, abs(best[1]), 1.0, abs(best[1])])
    found = leastsq(
        _remainder, best, (window, scaled), _slopes, diag=1.0 / scale, maxfev=MOST_TRIALS,
        xtol=1e-12, ftol=1e-14, gtol=1e-12, full_output=True,
    )[0]  # fmt: skip
    return _result(window, scaled, swing, found)


def _result(window: Floats, scaled: Floats, swing: float, unknowns: Floats) -> Oscillation | NoOscillation:
    length = float(window[-1] - window[0])
    frequency = abs(float(unknowns[1])) / (2.0 * np.pi)
    periods = frequency * length
    lasting = min(periods, frequency * FADED / max(abs(float(unknowns[0])), 1e-9))
    if lasting < FEWEST_PERIODS:
        return NoOscillation(f"only {lasting:.1f} periods to measure")
    if frequency * length / (len(window) - 1) * FEWEST_SAMPLES_A_PERIOD > 1.0:
        return NoOscillation(f"fewer than {FEWEST_SAMPLES_A_PERIOD:.0f} samples a period")
    offset = float(np.linalg.lstsq(_basis(window, unknowns), scaled, rcond=None)[0][0])
    left = _remainder(unknowns, window, scaled)
    residual = float(np.sqrt(np.mean(left**2) / np.mean((scaled - offset) ** 2)))
    return Oscillation(
        growth_rate=float(unknowns[0]),
        frequency=frequency,
        offset=offset * swing,
        residual=residual,
        periods=periods,
        _unknowns=tuple(float(value) for value in unknowns),
    )


def _window(time: Floats) -> Floats:
    """Time from the middle of the window: the values there of two straight lines are also their means."""
    return np.asarray(time - 0.5 * (time[0] + time[-1]))


def _basis(window: Floats, unknowns: Floats) -> Floats:
    """The three functions (n, 3) that enter linearly. unknowns: growth rate, angular frequency, and their slopes."""
    growth, omega, growth_slope, omega_slope = unknowns
    # The largest value of the envelope is made 1, so that no trial overflows.
    exponent = growth * window + 0.5 * growth_slope * window**2
    envelope = np.exp(exponent - exponent.max())
    angle = omega * window + 0.5 * omega_slope * window**2
    return np.asarray(np.array([np.ones_like(window), envelope * np.cos(angle), envelope * np.sin(angle)]).T)


def _remainder(unknowns: Floats, window: Floats, scaled: Floats) -> Floats:
    """The trace less its projection on the basis: the variable projection functional."""
    orthonormal, _ = np.linalg.qr(_basis(window, unknowns))
    return np.asarray(scaled - orthonormal @ (orthonormal.T @ scaled))


def _slopes(unknowns: Floats, window: Floats, scaled: Floats) -> Floats:
    """Derivatives (n, 4) of `_remainder` by the unknowns: both terms of Golub and Pereyra (1973)."""
    basis = _basis(window, unknowns)
    orthonormal, triangle = np.linalg.qr(basis)
    share = orthonormal.T @ scaled
    inverse = np.linalg.inv(triangle)
    _, a, b = inverse @ share
    left = scaled - orthonormal @ share
    _, cosine, sine = basis.T
    weights = np.array([window, 0.5 * window**2])  # of growth rate and frequency, of their slopes
    # Growth scales a cos + b sin, frequency turns it: cos becomes -sin, and sin becomes cos.
    moved = np.array([a * cosine + b * sine, b * cosine - a * sine])[None] * weights[:, None]
    (c, s), (c_slope, s_slope) = (weights * left) @ basis[:, 1:]
    turned_away = np.array([[0.0, 0.0, 0.0, 0.0], [c, -s, c_slope, -s_slope], [s, c, s_slope, c_slope]])
    columns = moved.reshape(4, -1).T
    return np.asarray(orthonormal @ (orthonormal.T @ columns - inverse.T @ turned_away) - columns)


def _starts(window: Floats, scaled: Floats) -> list[Floats]:
    """Growth rates and angular frequencies of the oscillating parts of the trace, slopes zero."""
    stride = max(1, len(window) // PENCIL_SAMPLES)
    step = float(window[1] - window[0]) * stride
    samples = scaled[::stride]
    columns = len(samples) // 3
    hankel = np.lib.stride_tricks.sliding_window_view(samples, columns)
    right = np.linalg.svd(hankel, full_matrices=False)[2].T
    starts = []
    for order in PENCIL_ORDERS:
        subspace = right[:, :order]
        poles = np.linalg.eigvals(np.linalg.lstsq(subspace[:-1], subspace[1:], rcond=None)[0]).astype(np.complex128)
        # A pole turning by less than a quarter of a revolution over the whole window is drift, not oscillation.
        turning = poles[poles.imag * len(samples) > 0.5 * np.pi * np.abs(poles)]
        rates = np.log(turning) / step
        starts += [np.array([rate.real, rate.imag, 0.0, 0.0]) for rate in rates]
    return starts
