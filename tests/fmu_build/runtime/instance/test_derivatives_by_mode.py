"""Directional derivatives against central differences, in every mode in which FMI 2 and FMI 3 permit the call.

What a mode allows to be set (SETTABLE) is varied in that mode. For anything else another instance is initialized at the
varied point and led to the same mode: for states and time in event mode and in Co-Simulation, for parameters between
events, and for the start time during initialization.
"""

from __future__ import annotations

import ctypes as ct
from collections.abc import Callable

import numpy as np
import pytest

from tests.fmu_build.runtime.generated_models import NONLINEAR, GeneratedModel, generate
from tests.fmu_build.runtime.instance.test_derivatives import differences
from tests.fmu_build.runtime.runtime_fmi3 import Unit3
from tests.fmu_build.runtime.runtime_unit import OK, Unit

AnyUnit = Unit | Unit3
Point = dict[str, float]

START = {"u": 0.3, "x_0": 0.4, "y": 0.2, "a": 0.7, "b": 1.3, "time": 0.6}
KNOWN = ["x", "y", "u", "a", "b", "time"]  # after initialization
UNKNOWN = ["der(x)", "der(y)", "p", "q", "of_state", "g"]
SETTABLE = {
    "initialization": {"a", "b", "x_0", "y", "u"},
    "event": {"u", "a", "b"},
    "continuous": {"x", "y", "u", "time"},  # states by SetContinuousStates
    "step": {"u", "a", "b"},
}
EVENT = [("event", 2, True), ("event", 3, True), ("event", 3, False)]
CONTINUOUS = [("continuous", 2, True), ("continuous", 3, True)]
STEP = [("step", 2, False), ("step", 3, False)]
CASES = [  # mode, version of FMI, Model Exchange, at a later point than the start
    *[("initialization", fmi, exchange, False) for fmi in (2, 3) for exchange in (False, True)],
    *[(*case, later) for case in (*EVENT, *CONTINUOUS, *STEP) for later in (False, True)],
]


@pytest.fixture(scope="module")
def nonlinear(tmp_path_factory: pytest.TempPathFactory) -> GeneratedModel:
    path = tmp_path_factory.mktemp("modelica") / "Nonlinear.mo"
    path.write_text(NONLINEAR, encoding="utf-8")
    return generate(path, "Nonlinear")


@pytest.fixture
def create(
    unit: Callable[..., Unit], unit3: Callable[..., Unit3], nonlinear: GeneratedModel
) -> Callable[[str, int, bool], AnyUnit]:
    def new(mode: str, fmi: int, exchange: bool) -> AnyUnit:
        if fmi == 2:
            return unit(nonlinear, exchange=exchange)
        return unit3(nonlinear, exchange=exchange, events=mode == "event" and not exchange)

    return new


def call(u: AnyUnit, *functions: str) -> None:
    for function in functions:
        assert u.call(function if isinstance(u, Unit3) else f"fmi2{function}") == OK, u.log


def lead(u: AnyUnit, mode: str, point: Point) -> AnyUnit:
    """Initialized at the point, to the mode."""
    assert u.set(**{name: value for name, value in point.items() if name != "time"}) == OK
    if isinstance(u, Unit3):
        assert u.enter_initialization(start=point["time"]) == OK
    else:
        assert u.setup(start=point["time"]) == OK
        call(u, "EnterInitializationMode")
    if mode != "initialization":
        call(u, "ExitInitializationMode")
    if mode == "continuous":
        call(u, "EnterContinuousTimeMode")
    return u


def move(u: AnyUnit, time: float, states: list[float]) -> None:
    """In continuous-time mode."""
    if isinstance(u, Unit3):
        u.move(time, np.array(states))
        return
    assert u.call("fmi2SetTime", ct.c_double(time)) == OK
    assert u.call("fmi2SetContinuousStates", (ct.c_double * 2)(*states), ct.c_size_t(2)) == OK


def go_on(u: AnyUnit, mode: str, exchange: bool) -> None:
    """To a later point, in the same mode; in Model Exchange to the other side of the relation."""
    if exchange:
        if mode == "event":
            call(u, "EnterContinuousTimeMode")
        move(u, 1.1, [0.2, 0.15])
        call(u, "EnterEventMode", *(["EnterContinuousTimeMode"] if mode == "continuous" else []))
        return
    if mode == "event":
        call(u, "EnterStepMode")
    assert (u.step(0.5).status if isinstance(u, Unit3) else u.step(0.5)) == OK
    if mode == "event":
        call(u, "EnterEventMode")


def vary(u: AnyUnit, mode: str, name: str, value: float) -> None:
    if mode == "continuous" and name != "u":
        time, *states = (value if n == name else u.get(n)[0] for n in ("time", "x", "y"))
        move(u, time, states)
    else:
        assert u.set(**{name: value}) == OK, u.log


def directional(u: AnyUnit, unknown: list[str], known: list[str]) -> np.ndarray:
    """One column for each known."""
    partial = u.directional if isinstance(u, Unit) else lambda *lists: u.partial("Directional", *lists)
    columns = [partial(unknown, known, seed) for seed in np.eye(len(known))]
    assert {status for status, _ in columns} == {OK}, u.log
    return np.array([column for _, column in columns]).T


@pytest.mark.parametrize(("mode", "fmi", "exchange", "later"), CASES)
def test_directional_derivatives(
    create: Callable[[str, int, bool], AnyUnit], mode: str, fmi: int, exchange: bool, later: bool
) -> None:
    u = lead(create(mode, fmi, exchange), mode, START)
    if later:
        go_on(u, mode, exchange)
    known, unknown, at = KNOWN, UNKNOWN, START
    if mode == "initialization":
        known, unknown = list(START), ["x", *UNKNOWN]
    else:
        at = dict(zip(known, u.get(*known), strict=True))

    def value(name: str, moved: float) -> np.ndarray:
        if name in SETTABLE[mode]:
            vary(u, mode, name, moved)
            result = u.get(*unknown)
            vary(u, mode, name, at[name])
            return result
        point = {**at, name: moved}
        if "x" in point:
            point["x_0"] = point.pop("x") / point["b"]
        return lead(create(mode, fmi, exchange), mode, point).get(*unknown)

    expected = differences(value, known, at)
    error = np.abs(directional(u, unknown, known) - expected) / np.maximum(np.abs(expected), 1e-3)
    use = "Model Exchange" if exchange else "Co-Simulation"
    print(f"{mode} mode, FMI {fmi} {use}{', later' if later else ''}: worst relative error {error.max():.1e}")
    assert error.max() < 1e-7


@pytest.mark.parametrize(("fmi", "exchange"), [(2, False), (2, True), (3, False), (3, True)])
def test_terminated(create: Callable[[str, int, bool], AnyUnit], fmi: int, exchange: bool) -> None:
    """Nothing can be set any more; the derivatives are those of the last point."""
    u = lead(create("step", fmi, exchange), "step", START)
    before = directional(u, UNKNOWN, KNOWN)
    call(u, "Terminate")
    assert np.array_equal(directional(u, UNKNOWN, KNOWN), before)
