"""FMI 3.0: event mode, early return, intermediate update, Model Exchange, states, logging, exports."""

from __future__ import annotations

import ctypes as ct
import re
import shutil
import subprocess
from collections.abc import Callable
from math import nan, pi

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from fmu_build.fmu.compile import HEADERS
from tests.fmu_build.runtime.hand_written import TOKEN
from tests.fmu_build.runtime.runtime_fmi3 import LOG, Unit3
from tests.fmu_build.runtime.runtime_models import CAR_TRAILER, NO_STATES, OSCILLATOR, SINGULAR, SLIDING
from tests.fmu_build.runtime.runtime_unit import DISCARD, ERROR, OK, WARNING, Library, Unit

PERIOD = pi / 2 + pi / 30  # of the oscillator without a gap


def test_exports_are_the_functions_of_the_standard(library: Callable[..., Library]) -> None:
    nm = shutil.which("nm")
    if nm is None:
        pytest.skip("no nm")
    command = [nm, "-D", "--defined-only", library(CAR_TRAILER, 3).path]
    text = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    exported = {line.split()[-1] for line in text.splitlines()}
    header = (HEADERS / "fmi3" / "fmi3Functions.h").read_text(encoding="utf-8")
    standard = set(re.findall(r"FMI3_Export\s+\w+\s+(\w+);", header))
    assert len(standard) == 75
    assert {name for name in exported if not name.startswith("probe_")} == standard


def test_the_same_digits_as_fmi2(unit: Callable[..., Unit], unit3: Callable[..., Unit3]) -> None:
    u2, u3 = unit(CAR_TRAILER), unit3(CAR_TRAILER)
    for u in (u2, u3):
        assert u.set(brake_torque=1000.0, C=20.0) == OK
        assert u.initialize() == OK
    for _ in range(100):
        assert u2.step(0.03) == OK
        assert u3.step(0.03).status == OK
    names = list(u2.references)
    assert u2.get(*names).tolist() == u3.get(*names).tolist()


def test_event_mode(unit3: Callable[..., Unit3]) -> None:
    """Every switching ends a step, with the old truths until event mode."""
    u = unit3(OSCILLATOR, events=True, early=True)
    assert u.initialize(1e-12) == OK
    assert u.step(0.1).status == ERROR
    u.handle_event()
    events: list[float] = []
    while u.time < 5.0 - 1e-12:
        end = min(5.0, (np.floor(u.time / 0.1 + 1e-9) + 1) * 0.1)
        step = u.step(end - u.time)
        assert step.status == OK
        assert step.early == (step.time < end)
        assert step.early <= step.event
        if not step.event:
            assert u.time == pytest.approx(end, abs=1e-14)
            continue
        events.append(u.time)
        assert u.step(0.1).status == ERROR
        assert "event mode has to handle" in u.messages()[-1]
        assert u.call("EnterEventMode") == OK
        u.handle_event()
    expected = [0.0, *np.cumsum([pi / 2, pi / 30] * 3)]
    np.testing.assert_allclose(events, [t for t in expected if t < 5], rtol=0, atol=1e-12)
    plain = unit3(OSCILLATOR)
    assert plain.initialize(1e-12) == OK
    for _ in range(50):
        step = plain.step(0.1)
        assert (step.status, step.event, step.early) == (OK, False, False)
    np.testing.assert_allclose(plain.get("x", "v"), u.get("x", "v"), atol=1e-10)
    assert plain.call("EnterEventMode") == ERROR


def test_truths_change_in_event_mode_only(unit3: Callable[..., Unit3]) -> None:
    u = unit3(OSCILLATOR, events=True, early=True)
    assert u.set(gap=0.25, x=0.2) == OK
    assert u.initialize() == OK
    u.handle_event()
    step = u.step(1.0)
    assert (step.event, step.early, step.time) == (True, True, pytest.approx(0.05))
    assert u.get("x")[0] == pytest.approx(0.25)
    assert u.call("EnterEventMode") == OK
    assert u.set(gap=0.5) == OK  # and the surface is elsewhere
    u.handle_event()
    step = u.step(1.0)
    assert (step.event, step.time) == (True, pytest.approx(0.3))


def test_events_are_handled_inside_where_no_early_return_is_allowed(unit3: Callable[..., Unit3]) -> None:
    u = unit3(OSCILLATOR, events=True, early=False)
    assert u.initialize(1e-10) == OK
    u.handle_event()
    step = u.step(4.0)
    assert (step.status, step.event, step.early, step.time) == (OK, False, False, 4.0)


def test_sliding_ends_although_every_event_ends_a_step(unit3: Callable[..., Unit3]) -> None:
    u = unit3(SLIDING, events=True, early=True)
    assert u.initialize() == OK
    u.handle_event()
    for _ in range(200):
        step = u.step(1.5 - u.time)
        if step.status != OK:
            break
        assert step.event
        assert u.call("EnterEventMode") == OK
        u.handle_event()
    assert step.status == DISCARD
    assert "x > 0" in u.log[-1][2]


def test_intermediate_update(unit3: Callable[..., Unit3]) -> None:
    seen: list[tuple[float, float, float]] = []

    def update(time: float) -> None:
        seen.append((time, *u.get("time", "x")))
        assert u.step(0.1).status == ERROR
        assert u.set(p=1.0) == ERROR
        assert u.call("Reset") == ERROR
        u.dll.fmi3FreeInstance(ct.c_void_p(u.instance))  # ignored

    u = unit3(OSCILLATOR, update=update)
    assert u.set(v=0.5) == OK
    assert u.initialize(1e-8) == OK
    assert u.step(1.0).status == OK
    times, inside, x = np.array(seen).T
    assert len(times) > 3
    assert np.all(np.diff(times) > 0) and times[-1] == 1.0 and np.array_equal(times, inside)
    np.testing.assert_allclose(x, 0.25 * np.sin(2 * times), atol=1e-7)


@pytest.mark.parametrize(("wanted", "reached"), [(0.123, 0.123), (-1.0, None), (nan, None), (9.0, 1.0)])
def test_early_return_on_request(unit3: Callable[..., Unit3], wanted: float, reached: float | None) -> None:
    first: list[float] = []

    def update(time: float) -> float | None:
        first.append(time)
        return wanted if time < 0.123 else None

    u = unit3(OSCILLATOR, early=True, update=update)
    assert u.initialize(1e-9) == OK
    step = u.step(1.0)
    assert step.status == OK
    assert step.time == (first[0] if reached is None else reached)
    assert step.early == (step.time < 1.0)
    assert not step.event
    u.step(0.5)
    assert u.get("time")[0] == u.time


def test_no_early_return_where_it_is_not_allowed(unit3: Callable[..., Unit3]) -> None:
    u = unit3(OSCILLATOR, update=lambda time: time)
    assert u.initialize() == OK
    step = u.step(1.0)
    assert (step.early, step.time) == (False, 1.0)


def exchange(u: Unit3, end: float, tolerance: float) -> tuple[np.ndarray, list[float]]:
    """A simple importer: integrate to the next change of an indicator's sign, handle it, go on."""
    assert u.update_discrete_states() == OK
    assert u.call("EnterContinuousTimeMode") == OK
    time, x = u.time, u.vector("ContinuousStates", u.n_states)
    events: list[float] = []
    while time < end:
        surfaces = []
        for i in range(u.n_relations):
            surfaces.append(lambda t, x, i=i: u.indicators(t, x)[i])
            surfaces[-1].terminal = True
        s = solve_ivp(u.derivatives, (time, end), x, "DOP853", rtol=tolerance, atol=tolerance, events=surfaces)
        time, x = s.t[-1], s.y[:, -1]
        if s.status == 1:  # the root may lie a rounding before the change of sign
            z = u.indicators(time, x)
            time = np.nextafter(time + 1e-14, end)
            x = x + (time - s.t[-1]) * u.derivatives(s.t[-1], x)
            events.append(time)
            assert np.all(z != 0)
            u.move(time, x)
            assert u.call("EnterEventMode") == OK
            assert u.update_discrete_states() == OK
            assert u.call("EnterContinuousTimeMode") == OK
    u.move(time, x)
    return x, events


def test_model_exchange_against_co_simulation(unit3: Callable[..., Unit3]) -> None:
    me, cs = unit3(OSCILLATOR, exchange=True), unit3(OSCILLATOR)
    for u in (me, cs):
        assert u.set(gap=0.1, x=0.02) == OK
        assert u.initialize(1e-11) == OK
    states, events = exchange(me, 3.0, 1e-11)
    assert cs.step(3.0).status == OK
    print(events, states - cs.get("x", "v"))
    assert len(events) == 5
    np.testing.assert_allclose(states, cs.get("x", "v"), atol=1e-8)


def test_model_exchange_leaves_a_surface(unit3: Callable[..., Unit3]) -> None:
    """It starts at z = 0 exactly, with no truth that holds: the indicator is not zero, and changes its sign."""
    for v, surface in ((1.0, 0), (-1.0, 1)):
        u = unit3(OSCILLATOR, exchange=True)
        assert u.set(v=v) == OK
        assert u.initialize() == OK
        assert u.update_discrete_states() == OK
        assert u.call("EnterContinuousTimeMode") == OK
        start = u.vector("EventIndicators", 2)
        assert start.tolist() == [-1e-12, -1e-12]
        behind = u.indicators(1e-9, np.array([v * 1e-9, v]))
        assert (behind > 0).tolist() == [surface == 0, surface == 1]
        assert u.get("residual_0")[0] == v * 1e-9  # the variable itself is exact
        assert u.vector("ContinuousStateDerivatives", 2)[1] == 0.0  # no truth has changed yet
        assert u.call("EnterEventMode") == OK
        assert u.update_discrete_states() == OK
        assert u.vector("ContinuousStateDerivatives", 2)[1] != 0.0
        assert np.all(u.vector("EventIndicators", 2) * (behind > 0) >= 0)


def test_model_exchange_refuses(unit3: Callable[..., Unit3]) -> None:
    u = unit3(CAR_TRAILER, exchange=True)
    assert u.initialize() == OK
    assert u.set(C=100.0) == OK
    assert u.call("EnterContinuousTimeMode") == OK
    assert u.set(C=200.0) == ERROR
    assert "between events" in u.messages()[-1]
    assert u.set(brake_torque=5.0) == OK
    states = u.vector("ContinuousStates", 6)
    n = ct.c_size_t(6)
    for index, value in ((2, -1.0), (3, nan)):
        bad = states.copy()
        bad[index] = value
        assert u.call("SetContinuousStates", (ct.c_double * 6)(*bad), n) == DISCARD
    assert u.vector("ContinuousStates", 6).tolist() == states.tolist()
    assert u.log[-1][:2] == (DISCARD, "logStatusWarning")
    assert u.call("SetContinuousStates", (ct.c_double * 6)(*states), ct.c_size_t(5)) == ERROR
    assert u.call("SetTime", ct.c_double(nan)) == ERROR
    assert u.step(0.1).status == ERROR
    assert u.vector("NominalsOfContinuousStates", 6).tolist() == [1, 1, 1, 1, 3, 3]


def test_saved_state_in_the_middle_of_an_event(unit3: Callable[..., Unit3]) -> None:
    u = unit3(OSCILLATOR, events=True, early=True)
    assert u.initialize() == OK
    u.handle_event()
    assert u.step(0.5).event
    saved = ct.c_void_p()
    assert u.call("GetFMUState", ct.byref(saved)) == OK
    ends = []
    for _ in range(2):
        assert u.call("SetFMUState", saved) == OK
        u.time = 0.0
        assert u.step(0.5).status == ERROR
        assert u.call("EnterEventMode") == OK
        u.handle_event()
        assert u.step(0.5).status == OK
        ends.append(u.get("x", "v", "der_v").tolist())
    assert ends[0] == ends[1]
    assert u.call("FreeFMUState", ct.byref(saved)) == OK
    assert not saved


def test_reset_and_restart_at_another_time(unit3: Callable[..., Unit3]) -> None:
    u = unit3(SINGULAR)
    rows = []
    for start in (0.0, 5.0):
        assert u.initialize(1e-8, start) == OK
        assert u.step(0.5).status == OK
        rows.append(u.get("x")[0])
        assert u.step(1.0).status == DISCARD
        assert u.step(0.1).status == OK
        assert u.get("x")[0] > 2.0
        assert u.call("Reset") == OK
    assert rows[0] == pytest.approx(rows[1], rel=1e-7)


def test_instantiation(library: Callable[..., Library], unit3: Callable[..., Unit3]) -> None:
    dll = library(NO_STATES, 3).dll
    log: list[bytes] = []
    logger = LOG(lambda _e, _s, _c, text: log.append(text))
    create = dll.fmi3InstantiateModelExchange
    create.restype = ct.c_void_p
    for name, token in ((None, TOKEN), (b" ", TOKEN), (b"a", "{x}"), (b"a", None)):
        for callback in (logger, LOG()):
            assert not create(name, token and token.encode(), None, False, False, None, callback)
    assert len(log) == 4
    scheduled = dll.fmi3InstantiateScheduledExecution
    scheduled.restype = ct.c_void_p
    assert not scheduled(b"a", TOKEN.encode(), None, False, False, None, logger, None, None, None)
    assert log[-1] == b"Scheduled Execution is not offered"
    u = unit3(NO_STATES)
    assert u.initialize() == OK
    assert u.step(1e-3).status == OK
    assert u.get("y")[0] == 1.0


def test_logging_is_off_where_it_is_not_wanted(unit3: Callable[..., Unit3]) -> None:
    u = unit3(OSCILLATOR, logging=False)
    assert u.step(0.1).status == ERROR
    assert u.initialize() == OK
    assert u.step(2.0).status == OK
    assert u.log == []
    names = (ct.c_char_p * 2)(b"logStatusError", b"nonsense")
    assert u.call("SetDebugLogging", ct.c_bool(True), ct.c_size_t(2), names) == WARNING
    assert u.set(x=1.0) == ERROR
    assert len(u.log) == 1
    assert u.call("SetDebugLogging", ct.c_bool(True), ct.c_size_t(0), None) == OK
    assert u.call("SetDebugLogging", ct.c_bool(True), ct.c_size_t(2), names) == WARNING
