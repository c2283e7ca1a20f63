"""Where the energy of a run of CarTrailer.fmu goes, added up from the unit's own variables."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import cumulative_simpson

from overrun_hitch.parameters import Parameters
from tests.unit import Unit

Floats = NDArray[np.float64]

VEHICLES = ("car", "trailer")
PARTS = (
    "body.x",
    "body.v",
    "body.a",
    "wheel.omega",
    "wheel.tau",
    "wheel.tau_r",
    "body.F_drag",
    "tyre.F",
    "tyre.v_slip",
)
DRAWBAR = ("compression", "v_rel", "F_h", "F_spring")
NAMES = tuple(f"{v}.{p}" for v in VEHICLES for p in PARTS) + tuple(f"drawbar.{p}" for p in DRAWBAR)
G_N = 9.80665


@dataclass(frozen=True)
class Account:
    """All (n,) in J, at `time` in s: what is stored, and by name what has gone since the start, springs of tyres and
    brakes that hold included."""

    time: Floats
    values: Mapping[str, Floats]
    stored: Floats
    gone: Mapping[str, Floats]

    @property
    def imbalance(self) -> float:
        """The largest difference between what has left the store and what has arrived elsewhere."""
        return float(np.abs(self.stored - self.stored[0] + sum(self.gone.values())).max())


def in_drawbar(p: Parameters, x: Floats) -> Floats:
    """What the drawbar's springs store (J) at the compressions `x` (m): a parabola from each change of stiffness on."""
    yields = p.eps + p.F_0 / p.k_t
    changes = [
        (p.eps, p.k_t),
        (yields, p.k - p.k_t),
        (p.eps + p.x_2, p.k_2 - p.k),
        (p.eps + p.x_3, p.k_3 - p.k_2),
        (p.travel, p.k_buffer - p.k_3),
    ]
    compressed = sum(0.5 * change * np.maximum(x - start, 0.0) ** 2 for start, change in changes)
    return np.asarray(compressed + 0.5 * p.k_t * np.minimum(x, 0.0) ** 2)


def follow(unit: Unit, parameters: Parameters, grade: float, duration: float, h: float) -> Account:
    """Go on with a unit that has been started, and sample it every `h` (s)."""
    rows = [unit.get(*NAMES)]
    for n in range(round(duration / h)):
        unit.slave.doStep(n * h, h)
        rows.append(unit.get(*NAMES))
    return account(parameters, grade, h, np.array(rows))


def account(parameters: Parameters, grade: float, h: float, samples: Floats) -> Account:
    """Add up `samples`, rows of NAMES every `h` (s) from a run's start."""
    values = dict(zip(NAMES, samples.T, strict=True))
    values["trailer.body.x"] = values["car.body.x"] + values["drawbar.compression"]

    def integral(power: Floats) -> Floats:
        return np.asarray(cumulative_simpson(power, dx=h, initial=0.0))

    p, x = parameters, values["drawbar.compression"]
    stored = in_drawbar(p, x)
    damper = -values["drawbar.F_h"] - values["drawbar.F_spring"]
    gone = {"damper": integral(damper * values["drawbar.v_rel"])}
    for name, M, inertia in (("car", p.M_c, p.I_c), ("trailer", p.M_t, p.I_t)):
        of = {part: values[f"{name}.{part}"] for part in PARTS}
        stored += 0.5 * M * of["body.v"] ** 2 + 0.5 * inertia * of["wheel.omega"] ** 2
        stored += M * G_N * np.sin(np.arctan(grade)) * of["body.x"]
        gone[f"{name} tyres"] = integral(of["tyre.F"] * of["tyre.v_slip"])
        gone[f"{name} brakes"] = integral(of["wheel.tau"] * of["wheel.omega"])
        gone[f"{name} rolling resistance"] = integral(of["wheel.tau_r"] * of["wheel.omega"])
        gone[f"{name} drag"] = integral(of["body.F_drag"] * of["body.v"])
    return Account(h * np.arange(len(samples)), values, stored, gone)
