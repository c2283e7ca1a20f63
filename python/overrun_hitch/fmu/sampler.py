"""Many runs through the same communication points, with as little as possible between the calls."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from itertools import pairwise
from typing import Any, TypeAlias

import fmpy
import numpy as np
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import fmi2Warning
from numpy.typing import NDArray

from overrun_hitch.fmu.files import sampler_library
from overrun_hitch.fmu.messages import StepRefused

Floats = NDArray[np.float64]
Call: TypeAlias = tuple[Any, tuple[Any, ...]]  # a function of the unit's library, and its arguments as C has them
MOST_STEPS = 100  # in one call of the compiled loop: an interrupt waits for its end


class _Sampling(ctypes.Structure):
    """The struct of sampler.c."""

    _fields_ = (
        *[(name, ctypes.c_void_p) for name in ("do_step", "get_real", "unit", "references")],
        ("count", ctypes.c_size_t),
        *[(name, ctypes.c_void_p) for name in ("times", "values")],
    )


@cache
def compiled_loop() -> Any | None:
    """`sample` of sampler.c, or None where its library is not: then each call is made from here, to the same bits."""
    library = sampler_library(fmpy.platform_tuple, fmpy.sharedLibraryExtension)
    try:
        return ctypes.CDLL(str(library)).sample if library else None
    except (OSError, AttributeError):  # of another machine
        return None


class Sampler:
    """Steps a started unit through communication points and reads the same variables at each, run after run.

    The same calls as Unit.step and Unit.get, made by a compiled loop, or where an input is fed or the loop is not there
    with arguments made once: fmpy's wrappers, which convert every argument anew, cost more than the unit's own work.
    """

    def __init__(
        self,
        slave: Any,
        references: Sequence[int],
        points: Floats,
        refusal: Callable[[Exception], str],
        fed: tuple[int, Floats, Floats] | None = None,
    ) -> None:
        self._refusal = refusal
        self._points = np.ascontiguousarray(points, dtype=np.float64)
        self._table: Floats = np.empty((len(points), len(references)))
        self._references = (ctypes.c_uint * len(references))(*references)
        # By index a library gives a function of its own, without the prototype that fmpy has given to its attribute.
        step, read = slave.dll["fmi2DoStep"], slave.dll["fmi2GetReal"]
        unit, count = ctypes.c_void_p(slave.component), ctypes.c_size_t(len(references))
        here = ctypes.c_void_p(ctypes.addressof(self._references))
        first, *reads = [(read, (unit, here, count, ctypes.c_void_p(row.ctypes.data))) for row in self._table]
        self._first: Call = first
        self._loop = None if fed else compiled_loop()
        if self._loop:
            functions = [ctypes.cast(function, ctypes.c_void_p) for function in (step, read)]
            where = [array.ctypes.data for array in (self._points, self._table)]
            self._sampling = _Sampling(*functions, unit, here, count, *where)
            return
        times = zip(points[:-1].tolist(), np.diff(points).tolist(), strict=True)
        steps = [(step, (unit, ctypes.c_double(now), ctypes.c_double(size), ctypes.c_int(1))) for now, size in times]
        feeds = _feeds(slave, unit, *fed) if fed else []
        self._calls: list[Call] = [call for calls in zip(*feeds, steps, reads, strict=True) for call in calls]
        self._a_step = len(feeds) + 2

    def run(self, before_step: Mapping[int, Callable[[], None]] | None = None) -> Floats:
        """Values (points, names) in SI units, in a table that the next run overwrites.

        An input that is fed has its value and its slope set before each step. `before_step` is called before the
        steps with these numbers, to change inputs. StepRefused as for Unit.step.
        """
        self._perform([self._first])
        changes = before_step or {}
        for begin, end in pairwise(sorted({0, *changes, len(self._table) - 1})):
            if begin in changes:
                changes[begin]()
            if self._loop:
                self._sample(self._loop, begin, end)
            else:
                self._perform(self._calls[begin * self._a_step : end * self._a_step])
        return self._table

    def _sample(self, loop: Any, begin: int, end: int) -> None:
        refusing = ctypes.c_char_p()
        for first in range(begin, end, MOST_STEPS):
            last = ctypes.c_size_t(min(first + MOST_STEPS, end))
            status = loop(ctypes.byref(self._sampling), ctypes.c_size_t(first), last, ctypes.byref(refusing))
            if refusing.value:
                raise StepRefused(self._refusal(FMICallException(refusing.value.decode(), status)))

    def _perform(self, calls: Sequence[Call]) -> None:
        for function, arguments in calls:
            if (status := function(*arguments)) > fmi2Warning:
                raise StepRefused(self._refusal(FMICallException(function.__name__, status)))


def _feeds(slave: Any, unit: ctypes.c_void_p, reference: int, values: Floats, slopes: Floats) -> list[list[Call]]:
    """The calls that set an input, and its slope, before each step."""
    set_value, set_slope = slave.dll["fmi2SetReal"], slave.dll["fmi2SetRealInputDerivatives"]
    which, order, one = (ctypes.c_uint * 1)(reference), (ctypes.c_int * 1)(1), ctypes.c_size_t(1)
    number = ctypes.c_double * 1
    return [
        [(set_value, (unit, which, one, number(value))) for value in values.tolist()],
        [(set_slope, (unit, which, one, order, number(slope))) for slope in slopes.tolist()],
    ]
