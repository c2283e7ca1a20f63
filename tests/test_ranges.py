"""Each parameter at the ends of its range, alone: the run is right, in so many evaluations; beyond it is refused."""

from __future__ import annotations

import ctypes
import math
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import fmi2CallbackFunctions, fmi2CallbackLoggerTYPE, fmi2Discard

from overrun_hitch.parameters import DATUM, Parameters
from tests.fmu_build.runtime.runtime_unit import LOGGER
from tests.sampling import spread
from tests.unit import Unit

BRAKE = 1000.0  # N.m
NAMES = ("v_car", "v_trailer", "car.wheel.omega", "trailer.wheel.omega", "compression", "trailer_brake_torque")
# For one second at 1e-6. The most is taken by a drawbar pulled out by a kilometre, which swings back at 30 km/s.
MOST_EVALUATIONS = 50_000
# Here not all of the impulse comes through brakes whose torque is told: wheels lock, there is drag, it goes backward,
# or what the brake of the trailer does lies between two communication points.
OTHER_IMPULSES = {"C_kc", "C_kt", "r", "mu", "sigma", "CdA_c", "CdA_t", "C_rr", "V_0", "compression_start"}


class Counted(Unit):
    """`evaluations` of the derivatives, summed up from what the log category logSteps says."""

    evaluations = 0
    said = ""

    def instantiate(self) -> None:
        self._receiver = LOGGER(self._receive)
        logger = ctypes.cast(self._receiver, fmi2CallbackLoggerTYPE)
        self.slave.instantiate(callbacks=fmi2CallbackFunctions(logger))

    def _receive(self, _env: object, _name: bytes, _status: int, _category: bytes, _format: bytes, text: bytes) -> None:
        self.said = text.decode()
        self.evaluations += sum(map(int, re.findall(r"(\d+) evaluations", self.said)))

    def run(self, values: dict[str, float], tolerance: float) -> np.ndarray:
        """Rows of NAMES every 10 ms for one second."""
        self.slave.reset()
        self.slave.setDebugLogging(True, ["logSteps"])
        self.evaluations = 0
        self.set(brake_torque=BRAKE, **values)
        self.slave.setupExperiment(tolerance=tolerance, startTime=0.0)
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()
        rows = [self.get(*NAMES)]
        for n in range(100):
            self.slave.doStep(0.01 * n, 0.01)
            rows.append(self.get(*NAMES))
        return np.array(rows)


@pytest.fixture(scope="module")
def unit(car_trailer_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Counted]:
    unit = Counted(car_trailer_fmu, tmp_path_factory.mktemp("unpacked"))
    unit.instantiate()
    yield unit
    unit.slave.freeInstance()


def ends(name: str) -> list[float]:
    low, high = Parameters.limits(name)
    return [low, max(low, 1e-300), high]


def missing_impulse(rows: np.ndarray, p: Parameters) -> float:
    """What momentum has not come from the brakes, over what has."""
    momentum = rows[:, :4] @ [p.M_c, p.M_t, p.I_c / p.R_c, p.I_t / p.R_t]
    force = BRAKE / p.R_c + rows[:, 5] / p.R_t
    impulse = np.concatenate([[0.0], np.cumsum(0.5 * 0.01 * (force[1:] + force[:-1]))])
    return float(np.abs(momentum - momentum[0] + impulse).max() / impulse[-1])


@pytest.mark.parametrize(("name", "V_0"), spread(Parameters.model_fields, [40.0, 1.0]))
def test_at_the_ends_of_its_range(unit: Counted, name: str, V_0: float) -> None:
    """Rolling, and, from 1 m/s, braked to standstill."""
    for value in ends(name):
        values = {"V_0": V_0, name: value}
        rows = unit.run(values, 1e-6)
        taken = unit.evaluations
        finer = unit.run(values, 1e-9)
        error = np.abs(rows - finer)[:, [0, 1, 4]].max()
        missing = missing_impulse(rows, DATUM.changed(values))
        print(f"{name} = {value:g} at {V_0:g} m/s: {taken} evaluations, error {error:.1e}, impulse {missing:.1e}")
        assert np.isfinite(rows).all()
        assert 0 < taken < MOST_EVALUATIONS
        assert error < 3e-5 + 5e-6 * np.abs(finer[:, [0, 1, 4]]).max()
        assert missing < 1e-3 or name in OTHER_IMPULSES or V_0 < 10.0


@pytest.mark.parametrize("name", Parameters.model_fields)
def test_beyond_its_range(unit: Counted, name: str) -> None:
    low, high = Parameters.limits(name)
    assert math.isfinite(low) and math.isfinite(high)
    unit.slave.reset()
    for value in (math.nextafter(low, -math.inf), math.nextafter(high, math.inf), 1e300, -1e300):
        with pytest.raises(FMICallException) as caught:
            unit.set(**{name: value})
        assert caught.value.status == fmi2Discard
        assert re.fullmatch(rf"{name} = \S+( \S+)? is not allowed: its range is .+ to .+", unit.said)


def test_a_relaxation_length_of_nanometres_is_one_of_a_micrometre(unit: Counted) -> None:
    """At rest a tyre is a spring of the stiffness C_k / sigma: with 1e-30 m it would be beyond double precision."""
    runs = [unit.run({"V_0": 1.0, "sigma": sigma}, 1e-6) for sigma in (1e-300, 1e-9, 1e-6)]
    assert np.array_equal(runs[0], runs[1]) and np.array_equal(runs[0], runs[2])
    assert np.abs(unit.run({"V_0": 1.0, "sigma": 1e-5}, 1e-6) - runs[0])[:, :2].max() < 1e-3
