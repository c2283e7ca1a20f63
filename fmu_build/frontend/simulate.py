"""rumoca's own simulation of a class: another tool's results, for the reference inside the FMU."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import BuildError
from ..ir.models import Simulation
from .annotations import class_text, read_experiment
from .audit import refuse_lost_modifiers
from .loading import load, run
from .used_classes import UsedClasses

REFERENCE_TOLERANCES = (1e-9, 1e-11)  # relative; the difference between the two tells the accuracy


def simulations(path: Path, class_names: Sequence[str], libraries: Sequence[Path] = ()) -> list[Simulation]:
    """`simulate` for each class, side by side: most of the work is rumoca's, in processes of their own."""
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(lambda name: simulate(path, name, libraries), class_names))


def simulate(path: Path, class_name: str, libraries: Sequence[Path] = ()) -> Simulation:
    """rumoca's own simulation of the class ``class_name`` over the time of its experiment annotation.

    Raises BuildError where it does not compile or loses a modifier, does not run, or has no experiment annotation.
    """
    flat, sources = load(path, class_name, libraries)
    refuse_lost_modifiers(flat, sources, UsedClasses(sources.texts_by_number(), class_name))
    experiment = read_experiment(class_text(class_name, sources.texts()))
    if experiment.stop_time is None or experiment.interval is None:
        raise BuildError(
            f"{class_name}: a reference needs StopTime and Interval in an experiment annotation of its own"
        )
    start = experiment.start_time or 0.0
    count = round((experiment.stop_time - start) / experiment.interval)
    times = np.linspace(start, experiment.stop_time, count + 1)
    found = run(path, class_name, libraries, times.tolist(), REFERENCE_TOLERANCES)
    coarse, fine = (_columns(class_name, result, times) for result in found["runs"])
    return Simulation(
        class_name=class_name,
        tool=f"rumoca {version('rumoca')}",
        tolerances=REFERENCE_TOLERANCES,
        times=tuple(times.tolist()),
        columns={name: tuple(values.tolist()) for name, values in fine.items()},
        accuracy={name: float(np.abs(fine[name] - coarse[name]).max()) for name in fine},
        parameters={name: float(value) for name, value in found["parameters"].items()},
    )


def _columns(class_name: str, result: Mapping[str, Any], times: NDArray[np.float64]) -> dict[str, NDArray[np.float64]]:
    """Every variable at ``times``. rumoca adds rows at its events, so rows are chosen by their time."""
    found = np.asarray(result["times"])
    rows = np.abs(found[:, None] - times).argmin(axis=0)
    if np.abs(found[rows] - times).max() > 1e-9 * (times[-1] - times[0]):
        raise BuildError(f"{class_name}: its simulation ended early, at {found[-1]:g} s")
    return {name: np.asarray(values)[rows] for name, values in result["columns"].items()}
