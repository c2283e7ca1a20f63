"""Units for Model Exchange by CVODE: a closed form with events, and what goes wrong in a call from C."""

from __future__ import annotations

import math
from collections.abc import Callable
from types import SimpleNamespace

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from overrun_hitch.fmu.integrated import Integrated
from overrun_hitch.parameters import HitchError

DESCRIPTION = SimpleNamespace(
    numberOfContinuousStates=1,
    numberOfEventIndicators=1,
    modelExchange=SimpleNamespace(needsCompletedIntegratorStep=True),
)


class Saw:
    """x' = 1 from 0; where x reaches 1, and at t = 2.25, it starts again from 0."""

    def __init__(self, rate: Callable[[], float] = lambda: 1.0) -> None:
        self.x, self.time, self.starts, self.rate = 0.0, 0.0, [], rate

    def getContinuousStates(self, x, n):
        x[0] = self.x

    def setContinuousStates(self, x, n):
        self.x = x[0]

    def getDerivatives(self, rates, n):
        rates[0] = self.rate()

    def getEventIndicators(self, z, n):
        z[0] = self.x - 1.0

    def getNominalsOfContinuousStates(self, x, n):
        x[0] = 1.0

    def setTime(self, time):
        self.time = time

    def setupExperiment(self, **_):
        pass

    exitInitializationMode = enterEventMode = enterContinuousTimeMode = lambda self: None

    def completedIntegratorStep(self):
        return False, False

    def newDiscreteStates(self):
        if self.x > 0.5 or abs(self.time - 2.25) < 1e-9:
            self.starts.append(self.time)
            self.x = 0.0
        return False, False, False, True, self.time < 2.25, 2.25


def started(unit: Saw) -> Integrated:
    unit_of_co_simulation = Integrated(unit, DESCRIPTION)
    unit_of_co_simulation.setupExperiment(tolerance=1e-6, startTime=0.0)
    unit_of_co_simulation.exitInitializationMode()
    return unit_of_co_simulation


@pytest.mark.parametrize("step", [0.3, 1.0, 4.0])
def test_events_of_state_and_of_time(step: float) -> None:
    saw = Saw()
    unit = started(saw)
    for n in range(round(4.2 / step)):
        unit.doStep(n * step, step)
    end = round(4.2 / step) * step
    np.testing.assert_allclose(saw.starts, [t for t in (1.0, 2.0, 2.25, 3.25) if t < end], atol=1e-8)
    last = max([0.0, *saw.starts])
    assert saw.x == pytest.approx(end - last, abs=1e-8)


def test_what_goes_wrong_inside_is_told() -> None:
    with pytest.raises(HitchError, match="CVODE cannot go on from t = 0 s: "):
        started(Saw(lambda: math.nan)).doStep(0.0, 1.0)

    def refuse() -> float:
        raise FMICallException("fmi2GetDerivatives", 3)

    with pytest.raises(FMICallException, match="fmi2GetDerivatives"):
        started(Saw(refuse)).doStep(0.0, 1.0)
