"""rumoca's own simulation of a class: another tool's results, for the reference inside the FMU."""

from __future__ import annotations

from importlib.metadata import version
from pathlib import Path

import numpy as np
import rumoca
from numpy.typing import NDArray

from ..errors import BuildError
from ..ir.models import Simulation
from .annotations import class_text, read_experiment
from .audit import refuse_lost_modifiers
from .loading import load
from .used_classes import UsedClasses

REFERENCE_TOLERANCES = (1e-9, 1e-11)  # relative; the difference between the two tells the accuracy


def simulate(path: Path, class_name: str) -> Simulation:
    """rumoca's own simulation of the class ``class_name`` over the time of its experiment annotation.

    Raises BuildError where it does not compile or loses a modifier, does not run, or has no experiment annotation.
    """
    model, sources = load(path, class_name)
    refuse_lost_modifiers(model.to_dict("flat"), sources, UsedClasses(sources.texts_by_number(), class_name))
    experiment = read_experiment(class_text(class_name, sources.texts()))
    if experiment.stop_time is None or experiment.interval is None:
        raise BuildError(
            f"{class_name}: a reference needs StopTime and Interval in an experiment annotation of its own"
        )
    start = experiment.start_time or 0.0
    count = round((experiment.stop_time - start) / experiment.interval)
    times = np.linspace(start, experiment.stop_time, count + 1)
    coarse, fine = (_columns(model, times, tolerance) for tolerance in REFERENCE_TOLERANCES)
    return Simulation(
        class_name=class_name,
        tool=f"rumoca {version('rumoca')}",
        tolerances=REFERENCE_TOLERANCES,
        times=tuple(times.tolist()),
        columns={name: tuple(values.tolist()) for name, values in fine.items()},
        accuracy={name: float(np.abs(fine[name] - coarse[name]).max()) for name in fine},
        parameters={p.name: float(p.value) for p in model.parameters if p.value is not None},
    )


def _columns(model: rumoca.Model, times: NDArray[np.float64], tolerance: float) -> dict[str, NDArray[np.float64]]:
    """Every variable at ``times``. rumoca adds rows at its events, so rows are chosen by their time."""
    config = rumoca.SimConfig(solver="rk-like", rtol=tolerance, atol=tolerance, max_wall_seconds=60)
    try:
        result = model.simulate(t=(times[0], times[-1]), dt=times[1] - times[0], config=config)
    except rumoca.RumocaError as error:
        raise BuildError(f"{model.name}: its simulation failed: {str(error).splitlines()[0]}") from None
    rows = np.abs(np.asarray(result.time)[:, None] - times).argmin(axis=0)
    if np.abs(np.asarray(result.time)[rows] - times).max() > 1e-9 * (times[-1] - times[0]):
        raise BuildError(f"{model.name}: its simulation ended early, at {result.time[-1]:g} s")
    return {name: np.asarray(result[name])[rows] for name in result.names}
