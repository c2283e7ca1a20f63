"""A drawbar's parameters from a trace: least squares on the FMU's own component, moved as the drawbar was."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

from overrun_hitch.fitting.bench import OUTPUTS, Bench, opened_bench
from overrun_hitch.fitting.estimates import ALIKE, Estimate, correlation, covariance, default_names
from overrun_hitch.fitting.guess import first_guess
from overrun_hitch.fitting.motion import Motion, motion
from overrun_hitch.fitting.trace import Floats, Trace
from overrun_hitch.fmu.files import BENCH
from overrun_hitch.measure.noise import noise
from overrun_hitch.parameters import DATUM, HitchError, Parameters, unknown

STEP = 1e-4  # of a parameter's scale, for the Jacobian: well above the integrator's tolerance
MOST_ITERATIONS = 50
# What may be fitted, and its unit in powers of the trace's ranges of force, torque, travel and speed.
SCALES: Mapping[str, tuple[int, int, int, int]] = {
    "k": (1, 0, -1, 0), "k_t": (1, 0, -1, 0), "k_2": (1, 0, -1, 0), "k_3": (1, 0, -1, 0), "k_buffer": (1, 0, -1, 0),
    "C": (1, 0, 0, -1), "rebound": (0, 0, 0, 0), "F_f": (1, 0, 0, 0), "F_0": (1, 0, 0, 0),
    "eps": (0, 0, 1, 0), "x_2": (0, 0, 1, 0), "x_3": (0, 0, 1, 0), "travel": (0, 0, 1, 0),
    "r": (0, 1, -1, 0), "tau_b": (0, 0, 1, -1),
}  # fmt: skip
OF_TORQUE = {"r", "tau_b"}
LENGTHS = {name for name, powers in SCALES.items() if powers == (0, 0, 1, 0)}
MOST_REBOUND = 20.0  # devices have up to some 5; where the data do not tell the damper it would run away


@dataclass(frozen=True)
class Fit:
    """Parameters with which the bench follows a trace, and how well it does."""

    parameters: Parameters  # those that were not fitted as they were given
    estimates: tuple[Estimate, ...]
    correlation: Floats  # (p, p), of the estimates
    trace: Trace
    motion: Motion  # taken to be behind the trace
    model: Mapping[str, Floats]  # of each channel that was fitted, (n,) in SI units
    excess: Mapping[str, float]  # of each, rms of the residual over the noise that is expected
    coherence: Mapping[str, float]  # of each, correlation of the residual from sample to sample; of noise 0

    @property
    def alike(self) -> list[tuple[str, str, float]]:
        """Pairs that are hardly told apart, with their correlation."""
        names = [estimate.name for estimate in self.estimates]
        i, j = np.nonzero(np.triu(np.abs(self.correlation) > ALIKE, 1))
        return [(names[a], names[b], float(self.correlation[a, b])) for a, b in zip(i, j, strict=True)]


def fit(trace: Trace, parameters: Parameters = DATUM, names: Sequence[str] | None = None, fmu: Path = BENCH) -> Fit:
    """Fit the parameters `names`, by default those of `default_names`; the others stay as in `parameters`.

    HitchError for a name that cannot be fitted to what was measured, for a drawbar that does not move or is never
    pushed in, and for an FMU that is no bench.
    """
    torque = trace.trailer_brake_torque is not None
    names = default_names(parameters, torque) if names is None else list(dict.fromkeys(names))
    check_names(names, torque)
    moved = motion(trace)
    if moved.still.all():
        raise HitchError("compression moves no further than its noise; nothing can be learned from it")
    if LENGTHS.intersection(names) and moved.compression.max() <= 0.0:
        raise HitchError(f"compression is {moved.compression.max():.3g} m at most: the drawbar is never pushed in")
    with opened_bench(fmu, moved) as bench:
        problem = Problem(trace, moved, bench, parameters, names)
        u = problem.start()
        for ftol in (1e-3, 1e-6):  # the second time with the noise that is expected where the first has led
            sigma = problem.noise(u)
            found = least_squares(
                lambda u, sigma=sigma: problem.residuals(u, sigma).ravel(),
                u,
                lambda u, sigma=sigma: problem.jacobian(u, sigma),
                problem.bounds,
                ftol=ftol,
                max_nfev=MOST_ITERATIONS,
            )
            u = found.x
        return _told(problem, u, sigma, found.jac)


def check_names(names: Sequence[str], torque: bool) -> None:
    """HitchError for a parameter that cannot be fitted, and for one of the linkage without `torque`."""
    if not names:
        raise HitchError(f"nothing is to be fitted; allowed: {', '.join(SCALES)}")
    for name in names:
        if name not in SCALES:
            raise HitchError(unknown("parameter to fit", name, SCALES))
        if name in OF_TORQUE and not torque:
            raise HitchError(f"{name} cannot be fitted: the trace has no trailer_brake_torque")


class Problem:
    """What the bench makes of scaled parameters u (p,), beside what was measured (channels, n)."""

    def __init__(self, trace: Trace, moved: Motion, bench: Bench, parameters: Parameters, names: Sequence[str]) -> None:
        channels = trace.channels()
        self.trace, self.moved, self.names = trace, moved, names
        self.channels = [name for name in OUTPUTS if name in channels]
        self.measured = np.array([channels[name] for name in self.channels])
        self._bench, self._given = bench, parameters
        torque = channels.get("trailer_brake_torque", trace.F_hitch)  # without, nothing is scaled by it
        ranges = [float(np.ptp(part)) for part in (trace.F_hitch, torque, moved.compression, moved.v_rel)]
        self.scale = np.array([np.prod(np.power(ranges, SCALES[name])) for name in names])
        low, high = np.array([Parameters.limits(name) for name in names]).T
        # A bend beyond the trace's reach would have no effect to go by.
        most = {**dict.fromkeys(LENGTHS, float(moved.compression.max())), "rebound": MOST_REBOUND}
        high = np.minimum(high, [most.get(name, np.inf) for name in names])
        self.bounds = low / self.scale, high / self.scale

    def start(self) -> Floats:
        """The first guess."""
        guess = first_guess(self.trace, self.moved, self._given, self.names)
        first: Floats = np.clip(np.array([guess[name] for name in self.names]) / self.scale, *self.bounds)
        return first

    def parameters(self, u: Floats) -> Parameters:
        """All of them, in SI units."""
        return self._given.changed(dict(zip(self.names, (u * self.scale).tolist(), strict=True)))

    def model(self, u: Floats, shift: float = 0.0) -> Floats:
        """What the bench does (channels, n), moved `shift` m further in."""
        table = self._bench.run(self.parameters(u).model_dump(), shift)
        measured: Floats = table[[OUTPUTS.index(name) for name in self.channels]]
        return measured

    def noise(self, u: Floats) -> Floats:
        """Standard deviation (channels, n) that is expected: the channel's own, and what that of the travel makes."""
        own = np.array([[noise(channel)] for channel in self.measured])
        here, error = self.model(u), self.moved.error
        # Both ways and twice as far, for the sake of samples beside a kink.
        spread = [abs(self.model(u, share * error) - here) / abs(share) for share in (-2.0, -1.0, 1.0, 2.0)]
        both: Floats = np.hypot(own, np.max(spread, axis=0))
        # A guide that is held keeps its friction; one that seems to tremble does not.
        both[self.channels.index("F_hitch"), self.moved.still] = np.inf
        return both

    def residuals(self, u: Floats, sigma: Floats) -> Floats:
        """Model less measurement, over sigma (channels, n)."""
        off: Floats = (self.model(u) - self.measured) / sigma
        return off

    def jacobian(self, u: Floats, sigma: Floats) -> Floats:
        """Of the residuals (channels * n, p), by forward differences; backward where the range ends."""
        here = self.model(u)
        columns = []
        for j in range(len(u)):
            step = STEP if u[j] + STEP <= self.bounds[1][j] else -STEP
            there = self.model(u + step * np.eye(len(u))[j])
            columns.append(((there - here) / sigma / step).ravel())
        return np.column_stack(columns)


def _told(problem: Problem, u: Floats, sigma: Floats, jacobian: Floats) -> Fit:
    residuals = problem.residuals(u, sigma)
    cov, freedom = covariance(list(jacobian.reshape(*residuals.shape, len(u))), list(residuals), problem.moved.memory)
    values, errors = (u * problem.scale).tolist(), (np.sqrt(np.diag(cov)) * problem.scale).tolist()
    effects = np.abs(jacobian).max(axis=0) / problem.scale
    counted = np.isfinite(sigma)
    mean_square = np.sum(residuals**2, axis=1) / counted.sum(axis=1)
    pairs = np.maximum((counted[:, 1:] & counted[:, :-1]).sum(axis=1), 1)
    coherence = np.sum(residuals[:, 1:] * residuals[:, :-1], axis=1) / pairs / mean_square
    return Fit(
        parameters=problem.parameters(u),
        estimates=tuple(map(Estimate, problem.names, values, errors, freedom.tolist(), effects.tolist())),
        correlation=correlation(cov),
        trace=problem.trace,
        motion=problem.moved,
        model=dict(zip(problem.channels, problem.model(u), strict=True)),
        excess=dict(zip(problem.channels, np.sqrt(mean_square).tolist(), strict=True)),
        coherence=dict(zip(problem.channels, coherence.tolist(), strict=True)),
    )
