"""A mapping: what others call our variables, with which sign and in which unit. A TOML file, a table for each.

[F_hitch]
theirs = "Vehicle.hitch.force"
sign = -1
unit = "kN"
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any

from overrun_hitch.parameters import HitchError, Parameters, Scenario, unknown
from overrun_hitch.results import VARIABLES
from overrun_hitch.toml_file import read_toml

GRADE = "rise of the road over its run"
# All that may have another name elsewhere, with its unit here.
OURS: Mapping[str, str] = MappingProxyType(
    {
        "time": "s",
        "brake_torque": Scenario.unit("brake_torque"),
        "grade": "1",
        **{name: unit for name, (unit, _) in VARIABLES.items()},
        **{name: Parameters.unit(name) for name in Parameters.model_fields},
    }
)
FORM = 'allowed: theirs = "NAME", and if need be sign = -1 and unit = "UNIT"'


@dataclass(frozen=True)
class Theirs:
    """One of our variables elsewhere."""

    name: str
    sign: float = 1.0  # 1 or -1
    unit: str | None = None  # None: what the file itself says


Names = Mapping[str, Theirs]  # by our name; who is not in it has the same name there
NO_NAMES: Names = MappingProxyType({})


def read_mapping(path: Path) -> dict[str, Theirs]:
    """The mapping in a TOML file. HitchError, naming it, where it is none."""
    return {name: _theirs(path, name, table) for name, table in read_toml(path).items()}


def _theirs(path: Path, name: str, table: Any) -> Theirs:
    if name not in OURS:
        raise HitchError(f"{path}: {unknown('variable', name, OURS)}")
    if not isinstance(table, dict) or not {"theirs"} <= table.keys() <= {"theirs", "sign", "unit"}:
        raise HitchError(f"{path}: [{name}] is not allowed as it is; {FORM}")
    theirs, sign, unit = table["theirs"], table.get("sign", 1), table.get("unit")
    if not isinstance(theirs, str) or not theirs:
        raise HitchError(f"{path}: theirs = {theirs!r:.40} of [{name}] is no name; {FORM}")
    if isinstance(sign, bool) or sign not in (1, -1):
        raise HitchError(f"{path}: sign = {sign!r:.40} of [{name}] is not allowed; allowed: 1 or -1")
    if unit is not None and not isinstance(unit, str):
        raise HitchError(f"{path}: unit = {unit!r:.40} of [{name}] is no text; {FORM}")
    return Theirs(theirs, float(sign), unit)
