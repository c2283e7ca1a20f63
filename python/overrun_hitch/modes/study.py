"""Linear stability for any parameters: the shunting mode at every damper and speed, as a table, JSON and CSV."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np

from overrun_hitch.parameters import FASTEST, HitchError, Parameters, Quantities, quantity
from overrun_hitch.theory.boundary import critical_damping
from overrun_hitch.theory.dry_friction import onset_amplitude
from overrun_hitch.theory.linear import check_known, compression_matrix, shunting_mode
from overrun_hitch.theory.steady import braking_at, steady
from overrun_hitch.theory.working_point import WorkingPoint, working_point

MOST = 10_000  # combinations of C and V: about a second
HARD = 5.0  # m/s2, the deceleration for which the paper's figure 3 gives deflections
ROUNDING = 1e-12  # of the greatest entry of the matrix: below it an eigenvalue is noise


class Speed(Quantities):
    """A speed to linearise about; the highest is that of the FMU."""

    V: float = quantity(20.0, "m/s", "speed", ge=0.1, le=FASTEST)


@dataclass(frozen=True)
class Row:
    """The shunting mode at one speed and one damper coefficient."""

    V: float  # m/s
    C: float  # N.s/m
    growth_rate: float  # 1/s, positive: self-excited
    frequency: float  # Hz; 0 where the damper is so strong that the mode creeps back
    damping_ratio: float  # 1
    amplitude_ratio: float  # 1, |x_t / x_c|
    phase: float  # degrees, between x_t and x_c
    onset_amplitude: float | None  # m, beyond which motions grow; None: no dry friction, or none grows
    self_excited: bool


UNITS: Mapping[str, str] = {
    "V": "m/s", "C": "N.s/m", "growth_rate": "1/s", "frequency": "Hz", "damping_ratio": "1", "amplitude_ratio": "1",
    "phase": "deg", "self_excited": "1", "C_crit": "N.s/m", "A_over_A_c": "1", "deceleration": "m/s2", "D": "m",
    "from": "m", "until": "m", "onset_amplitude": "m",
}  # fmt: skip


@dataclass(frozen=True)
class Boundary:
    """The damper coefficient with which the shunting mode neither grows nor decays."""

    V: float  # m/s
    C_crit: float  # N.s/m; 0: stable without a damper


@dataclass(frozen=True)
class Stability:
    """What linear theory says about a combination."""

    name: str
    parameters: Parameters
    rows: tuple[Row, ...]  # speed by speed
    boundaries: tuple[Boundary, ...]  # one a speed
    point: WorkingPoint  # about which small motions are looked at
    deceleration: float  # m/s2, of what follows
    A_over_A_c: float  # 1, steady deceleration over that of the car alone
    D: float  # m, drawbar compression, clearance included

    @property
    def approximate(self) -> tuple[str, ...]:
        """The parameters for which theory has an equivalent."""
        return self.parameters.off_default("approximate")


def stability(
    name: str, parameters: Parameters, C: Sequence[float], V: Sequence[float], deceleration: float = 0.0
) -> Stability:
    """The shunting mode at every C (N.s/m) for every V (m/s); C and V_0 of `parameters` do not count.

    About steady braking by `deceleration` (m/s2); 0: as gentle as a drawbar in compression allows. HitchError for what
    theory does not know, values out of range, more than MOST combinations, no shunting mode (k = r = 0), and numbers so
    large or small that floating point does not suffice.
    """
    check_known(parameters)
    if len(C) * len(V) > MOST:
        raise HitchError(f"C and V make {len(C) * len(V)} combinations; allowed: at most {MOST}")
    speeds = [Speed(V=value).V for value in V]
    try:
        point = working_point(parameters, deceleration)
        dampers = [point.linear.changed({"C": value}) for value in C]
        with np.errstate(over="raise", divide="raise", invalid="raise"):
            rows = tuple(_row(damped, speed) for speed in speeds for damped in dampers)
            boundaries = tuple(Boundary(speed, critical_damping(point.linear, speed)) for speed in speeds)
        ratio, D = _steady_state(parameters, deceleration or HARD)
    except (np.linalg.LinAlgError, ArithmeticError):
        raise HitchError("the parameters differ by so many orders of magnitude that no modes can be computed") from None
    return Stability(name, parameters, rows, boundaries, point, deceleration or HARD, ratio, D)


def _steady_state(parameters: Parameters, deceleration: float) -> tuple[float, float]:
    """A/A_c (1), and D (m) at the deceleration (m/s2)."""
    found = steady(parameters, braking_at(parameters, deceleration)[2])
    if not (math.isfinite(found.ratio) and math.isfinite(found.D)):
        raise ArithmeticError
    return found.ratio, found.D


def _row(damped: Parameters, V: float) -> Row:
    mode = shunting_mode(damped, V)
    growth_rate = float(mode.growth_rate)
    if abs(mode.eigenvalue) < ROUNDING * np.abs(compression_matrix(damped, V)).max():
        raise ArithmeticError
    return Row(
        V=V,
        C=damped.C,
        growth_rate=growth_rate,
        frequency=float(mode.frequency),
        damping_ratio=float(mode.damping_ratio),
        amplitude_ratio=float(mode.amplitude_ratio),
        phase=float(mode.phase),
        self_excited=growth_rate > 0.0,
        onset_amplitude=onset_amplitude(damped, V) if damped.F_f > 0.0 and growth_rate > 0.0 else None,
    )


def document(result: Stability, files: Sequence[Path] = ()) -> dict[str, Any]:
    """Everything with units, for JSON; `files` are those written beside."""
    known = Parameters.having("theory", "exact", "small", "large", "approximate")
    taken = [name for name in known if name != "C"]  # which stands in the rows
    low, high = result.point.reach
    used = {name: getattr(result.parameters, name) for name in taken}
    return {
        "name": result.name,
        "parameters": {name: {"value": value, "unit": Parameters.unit(name)} for name, value in used.items()},
        "units": dict(UNITS),
        "working_point": {
            "deceleration": result.point.deceleration,
            "D": result.point.compression,
            "stiffness": result.point.stiffness,
            "from": low,
            "until": high if math.isfinite(high) else None,
        },
        "approximate": list(result.approximate),
        "steady": {"A_over_A_c": result.A_over_A_c, "deceleration": result.deceleration, "D": result.D},
        "critical_damping": [asdict(boundary) for boundary in result.boundaries],
        "shunting_mode": [asdict(row) for row in result.rows],
        "files": [str(path) for path in files],
    }


def csv_columns(result: Stability) -> dict[str, list[Any]]:
    """The rows by names with units ("V [m/s]", "C [N.s/m]", ...), self_excited as 1 or 0."""
    columns = {
        f"{field.name} [{UNITS[field.name]}]": [getattr(row, field.name) for row in result.rows]
        for field in fields(Row)
    }
    return {
        name: [int(value) if isinstance(value, bool) else value for value in values] for name, values in columns.items()
    }
