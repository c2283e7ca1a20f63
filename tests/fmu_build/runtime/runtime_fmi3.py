"""Drive the runtime through its FMI 3.0 functions."""

from __future__ import annotations

import ctypes as ct
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from tests.fmu_build.runtime.hand_written import TOKEN
from tests.fmu_build.runtime.runtime_unit import OK, Library

LOG = ct.CFUNCTYPE(None, ct.c_void_p, ct.c_int, ct.c_char_p, ct.c_char_p)
UPDATE = ct.CFUNCTYPE(
    None,
    *(ct.c_void_p, ct.c_double, ct.c_bool, ct.c_bool, ct.c_bool, ct.c_bool),
    *(ct.POINTER(ct.c_bool), ct.POINTER(ct.c_double)),
)


@dataclass(frozen=True)
class Step:
    status: int
    event: bool
    early: bool
    time: float


class Unit3:
    """An instance; `exchange`: for Model Exchange. `update(time)` may return the time of an early return."""

    def __init__(
        self,
        library: Library,
        *,
        exchange: bool = False,
        events: bool = False,
        early: bool = False,
        logging: bool = True,
        token: str = TOKEN,
        update: Callable[[float], float | None] | None = None,
    ) -> None:
        self.dll = library.dll
        self.references = library.model.references()
        self.n_states, self.n_relations = len(library.model.states), len(library.model.relations)
        self.log: list[tuple[int, str, str]] = []
        self.time = 0.0

        def log(_environment: object, status: int, category: bytes, text: bytes) -> None:
            self.log.append((status, category.decode(), text.decode()))

        def on_update(_e: object, time: float, set_: bool, get: bool, done: bool, can: bool, ask, end) -> None:
            assert (set_, get, done, can) == (False, True, True, early)
            assert update is not None
            wanted = update(time)
            if wanted is not None:
                ask[0], end[0] = True, wanted

        self.callbacks = LOG(log), (UPDATE(on_update) if update else UPDATE())
        name = f"fmi3Instantiate{'ModelExchange' if exchange else 'CoSimulation'}"
        arguments = [b"unit", token.encode(), None, ct.c_bool(False), ct.c_bool(logging)]
        if exchange:
            arguments += [None, self.callbacks[0]]
        else:
            arguments += [ct.c_bool(events), ct.c_bool(early), None, ct.c_size_t(0), None, *self.callbacks]
        function = getattr(self.dll, name)
        function.restype = ct.c_void_p
        self.instance = function(*arguments)

    def call(self, function: str, *arguments: object) -> int:
        return int(getattr(self.dll, "fmi3" + function)(ct.c_void_p(self.instance), *arguments))

    def enter_initialization(self, tolerance: float | None = None, start: float = 0.0) -> int:
        self.time = start
        given = ct.c_bool(tolerance is not None), ct.c_double(tolerance or 0.0)
        return self.call("EnterInitializationMode", *given, ct.c_double(start), ct.c_bool(False), ct.c_double(0.0))

    def initialize(self, tolerance: float | None = None, start: float = 0.0) -> int:
        return max(self.enter_initialization(tolerance, start), self.call("ExitInitializationMode"))

    def set(self, **values: float) -> int:
        n = ct.c_size_t(len(values))
        references = (ct.c_uint * len(values))(*[self.references[name] for name in values])
        return self.call("SetFloat64", references, n, (ct.c_double * len(values))(*values.values()), n)

    def get(self, *names: str) -> np.ndarray:
        n = ct.c_size_t(len(names))
        values = (ct.c_double * len(names))()
        references = (ct.c_uint * len(names))(*[self.references[name] for name in names])
        assert self.call("GetFloat64", references, n, values, n) == OK, self.log
        return np.array(values)

    def update_discrete_states(self) -> int:
        flags = [ct.c_bool(True) for _ in range(5)]
        status = self.call("UpdateDiscreteStates", *map(ct.byref, flags), ct.byref(ct.c_double()))
        assert status != OK or not any(flag.value for flag in flags)
        return status

    def handle_event(self) -> None:
        """From event mode back, in Co-Simulation."""
        assert self.update_discrete_states() == OK
        assert self.call("EnterStepMode") == OK

    def step(self, size: float) -> Step:
        event, terminate, early = ct.c_bool(), ct.c_bool(), ct.c_bool()
        end = ct.c_double()
        arguments = map(ct.byref, (event, terminate, early, end))
        status = self.call("DoStep", ct.c_double(self.time), ct.c_double(size), ct.c_bool(True), *arguments)
        if status == OK:
            self.time = end.value
        return Step(status, event.value, early.value, end.value)

    def vector(self, function: str, n: int) -> np.ndarray:
        values = (ct.c_double * max(n, 1))()
        assert self.call("Get" + function, values, ct.c_size_t(n)) == OK, self.log
        return np.array(values[:n])

    def move(self, time: float, states: np.ndarray) -> None:
        assert self.call("SetTime", ct.c_double(time)) == OK
        assert self.call("SetContinuousStates", (ct.c_double * len(states))(*states), ct.c_size_t(len(states))) == OK

    def derivatives(self, time: float, states: np.ndarray) -> np.ndarray:
        self.move(time, states)
        return self.vector("ContinuousStateDerivatives", self.n_states)

    def indicators(self, time: float, states: np.ndarray) -> np.ndarray:
        self.move(time, states)
        return self.vector("EventIndicators", self.n_relations)

    def partial(self, way: str, unknown: list[str], known: list[str], seed: np.ndarray) -> tuple[int, np.ndarray]:
        """`way` is Directional or Adjoint."""
        lists: list[object] = []
        for names in (unknown, known):
            lists += [(ct.c_uint * len(names))(*[self.references[n] for n in names]), ct.c_size_t(len(names))]
        n = len(unknown if way == "Directional" else known)
        result = (ct.c_double * n)()
        seeds = (ct.c_double * len(seed))(*seed)
        status = self.call(f"Get{way}Derivative", *lists, seeds, ct.c_size_t(len(seed)), result, ct.c_size_t(n))
        return status, np.array(result)

    def dependencies(self, name: str) -> set[str]:
        n = ct.c_size_t()
        reference = ct.c_uint(self.references[name])
        assert self.call("GetNumberOfVariableDependencies", reference, ct.byref(n)) == OK
        of, on = (ct.c_size_t * n.value)(), (ct.c_size_t * n.value)()
        independents, kinds = (ct.c_uint * n.value)(), (ct.c_int * n.value)()
        assert self.call("GetVariableDependencies", reference, of, independents, on, kinds, n) == OK
        assert set(of) | set(on) <= {0} and set(kinds) <= {5}
        names = {reference: name for name, reference in self.references.items()}
        return {names[i] for i in independents}

    def messages(self) -> list[str]:
        return [text for _, category, text in self.log if category == "logStatusError"]

    def free(self) -> None:
        if self.instance:
            self.dll.fmi3FreeInstance(ct.c_void_p(self.instance))
            self.instance = None
