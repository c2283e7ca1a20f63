"""A run as a labelled table: variables over time with units, and what a CSV file of it holds.

As xarray for those who script, as a Run for ourselves: xarray takes most of a second to load.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from overrun_hitch.decimals import decimals
from overrun_hitch.parameters import HitchError, Parameters, Scenario

if TYPE_CHECKING:
    import xarray as xr

Floats = NDArray[np.float64]

# Outputs of the FMU in the order of the CSV's columns: unit, long name with its sign convention.
VARIABLES: Mapping[str, tuple[str, str]] = {
    "v_car": ("m/s", "speed of the car"),
    "v_trailer": ("m/s", "speed of the trailer"),
    "a_car": ("m/s2", "acceleration of the car, positive forward"),
    "a_trailer": ("m/s2", "acceleration of the trailer, positive forward"),
    "compression": ("m", "drawbar compression, trailer's less car's displacement"),
    "F_hitch": ("N", "hitch force on the car, positive forward: a pushing trailer gives a positive value"),
    "slip_car": ("1", "longitudinal slip of the car's wheels, positive braking"),
    "slip_trailer": ("1", "longitudinal slip of the trailer's wheels, positive braking"),
    "trailer_brake_torque": ("N.m", "brake torque on the trailer's wheels"),
}


@dataclass(frozen=True)
class Run:
    """Samples (n,) of VARIABLES, in their units, at `time` (n,) in s; `attrs` as of a `dataset`."""

    time: Floats
    columns: Mapping[str, Floats]
    attrs: Mapping[str, Any]

    def dataset(self) -> xr.Dataset:
        """The same as xarray."""
        return dataset(self.time, self.columns, self.attrs)


AnyRun = TypeVar("AnyRun", bound="Run | xr.Dataset")


def dataset(time: Floats, columns: Mapping[str, Floats], attributes: Mapping[str, object]) -> xr.Dataset:
    """A result: dimension `time` (n,) in s, the VARIABLES (n,) of `columns`, each with units and long_name.

    `attributes` of a run are the parameters by name in SI units, scenario, brake_torque (N.m), duration (s), and what
    made it: fmu, relative_tolerance, communication_step (s), versions.
    """
    import xarray as xr

    variables = {
        name: ("time", np.asarray(columns[name], dtype=np.float64), {"units": unit, "long_name": long_name})
        for name, (unit, long_name) in VARIABLES.items()
    }
    axis = ("time", np.asarray(time, dtype=np.float64), {"units": "s", "long_name": "time"})
    return xr.Dataset(variables, coords={"time": axis}, attrs=dict(attributes))


def scenario_attributes(scenario: Scenario) -> dict[str, object]:
    """The attributes that say what was run, flat, so that any file format can hold them."""
    return {
        "scenario": scenario.name,
        "brake_torque": scenario.brake_torque,
        "duration": scenario.duration,
        **scenario.parameters.model_dump(),
    }


def scenario_of(result: Run | xr.Dataset) -> Scenario:
    """The scenario that made a result, from its attributes; HitchError where they are missing."""
    attributes = result.attrs
    missing = [
        name for name in ("scenario", "brake_torque", "duration", *Parameters.model_fields) if name not in attributes
    ]
    if missing:
        raise HitchError(f"the result does not say what was run: attribute {missing[0]} is missing")
    return Scenario(
        name=str(attributes["scenario"]),
        parameters=Parameters(**{name: attributes[name] for name in Parameters.model_fields}),
        brake_torque=attributes["brake_torque"],
        duration=attributes["duration"],
    )


def missing(result: Run | xr.Dataset) -> tuple[str, ...]:
    """The VARIABLES that what was run has not, and whose samples are NaN for it."""
    return tuple(filter(None, str(result.attrs.get("missing", "")).split(", ")))


def values(result: Run | xr.Dataset, name: str) -> Floats:
    """The samples (n,) of a variable or of "time"."""
    if isinstance(result, Run):
        return result.time if name == "time" else result.columns[name]
    return np.asarray(result[name].values, dtype=np.float64)


def with_samples(result: AnyRun, samples: Mapping[str, Floats]) -> AnyRun:
    """The result with other samples (n,) of some variables."""
    if isinstance(result, Run):
        return cast("AnyRun", replace(result, columns={**result.columns, **samples}))
    described = {name: ("time", column, result[name].attrs) for name, column in samples.items()}
    return cast("AnyRun", result.assign(described))


def columns(result: Run | xr.Dataset) -> dict[str, Floats]:
    """Time and variables (n,) by their names with units, "time [s]": the columns of a CSV file.

    Times, which are multiples of the step, without what rounding has made of them.
    """
    table = {f"{name} [{unit}]": values(result, name) for name, (unit, _) in VARIABLES.items()}
    return {"time [s]": np.array(decimals(values(result, "time"))), **table}


def read_csv(path: Path) -> xr.Dataset:
    """Read a file of `columns`; attributes of the run are not in it. HitchError for anything else."""
    try:
        with path.open(encoding="utf-8", newline="") as file:
            header, *rows = list(csv.reader(file))
        heads = [re.fullmatch(r"(\w+) \[([^\]]*)\]", head) for head in header]
        table = np.array(rows, dtype=np.float64).reshape(len(rows), len(header))
    except OSError as error:
        raise HitchError(f"cannot read {path}: {error.strerror or error}") from None
    except (ValueError, UnicodeDecodeError, csv.Error):
        raise HitchError(f"{path} is not a table of numbers under one line of names with units") from None
    units = {head[1]: head[2] for head in heads if head}
    wanted = {"time": "s", **{name: unit for name, (unit, _) in VARIABLES.items()}}
    if units != wanted:
        wrong = next((name for name in wanted if units.get(name) != wanted[name]), "another column")
        raise HitchError(
            f"{path} has no usable column {wrong!r}; needed: {', '.join(f'{n} [{u}]' for n, u in wanted.items())}"
        )
    found = dict(zip(units, table.T, strict=True))
    return dataset(found.pop("time"), found, {})
