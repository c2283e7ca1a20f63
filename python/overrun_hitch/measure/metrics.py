"""Figures of merit of many runs at once, from their traces alone.

Between output points a trace with a known rate is taken to be the cubic Hermite polynomial through both, so that a
peak between two points is not missed.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from overrun_hitch.measure.oscillation import FITS, Oscillation, measure

Floats = NDArray[np.float64]

NEEDED = ("v_car", "v_trailer", "a_car", "compression", "trailer_brake_torque")
TAKEN_UP = 0.1  # s: until then the car's wheels take up a brake torque that is stepped, whatever the hitch does
AT_REST = 0.01  # m/s
ROLLING = 0.1  # m/s: below it the paper's linear theory, and an oscillation about steady motion, mean nothing
RESPONDED = 0.75  # of the asymptotic brake torque: the response time of UN Regulation 13, annex 6
FINE = 16  # pieces of an output step


@dataclass(frozen=True)
class Traces:
    """Runs through the same evenly spaced output points, from t = 0 on."""

    time: Floats  # (points,) in s
    values: Mapping[str, Floats]  # (runs, points): NEEDED
    eps: Floats  # (runs,) in m, the drawbar clearance

    @cached_property
    def compression(self) -> Floats:
        """(runs, FINE (points - 1) + 1) in m."""
        rate = self.values["v_trailer"] - self.values["v_car"]
        return _refined(self.time, self.values["compression"], rate)

    @cached_property
    def modes(self) -> Floats:
        """Growth rate (1/s), frequency (Hz) and residual (1) of the compression (runs, 3); NaN where there are none.

        Where the fit leaves more than FITS there is a residual alone.
        """
        rolls = self.values["v_car"] > ROLLING
        seen = (self.time >= TAKEN_UP) & (self.values["compression"] > self.eps[:, None])
        first = np.where(seen.any(axis=1), seen.argmax(axis=1), 0)
        last = np.where(rolls.all(axis=1), len(self.time), rolls.argmin(axis=1))
        found = np.full((len(first), 3), np.nan)
        for run, (start, end) in enumerate(zip(first, last, strict=True)):
            fit = measure(self.time[start:end], self.values["compression"][run, start:end])
            if isinstance(fit, Oscillation):
                found[run, 2] = fit.residual
                if fit.residual <= FITS:
                    found[run, :2] = fit.growth_rate, fit.frequency
        return found


def _refined(time: Floats, values: Floats, rates: Floats) -> Floats:
    """Values (runs, n) at `time` (n,) with their rates, FINE times as often; the points themselves are kept."""
    h = float(time[1] - time[0])
    s = np.arange(FINE) / FINE
    start, end = values[:, :-1, None], values[:, 1:, None]
    slope, end_slope = h * rates[:, :-1, None], h * rates[:, 1:, None]
    cubic = start + s * slope + s**2 * (3.0 * (end - start) - 2.0 * slope - end_slope)
    cubic += s**3 * (2.0 * (start - end) + slope + end_slope)
    return np.concatenate([cubic.reshape(len(values), -1), values[:, -1:]], axis=1)


def _growth_rate(runs: Traces) -> Floats:
    return runs.modes[:, 0]


def _frequency(runs: Traces) -> Floats:
    return runs.modes[:, 1]


def _damping_ratio(runs: Traces) -> Floats:
    growth, omega = runs.modes[:, 0], 2.0 * np.pi * runs.modes[:, 1]
    return np.asarray(-growth / np.hypot(growth, omega))


def _fit_residual(runs: Traces) -> Floats:
    return runs.modes[:, 2]


def _time_out_of_compression(runs: Traces) -> Floats:
    inside = runs.compression > runs.eps[:, None]
    been = np.logical_or.accumulate(inside, axis=1)
    return np.asarray((been & ~inside).mean(axis=1) * (runs.time[-1] - runs.time[0]))


def _peak_compression(runs: Traces) -> Floats:
    return np.asarray(runs.compression.max(axis=1))


def _peak_jerk(runs: Traces) -> Floats:
    jerk = np.abs(np.diff(runs.values["a_car"], axis=1) / np.diff(runs.time))
    counts = (runs.time[:-1] >= TAKEN_UP) & (runs.values["v_car"][:, 1:] > ROLLING)  # any stop ends with a jerk
    return np.asarray(np.where(counts, jerk, 0.0).max(axis=1))


def _stopping_distance(runs: Traces) -> Floats:
    v, a, h = runs.values["v_car"], runs.values["a_car"], np.diff(runs.time)
    rests = v <= AT_REST
    # The integral of the Hermite polynomial; in the step in which the car stops, that of a steady deceleration.
    steps = 0.5 * h * (v[:, :-1] + v[:, 1:]) + h**2 / 12.0 * (a[:, :-1] - a[:, 1:])
    distance = np.concatenate([np.zeros((len(v), 1)), np.cumsum(steps, axis=1)], axis=1)
    row, stop = np.arange(len(v)), rests.argmax(axis=1)
    before = np.maximum(stop - 1, 0)
    braking = np.minimum(a[row, before], -1e-9)
    last = np.minimum(-0.5 * v[row, before] ** 2 / braking, v[row, before] * h[np.minimum(before, len(h) - 1)])
    return np.where(rests.any(axis=1), distance[row, before] + last, np.nan)


def _trailer_brake_delay(runs: Traces) -> Floats:
    torque = runs.values["trailer_brake_torque"]
    rolls = runs.values["v_car"] > ROLLING
    later = rolls & (np.cumsum(rolls, axis=1) > 0.5 * rolls.sum(axis=1)[:, None])
    with np.errstate(invalid="ignore"):
        asymptote = (torque * later).sum(axis=1) / later.sum(axis=1)
    excess = _refined(runs.time, torque, np.gradient(torque, runs.time, axis=1)) - RESPONDED * asymptote[:, None]
    reached = excess >= 0.0
    row, after = np.arange(len(torque)), reached.argmax(axis=1)
    before = np.maximum(after - 1, 0)
    with np.errstate(invalid="ignore", divide="ignore"):
        share = np.where(after > 0, excess[row, before] / (excess[row, before] - excess[row, after]), 0.0)
    step = (runs.time[1] - runs.time[0]) / FINE
    return np.where(reached.any(axis=1) & (asymptote > 0.0), (before + share) * step, np.nan)


@dataclass(frozen=True)
class Metric:
    """One number for each run."""

    unit: str
    description: str
    of: Callable[[Traces], Floats]


METRICS: Mapping[str, Metric] = {
    "growth_rate": Metric("1/s", "growth rate of the drawbar's oscillation, positive: self-excited", _growth_rate),
    "frequency": Metric("Hz", "frequency of the drawbar's oscillation", _frequency),
    "damping_ratio": Metric("1", "damping ratio of the drawbar's oscillation", _damping_ratio),
    "fit_residual": Metric(
        "1", f"what an exponential leaves of the oscillation; over {FITS:g} the three above are none", _fit_residual
    ),
    "time_out_of_compression": Metric(
        "s", "time for which the drawbar is not compressed after it once was", _time_out_of_compression
    ),
    "peak_compression": Metric("m", "largest drawbar compression", _peak_compression),
    "peak_jerk": Metric(
        "m/s3", f"largest jerk of the rolling car, mean over an output step, from {TAKEN_UP:g} s on", _peak_jerk
    ),
    "stopping_distance": Metric("m", "distance to standstill, none where the run ends before", _stopping_distance),
    "trailer_brake_delay": Metric(
        "s",
        f"delay of the trailer's brakes, to {RESPONDED:.0%} of their mean torque in the later half of the run",
        _trailer_brake_delay,
    ),
}


def measured(names: tuple[str, ...], runs: Traces) -> dict[str, Floats]:
    """The metrics called `names`, each (runs,), NaN where a run has none."""
    return {name: np.asarray(METRICS[name].of(runs), dtype=np.float64) for name in names}
