"""Units for Model Exchange, which bring no solver, with the calls of a slave.

They are integrated by CVODE (BDF; fmpy's binding of SUNDIALS), whose root finder looks at their event indicators.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import fmi2Error

from overrun_hitch.fmu.messages import one_line
from overrun_hitch.parameters import HitchError

MOST_STEPS = 100_000  # between two communication points
LONGEST_STEP = 0.1  # s: what an event indicator does within a step is not seen
STRICTER = 1e-3  # of the tolerance asked for: CVODE's is that of a step, and what steps leave adds up
FINEST = 1e-12  # of its tolerances that double precision lets it hold


class Integrated:
    """A unit for Model Exchange, in the calls of FMI 2; those that are the same are its own."""

    def __init__(self, unit: Any, description: Any) -> None:
        self._unit = unit
        self._sizes = {"nx": description.numberOfContinuousStates, "nz": description.numberOfEventIndicators}
        self._tells_steps = description.modelExchange.needsCompletedIntegratorStep
        self._tolerance = math.nan
        self._solver: Any = None
        self._next_event = math.inf
        self._is_disturbed = False  # so that the solver has to start again
        self._fault: Exception | None = None

    def __getattr__(self, name: str) -> Any:
        return getattr(self._unit, name)

    def setReal(self, references: Sequence[int], values: Sequence[float]) -> None:
        """As a slave's; inputs jump."""
        self._unit.setReal(references, values)
        self._is_disturbed = True

    def setupExperiment(self, tolerance: float, startTime: float) -> None:
        """As a slave's."""
        self._tolerance = max(STRICTER * tolerance, FINEST)
        self._unit.setupExperiment(tolerance=tolerance, startTime=startTime)

    def exitInitializationMode(self) -> None:
        """As a slave's; the start's events are over afterwards."""
        self._unit.exitInitializationMode()
        self._solver = self._fault = None
        self._settle()
        self._solver = self._made_solver()
        self._is_disturbed = False

    def doStep(self, time: float, size: float) -> None:
        """Integrate from `time` by `size`, both in s, event by event."""
        end = time + size
        if self._is_disturbed:
            self._solver.reset(time)
            self._is_disturbed = False
        while time < end:
            is_event, time = self._stepped(time, min(end, self._next_event))
            self._unit.setTime(time)
            if self._tells_steps:
                asks, ends = self._unit.completedIntegratorStep()
                self._check(ends)
                is_event = is_event or asks
            if is_event or time >= self._next_event:
                self._unit.enterEventMode()
                self._settle()
                self._solver.reset(time)

    def _stepped(self, time: float, end: float) -> tuple[bool, float]:
        """Whether something switched on the way, and the time then."""
        try:
            is_event, _, then = self._solver.step(time, end)
        except Exception as error:  # fmpy's RuntimeError with CVODE's words, or a bare Exception
            raise self._fault or HitchError(f"CVODE cannot go on from t = {time:g} s: {one_line(error)}") from None
        if self._fault:
            raise self._fault
        return bool(is_event), float(then)

    def freeInstance(self) -> None:
        """As a slave's."""
        self._solver = None  # which asks the unit no more
        self._unit.freeInstance()

    def _settle(self) -> None:
        """Out of Event Mode."""
        again = True
        while again:
            again, ends, _, _, is_defined, time = self._unit.newDiscreteStates()
            self._check(ends)
        self._next_event = time if is_defined else math.inf
        self._unit.enterContinuousTimeMode()

    def _check(self, ends: bool) -> None:
        if ends:
            raise FMICallException("the unit", fmi2Error)

    def _made_solver(self) -> Any:
        try:
            from fmpy.sundials import CVodeSolver
        except Exception as error:  # OSError, or a bare Exception of fmpy's
            raise HitchError(f"units for Model Exchange cannot be integrated here, without SUNDIALS: {error}") from None
        unit = self._unit
        return CVodeSolver(
            get_x=unit.getContinuousStates, set_x=self._guarded(unit.setContinuousStates),
            get_dx=self._guarded(unit.getDerivatives), get_z=self._guarded(unit.getEventIndicators),
            get_nominals=unit.getNominalsOfContinuousStates, set_time=self._guarded(unit.setTime),
            input=_Held(), startTime=0.0, maxStep=LONGEST_STEP, relativeTolerance=self._tolerance,
            maxNumSteps=MOST_STEPS, **self._sizes,
        )  # fmt: skip

    def _guarded(self, call: Callable[..., object]) -> Callable[..., None]:
        """What is raised in a call from C would be lost: it is kept for `doStep`."""

        def guarded(*arguments: Any) -> None:
            try:
                call(*arguments)
            except Exception as error:
                self._fault = self._fault or error

        return guarded


class _Held:
    """Inputs as CVodeSolver wants them: they stay as they are within a step."""

    def apply(self, time: float) -> None:
        """Nothing to do."""
