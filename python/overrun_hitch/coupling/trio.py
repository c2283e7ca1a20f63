"""Hitch.fmu between two bodies that step at the same time, as in simulators that have both vehicles and lack the hitch.

Both bodies are Car.fmu, the second one with the trailer's parameters. What plain exchange does to the oscillation, for
light damping: not the spring alone is late but the brake torque too, many times as strong. The square of the angular
frequency is k/m_c + (k + r/R_t)/m_t, with m_c = M_c + I_c/R_c^2 and m_t = M_t + I_t/R_t^2, and the growth rate rises by
T/2 times that.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from overrun_hitch.coupling.pair import CAR_PARAMETERS, FORCES, Coupled, GuestUnits, Scheme
from overrun_hitch.fmu.guest import Guest
from overrun_hitch.fmu.opening import opened
from overrun_hitch.fmu.settings import TIME_LIMIT, checked_time_limit
from overrun_hitch.fmu.unit import Unit
from overrun_hitch.parameters import Parameters
from overrun_hitch.theory.steady import inertias

TORQUES = {force: force.replace("F_hitch", "trailer_brake_torque") for force in FORCES}
REAR = {name: f"{name[:-1]}t" for name in Parameters.having("of", "car")}  # the car's parameter: the trailer's
HITCH_PARAMETERS = tuple(name for name in Parameters.having("of", "trailer", "link") if name not in REAR.values())
BODY_OUTPUTS = ("v_car", "a_car", "car.body.x")
HITCH_OUTPUTS = ("compression", "v_rel", "F_hitch", "coupling_energy", "drawbar.impulse", "drawbar.work")


@dataclass(frozen=True)
class Trio:
    """Both bodies and the hitch, open."""

    front: Unit
    rear: Unit
    hitch: Unit

    def run(
        self, scheme: Scheme, parameters: Parameters, brake_torque: float, duration: float, H: float, tolerance: float
    ) -> Coupled:
        """As Pair.run, under Jacobi; with force and torque to hold the hitch is told the masses."""
        self.start(scheme, parameters, brake_torque, tolerance)
        outputs = (scheme.force, TORQUES[scheme.force])
        rows, given, created = [self._outputs()], [0.0], [0.0]
        for n in range(round(duration / H)):
            force, torque = self.hitch.get(outputs)
            self.hitch.set(self.speeds())
            self.front.set({"F_hitch": force})
            self.rear.set({"F_hitch": -force, "brake_torque": torque})
            for unit in (self.front, self.rear, self.hitch):
                unit.step(n * H, H)
            rows.append(self._outputs())
            moved = (rows[-1]["car.body.x"] - rows[-2]["car.body.x"]) - (rows[-1]["x_trailer"] - rows[-2]["x_trailer"])
            given.append(given[-1] + force * H)
            created.append(created[-1] + force * moved - (rows[-1]["drawbar.work"] - rows[-2]["drawbar.work"]))
        values = {name: np.array([row[name] for row in rows]) for name in rows[0]}
        return Coupled(np.arange(len(rows), dtype=np.float64) * H, values, np.array(given), np.array(created))

    def start(self, scheme: Scheme, parameters: Parameters, brake_torque: float, tolerance: float) -> None:
        """To t = 0, with the front body braked by `brake_torque` N.m."""
        p = parameters.model_dump()
        front, rear = inertias(parameters)
        told = {"M_front": front, "M_rear": rear} if scheme.lateness == 0.0 else {}
        settings = {"extrapolation": scheme.extrapolation, "applied_force": FORCES[scheme.force], **told}
        self.front.start_with({name: p[name] for name in CAR_PARAMETERS} | {"brake_torque": brake_torque}, tolerance)
        self.rear.start_with({name: p[REAR.get(name, name)] for name in CAR_PARAMETERS}, tolerance)
        speeds = {"v_car": p["V_0"], "v_trailer": p["V_0"]}
        self.hitch.start_with({name: p[name] for name in HITCH_PARAMETERS} | speeds | settings, tolerance)

    def speeds(self) -> dict[str, float]:
        """What the hitch is given, in m/s."""
        return {"v_car": self.front.get(["v_car"])[0], "v_trailer": self.rear.get(["v_car"])[0]}

    def _outputs(self) -> dict[str, float]:
        v, a, x = self.rear.get(BODY_OUTPUTS)
        return {
            **dict(zip(BODY_OUTPUTS, self.front.get(BODY_OUTPUTS), strict=True)),
            **{"v_trailer": v, "a_trailer": a, "x_trailer": x},
            **dict(zip(HITCH_OUTPUTS, self.hitch.get(HITCH_OUTPUTS), strict=True)),
        }


@contextmanager
def guest_trio(body: Path, hitch: Path, time_limit: float = TIME_LIMIT) -> Iterator[GuestUnits]:
    """All three open in one process, as for pair.guest_pair."""
    limit = checked_time_limit(time_limit)
    with Guest(f"{hitch} between two {body}", limit, opened_trio, body, hitch) as guest:
        yield GuestUnits(guest)


@contextmanager
def opened_trio(body: Path, hitch: Path) -> Iterator[Trio]:
    """Twice the FMU of a body and the one of the hitch, open in this process. HitchError as for unit.opened."""
    body_names = [*BODY_OUTPUTS, *CAR_PARAMETERS, "brake_torque", "F_hitch"]
    own = ["v_car", "v_trailer", "M_front", "M_rear", "extrapolation", "applied_force"]
    hitch_names = [*HITCH_OUTPUTS, *HITCH_PARAMETERS, *FORCES, *TORQUES.values(), *own]
    with (
        opened(body, body_names, "a car") as front,
        opened(body, body_names, "a car") as rear,
        opened(hitch, hitch_names, "a hitch") as unit,
    ):
        yield Trio(front, rear, unit)
