"""How much each parameter counts for damping and for jerk: Sobol indices, the modern form of the paper's section 8.2.

All parameters vary at once, each evenly over a share of its value to either side, as far as that is allowed. The first
index of a parameter is the share of the variance that it alone explains, the total index the share that is gone when it
is held fixed (A. Saltelli et al., Comput. Phys. Commun. 181 (2010) 259-270, doi 10.1016/j.cpc.2009.09.018; computed by
SALib).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from SALib.analyze import sobol as analysis
from SALib.sample import sobol as sampling

from overrun_hitch.parameters import HitchError, Parameters, Quantities, quantity
from overrun_hitch.sweeps.plan import Plan
from overrun_hitch.sweeps.planner import planned
from overrun_hitch.sweeps.spec import SweepSpec

Floats = NDArray[np.float64]

METRICS = ("damping_ratio", "peak_jerk")
SEED = 1
NO_DAMPING = "its drawbar does not oscillate, or not as an exponential"


class Variation(Quantities):
    """How far parameters vary, and how often."""

    spread: float = quantity(0.2, "1", "share of its value by which a parameter varies to either side", gt=0.0, lt=1.0)
    samples: int = quantity(256, "1", "number of samples, a power of two", ge=16, le=16384)


@dataclass(frozen=True)
class Indices:
    """Of one metric: arrays (parameters,), the halves of their 95 % confidence intervals beside them."""

    first: Floats
    first_confidence: Floats
    total: Floats
    total_confidence: Floats


@dataclass(frozen=True)
class Sensitivity:
    """Indices by metric."""

    names: tuple[str, ...]
    indices: Mapping[str, Indices]
    runs: int

    def ranked(self) -> list[int]:
        """The places of the parameters, the most important for the first metric first."""
        return [int(place) for place in np.argsort(-next(iter(self.indices.values())).total, kind="stable")]


def varied(base: Parameters) -> dict[str, float]:
    """The parameters that can vary by a share of their value: all but those that are 0."""
    return {name: value for name, value in base.model_dump().items() if value != 0.0}


def plan_variation(base: Parameters, variation: Variation, fmu: Path, name: str, **settings: Any) -> Plan:
    """The sweep to analyse, samples * (parameters + 2) runs; `settings`: a SweepSpec's. HitchError as `planned`."""
    if variation.samples & (variation.samples - 1):
        raise HitchError(f"samples = {variation.samples} is not allowed: it must be a power of two, 16 to 16384")
    table = sampling.sample(_problem(base, variation), variation.samples, calc_second_order=False, seed=SEED)
    columns = dict(zip(varied(base), table.T.tolist(), strict=True))
    fixed = {name: value for name, value in base.model_dump().items() if name not in columns}
    return planned(SweepSpec(name=name, parameters=fixed, runs=columns, metrics=METRICS, **settings), [fmu])


def analysed(sweep: xr.Dataset, base: Parameters, variation: Variation) -> Sensitivity:
    """The indices of a sweep by `plan_variation`. HitchError where a run failed or has no damping to measure."""
    problem = _problem(base, variation)
    found = {}
    for metric in METRICS:
        values = np.asarray(sweep[metric].values, dtype=np.float64)
        missing = int(np.isnan(values).sum())
        if missing:
            why = next((str(text) for text in sweep["message"].values if text), NO_DAMPING)
            raise HitchError(
                f"{missing} of {values.size} runs have no {metric}, the first of them because {why}; allowed: "
                "parameters with which all runs do, or a smaller spread"
            )
        result = analysis.analyze(problem, values, calc_second_order=False, seed=SEED)
        found[metric] = Indices(*(np.asarray(result[key]) for key in ("S1", "S1_conf", "ST", "ST_conf")))
    return Sensitivity(tuple(varied(base)), found, sweep.sizes["run"])


def _problem(base: Parameters, variation: Variation) -> dict[str, Any]:
    """What SALib wants to know."""
    names = varied(base)
    bounds = [_bounds(name, value, variation.spread) for name, value in names.items()]
    return {"num_vars": len(bounds), "names": list(names), "bounds": bounds}


def _bounds(name: str, value: float, spread: float) -> list[float]:
    """Where the parameter varies: as far to either side as it is allowed."""
    lowest, highest = Parameters.limits(name)
    low, high = sorted((value * (1.0 - spread), value * (1.0 + spread)))
    return [max(low, lowest), min(high, highest)]
