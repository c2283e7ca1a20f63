"""What `hitch reference` says and writes beside the trajectories."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

from overrun_hitch.foreign.mapping import GRADE, OURS
from overrun_hitch.parameters import Parameters, Scenario
from overrun_hitch.reference.trajectories import ALLOWED, STEP, TOLERANCES, Trajectory
from overrun_hitch.results import VARIABLES, values
from overrun_hitch.show.table import Column, Numbers, coloured, console, show_rows, show_written, small

COLUMNS = (
    Column("case"), Numbers("compression", unit="m"), Numbers("F_hitch", unit="N"), Numbers("v_car", unit="m/s"),
    Numbers("worst", unit="of range"), Column("verdict"),
)  # fmt: skip


def show(found: Mapping[str, Trajectory], paths: Sequence[Path]) -> None:
    """How far the two solvers are apart, and the files written."""
    out = console()
    out.print("largest distance of the two solvers, the unit's own and CVODE:")
    rows = [
        (name, *(small(one.accuracy[key]) for key in ("compression", "F_hitch", "v_car")), small(_worst(one)),
         coloured("differs" if one.differing else "agrees"))
        for name, one in found.items()
    ]  # fmt: skip
    show_rows(out, COLUMNS, rows, (f"{row[0]}: compression {row[1]} m, {row[4]} of a range, {row[5]}" for row in rows))
    show_written(out, paths)


def _worst(one: Trajectory) -> float:
    return max(far / (float(np.ptp(values(one.run, name))) or 1.0) for name, far in one.accuracy.items())


def document(fmu: Path, found: Mapping[str, Trajectory], paths: Sequence[Path]) -> dict[str, Any]:
    """The index of the set, for JSON: SI units; its keys: docs/crosscheck.md."""
    return {
        "agrees": not any(one.differing for one in found.values()),
        "fmu": {"path": str(fmu), "sha256": hashlib.sha256(fmu.read_bytes()).hexdigest()},
        "versions": {name: version(name) for name in ("fmpy", "numpy")},
        "settings": {"step": STEP, "tolerances": dict(TOLERANCES), "allowed": ALLOWED},
        "cases": [
            {
                "case": name,
                "brake_torque": one.scenario.brake_torque,
                "duration": one.scenario.duration,
                "parameters": one.scenario.parameters.model_dump(),
                "accuracy": dict(one.accuracy),
            }
            for name, one in found.items()
        ],
        "files": [str(path) for path in paths],
    }


def parameters(one: Trajectory) -> bytes:
    """For --parameters of the other commands."""
    scenario = one.scenario
    lines = [f"# {scenario.name}: brake_torque = {scenario.brake_torque!r} N.m for {scenario.duration!r} s"]
    for name in Parameters.model_fields:
        value = getattr(scenario.parameters, name)
        lines.append(f"{name} = {value!r}  # {Parameters.unit(name)}, {Parameters.description(name)}")
    return ("\n".join(lines) + "\n").encode()


def mapping() -> bytes:
    """For --map: every name as it is here, for who has others to put theirs in."""
    described = {
        "time": "time", "brake_torque": Scenario.description("brake_torque"), "grade": GRADE,
        **{name: text for name, (_, text) in VARIABLES.items()},
    }  # fmt: skip
    lines = ["# Put in what yours are called; a table that is left out stands for the same name."]
    for name, unit in OURS.items():
        text = described.get(name) or Parameters.description(name)
        lines += ["", f"[{name}]  # {text}", f'theirs = "{name}"', f'unit = "{unit}"', "sign = 1"]
    return ("\n".join(lines) + "\n").encode()
