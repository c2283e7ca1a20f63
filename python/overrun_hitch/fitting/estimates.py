"""What a least-squares fit says about its parameters: standard errors, and what the data cannot tell."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import t

from overrun_hitch.fitting.trace import Floats
from overrun_hitch.parameters import DATUM, Parameters

INSIDE = 0.95  # of the true values are in their intervals
SEEN = 3.0  # effect over noise from which on one sees it in a sample
TOLD = 0.25  # standard error over value up to which a parameter is told: its 95 % interval is half of it up and down
# Of parameters that may be 0, the smallest that makes a difference to car and trailer (docs/fit.md): a smaller one is
# told when it is known to be small.
MATTERS = {"C": 100.0, "rebound": 1.0, "F_f": 50.0, "eps": 0.005, "F_0": 100.0, "tau_b": 0.02}
ALIKE = 0.99  # correlation from which on two parameters are hardly told apart
LOST = 1e-5  # of the largest singular value: below is what differences of 1e-4 leave of nothing


@dataclass(frozen=True)
class Estimate:
    """A parameter that was fitted, in SI units."""

    name: str
    value: float
    standard_error: float  # infinite where the data say nothing
    freedom: float  # degrees of freedom: how many independent samples the standard error itself rests on
    effect: float  # of one unit of it, on the sample that it moves most, over that sample's noise

    @property
    def unit(self) -> str:
        """As the FMU writes it."""
        return Parameters.unit(self.name)

    @property
    def interval(self) -> tuple[float, float]:
        """In which the true value is with 95 % (Student's t), cut at the allowed range."""
        low, high = Parameters.limits(self.name)
        reach = float(t.ppf(0.5 + INSIDE / 2.0, self.freedom)) * self.standard_error
        return max(low, self.value - reach), min(high, self.value + reach)

    @property
    def told(self) -> bool:
        """Whether the data tell it, to a half of its value or of what matters.

        Not where one does not see it in any sample: what rests on means of many alone, small faults of the sensors and
        of the model imitate.
        """
        size = max(abs(self.value), MATTERS.get(self.name, 0.0))
        return self.standard_error <= TOLD * size and self.effect * size >= SEEN


def covariance(J: Sequence[Floats], residuals: Sequence[Floats], memory: int) -> tuple[Floats, Floats]:
    """Covariance (p, p) of fitted parameters and its degrees of freedom (p,); infinite where the data say nothing.

    `J` are the Jacobians (n, p) and `residuals` (n,) of each channel. With white residuals it is s^2 (J^T J)^-1. What
    is left of the noise in the motion hangs together over `memory` samples, and counts most where the drawbar is stiff;
    so between two such inverses stand the products of the residuals themselves (Newey and West 1987), each as it would
    be had its sample not been fitted (MacKinnon and White 1985). A clearance rests on few samples: degrees of freedom
    are Satterthwaite's, of parts of half that length taken as independent.
    """
    p = J[0].shape[1]
    lost, inverse = _inverse(np.vstack(J))
    middle = np.zeros((p, p))
    parts = []
    for j, e in zip(J, residuals, strict=True):
        leverage = np.sum((j @ inverse) * j, axis=1)
        scores = j * (e / np.maximum(1.0 - leverage, LOST))[:, np.newaxis]
        sums = np.cumsum(np.pad(scores, ((memory, memory), (0, 0))), axis=0)
        over_memory = (
            sums[memory:] - sums[:-memory]
        )  # pairs of samples come in ever fewer sums the farther apart they are
        middle += over_memory.T @ over_memory / memory
        parts.append(np.add.reduceat((j @ inverse) ** 2, np.arange(0, len(e), max(1, memory // 2)), axis=0))
    found: Floats = inverse @ middle @ inverse
    # Never less than of white residuals: a sample that a parameter is there for alone leaves none.
    white = np.concatenate(residuals).var() * np.diag(inverse)
    wider = np.sqrt(np.maximum(1.0, np.divide(white, np.diag(found), out=np.ones(p), where=np.diag(found) > 0.0)))
    found *= np.outer(wider, wider)
    found[lost, :] = found[:, lost] = 0.0
    found[lost, lost] = math.inf
    share = np.vstack(parts)
    freedom = np.where(lost, 1.0, share.sum(axis=0) ** 2 / np.where(lost, 1.0, (share**2).sum(axis=0)))
    return found, np.maximum(freedom, 1.0)


def correlation(cov: Floats) -> Floats:
    """Of the parameters with each other (p, p), 0 for those that are not told at all."""
    sigma = np.sqrt(np.diag(cov))
    told = np.isfinite(sigma) & (sigma > 0.0)
    found: Floats = np.where(np.outer(told, told), cov, 0.0)
    scale = np.where(told, sigma, 1.0)
    found /= np.outer(scale, scale)
    return found


def _inverse(J: Floats) -> tuple[Floats, Floats]:
    """Which parameters (p,) are in a direction that has no effect, and the inverse (p, p) of J^T J without those."""
    size = np.linalg.norm(J, axis=0)
    scale = np.where(size > LOST * size.max(), size, math.inf)  # no effect at all: a column of zeros
    _, s, Vt = np.linalg.svd(J / scale, full_matrices=False)
    seen = s > LOST * s[0]
    lost = np.isinf(scale) | (np.abs(Vt[~seen]) > math.sqrt(LOST)).any(axis=0)
    half = Vt[seen].T / s[seen] / scale[:, np.newaxis]
    return lost, half @ half.T


def default_names(parameters: Parameters, torque: bool) -> list[str]:
    """What is fitted unless one says otherwise: what the channels tell, a stiffness where its x_i is set."""
    further = [f"k_{i}" for i in (2, 3) if getattr(parameters, f"x_{i}") != getattr(DATUM, f"x_{i}")]
    return ["k", *further, "F_0", "C", "rebound", "F_f", "eps", *(["r", "tau_b"] if torque else [])]
