"""FMUs opened in this process, through fmpy. The one module that touches fmpy, which has no types.

fmpy's FMU2Slave is driven directly, not through simulate_fmu: so outputs are read at the start before the first step,
the unit's own messages are caught instead of printed, and whatever ends a run, the unpacked folder goes and the working
directory is what it was.
"""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any, Concatenate, ParamSpec, Protocol, TypeVar

import numpy as np
from fmpy.fmi1 import FMICallException

from overrun_hitch.fmu.identity import Identity
from overrun_hitch.fmu.messages import StartRefused, StepRefused, refusal
from overrun_hitch.fmu.sampler import Floats, Sampler
from overrun_hitch.fmu.settings import USES, Use
from overrun_hitch.fmu.translation import Translation
from overrun_hitch.parameters import Parameters
from overrun_hitch.results import VARIABLES

P = ParamSpec("P")
R = TypeVar("R")


class Unit:
    """An instance of an FMU for co-simulation, with names instead of value references; good for any number of runs.

    From `opened`. What the FMU refuses becomes a HitchError in its own words where `opened` ends.
    """

    def __init__(self, name: str, description: Any, slave: Any, messages: list[str]) -> None:
        self.name = name
        self._messages = messages
        self.identity = identity(description, "cs")
        self.interpolates = bool(description.coSimulation and description.coSimulation.canInterpolateInputs)
        self._slave = slave
        self._references = {variable.name: variable.valueReference for variable in description.modelVariables}
        self.names = frozenset(self._references)
        self._derivatives = [unknown.variable for unknown in description.derivatives]
        self._arrays: dict[tuple[str, ...], Any] = {}  # of references, by the names
        self._fresh = True

    def start_with(self, values: Mapping[str, float], relative_tolerance: float) -> None:
        """From any state to t = 0 of a new run with these parameters and inputs (SI units). StartRefused if not."""
        self._messages.clear()  # those of the run before
        try:
            if not self._fresh:
                self._slave.reset()
            self._fresh = False
            self.set(values)
            self._slave.setupExperiment(tolerance=relative_tolerance, startTime=0.0)
            self._slave.enterInitializationMode()
            self._slave.exitInitializationMode()
        except FMICallException as error:
            raise StartRefused(refusal(self.name, self._messages, error)) from None

    def set(self, values: Mapping[str, float]) -> None:
        """Set inputs, and during a run tunable parameters, by name (SI units)."""
        names, count = tuple(values), len(values)
        if names not in self._arrays:
            self._arrays[names] = (ctypes.c_uint * count)(*self._settings(values)[0])
        # What fmpy's setReal does, which makes both arrays out of lists: of 40 values it takes a tenth of a run's time.
        numbers = (ctypes.c_double * count)(*values.values())
        self._slave.fmi2SetReal(self._slave.component, self._arrays[names], count, numbers)

    def _settings(self, values: Mapping[str, float]) -> tuple[list[int], list[float]]:
        return [self._references[name] for name in values], list(values.values())

    def set_slopes(self, slopes: Mapping[str, float]) -> None:
        """How inputs change during the next step, by name, in their units per second."""
        references, values = self._settings(slopes)
        self._slave.setRealInputDerivatives(references, [1] * len(references), values)

    def change(self, values: Mapping[str, float], slopes: Mapping[str, float]) -> None:
        """Set inputs, and how they change during the next step. StepRefused if the unit doesn't take them."""
        try:
            self.set(values)
            if slopes:
                self.set_slopes(slopes)
        except FMICallException as error:
            raise StepRefused(refusal(self.name, self._messages, error)) from None

    def feed(self, name: str, start: float, end: float, size: float) -> None:
        """An input that goes straight from `start` to `end` during the next step, of `size` s.

        A unit that takes no slopes holds the mean. StepRefused as for `change`.
        """
        if self.interpolates:
            self.change({name: start}, {name: (end - start) / size})
        else:
            self.change({name: 0.5 * (start + end)}, {})

    def get(self, names: Sequence[str]) -> list[float]:
        """Values by name (SI units)."""
        return list(self._slave.getReal([self._references[name] for name in names]))

    def step(self, time: float, size: float) -> None:
        """Go on from `time` by `size`, both in s. StepRefused if the unit can't; it may be started again."""
        try:
            self._slave.doStep(time, size)
        except FMICallException as error:
            raise StepRefused(refusal(self.name, self._messages, error)) from None

    def sampler(self, names: Sequence[str], points: Floats, fed: tuple[str, Floats, Floats] | None = None) -> Sampler:
        """For many runs through the same `points` (n,) in s: see Sampler.

        `fed` is an input by name, and for each of the n - 1 steps its value at the start and its slope.
        """
        references = [self._references[name] for name in names]
        course = (self._references[fed[0]], *fed[1:]) if fed else None
        return Sampler(self._slave, references, points, lambda error: refusal(self.name, self._messages, error), course)

    @contextmanager
    def saved(self) -> Iterator[Callable[[], None]]:
        """Keep the present state; what is given takes the unit back to it, as often as it is called."""
        state = self._slave.getFMUstate()
        try:
            yield lambda: self._slave.setFMUstate(state)
        finally:
            self._slave.freeFMUstate(state)

    def jacobian(self) -> tuple[list[str], Floats]:
        """Names (n,) of the states and the derivatives (n, n) of their rates by them: the unit's directional ones."""
        states = [rate.derivative.name for rate in self._derivatives]
        rates = [rate.valueReference for rate in self._derivatives]
        columns = [self._slave.getDirectionalDerivative(rates, [self._references[state]], [1.0]) for state in states]
        return states, np.array(columns, dtype=np.float64).T


class HitchUnit(Unit):
    """CarTrailer.fmu, or another tool's export of it."""

    def perform(self, run: Callable[Concatenate[HitchUnit, P], R], *args: P.args, **kwargs: P.kwargs) -> R:
        """`run(self, ...)`: see AnyUnit."""
        return run(self, *args, **kwargs)

    def start(self, parameters: Parameters, inputs: Mapping[str, float], relative_tolerance: float) -> None:
        """From any state to t = 0 of a new run with these parameters and inputs (SI units)."""
        self.start_with({**parameters.model_dump(), **inputs}, relative_tolerance)

    def outputs(self) -> list[float]:
        """The outputs in the order of results.VARIABLES."""
        return self.get(list(VARIABLES))


class TranslatedUnit(HitchUnit):
    """An FMU of car and trailer by other people: their names, units and signs, and not all that ours has."""

    def __init__(
        self, name: str, description: Any, slave: Any, messages: list[str], translated: Translation, use: Use
    ) -> None:
        super().__init__(name, description, slave, messages)
        self.identity = identity(description, use, translated)
        self.interpolates = self.interpolates and use == "cs" and description.fmiVersion == "2.0"
        self._translated = translated
        given = [name for name in VARIABLES if name in translated.channels]
        self._read = [translated.channels[name].reference for name in given]
        self._factors = [translated.channels[name].factor for name in given]
        self._places = [list(VARIABLES).index(name) for name in given]

    def set(self, values: Mapping[str, float]) -> None:
        """As of ours, in its own units."""
        self._slave.setReal(*self._settings(values))

    def _settings(self, values: Mapping[str, float]) -> tuple[list[int], list[float]]:
        return self._translated.settings(self.name, values)

    def outputs(self) -> list[float]:
        """The outputs in the order of results.VARIABLES, in their units; NaN for those that the unit has not."""
        row = [math.nan] * len(VARIABLES)
        for place, size, value in zip(self._places, self._factors, self._slave.getReal(self._read), strict=True):
            row[place] = size * value
        return row


def identity(description: Any, use: Use, translated: Translation | None = None) -> Identity:
    """By the FMU's description, and what was made of it."""
    missing, notes = (translated.missing, translated.notes) if translated else ((), ())
    interface = f"FMI {description.fmiVersion}, {USES[use]}"
    return Identity(str(description.guid), interface, description.generationTool or "", missing, notes)


class AnyUnit(Protocol):
    """CarTrailer.fmu, opened in this process (HitchUnit) or in another (guest_unit.py)."""

    name: str

    @property
    def identity(self) -> Identity:
        """What it is; of a unit opened for each run, what it was in the last."""

    def perform(self, run: Callable[Concatenate[HitchUnit, P], R], *args: P.args, **kwargs: P.kwargs) -> R:
        """`run(unit, ...)` where the unit is: `run` is a function of a module, and what goes in and out is pickled."""
