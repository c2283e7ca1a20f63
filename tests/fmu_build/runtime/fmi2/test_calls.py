"""The FMI 2.0 functions: legal and illegal calls, refused values, failures, reset, logging, exports."""

from __future__ import annotations

import ctypes as ct
import math
import re
import shutil
import subprocess
from collections.abc import Callable

import numpy as np
import pytest

from fmu_build.fmu.compile import HEADERS
from tests.fmu_build.runtime.hand_written import TOKEN, Model
from tests.fmu_build.runtime.runtime_models import (
    CAR_TRAILER,
    DERIVATIVE_ENDS,
    NO_STATES,
    OSCILLATOR,
    ROOT_OF_NEGATIVE,
    SINGULAR,
    SLIDING,
)
from tests.fmu_build.runtime.runtime_unit import (
    ALLOCATE,
    DISCARD,
    ERROR,
    FREE,
    LOGGER,
    OK,
    WARNING,
    Callbacks,
    Library,
    Unit,
)

NAN, INF = math.nan, math.inf


@pytest.fixture
def car(unit: Callable[..., Unit]) -> Unit:
    return unit(CAR_TRAILER)


def running(u: Unit) -> Unit:
    assert u.set(brake_torque=1000.0) == OK
    assert u.initialize() == OK
    return u


def test_exports_are_the_functions_of_the_standard(library: Callable[[Model], Library]) -> None:
    nm = shutil.which("nm")
    if nm is None:
        pytest.skip("no nm")
    text = subprocess.run([nm, "-D", "--defined-only", library(CAR_TRAILER).path], capture_output=True, text=True)
    exported = {line.split()[-1] for line in text.stdout.splitlines()}
    header = (HEADERS / "fmi2" / "fmi2Functions.h").read_text(encoding="utf-8")
    standard = set(re.findall(r"FMI2_Export\s+\w+\s+(\w+);", header))
    assert len(standard) == 44
    assert {name for name in exported if not name.startswith("probe_")} == standard


def test_no_data_that_changes(library: Callable[[Model], Library]) -> None:
    nm = shutil.which("nm")
    if nm is None:
        pytest.skip("no nm")
    text = subprocess.run([nm, library(CAR_TRAILER).path], capture_output=True, text=True, check=True).stdout
    mutable = {line.split()[-1] for line in text.splitlines() if line.split()[-2] in "bBdD"}
    constant = {"relation_text", "variable_info", "log_category_name", "fmi2_calls", "fmi2_standard"}  # but relocated
    assert {m for m in mutable if not m.startswith(("_", "completed.", "__"))} <= constant


@pytest.mark.parametrize(
    ("name", "kind", "token"), [(None, 1, TOKEN), (b"", 1, TOKEN), (b"a", 2, TOKEN), (b"a", 1, "{x}"), (b"a", 1, None)]
)
def test_instantiate_refuses(
    library: Callable[[Model], Library], name: bytes | None, kind: int, token: str | None
) -> None:
    log: list[bytes] = []
    logger = LOGGER(lambda _e, _n, _s, _c, _f, text: log.append(text))
    callbacks = Callbacks(logger)
    guid = None if token is None else token.encode()
    dll = library(CAR_TRAILER).dll
    assert not dll.fmi2Instantiate(name, kind, guid, None, ct.byref(callbacks), 0, 1)
    assert len(log) == 1
    assert not dll.fmi2Instantiate(name, kind, guid, None, None, 0, 1)  # no callbacks at all


def test_callers_memory_and_odd_resources(library: Callable[[Model], Library]) -> None:
    libc = ct.CDLL(None)
    libc.calloc.restype = ct.c_void_p
    libc.calloc.argtypes = [ct.c_size_t, ct.c_size_t]
    libc.free.argtypes = [ct.c_void_p]
    freed: list[int] = []
    given: list[int] = []

    def allocate(n: int, size: int) -> int:
        given.append(libc.calloc(n, size))
        return given[-1]

    def free(pointer: int) -> None:
        freed.append(pointer)
        libc.free(pointer)

    callbacks = Callbacks(LOGGER(), ALLOCATE(allocate), FREE(free))
    dll = library(CAR_TRAILER).dll
    for resource in (None, b"", b"not a uri", "file:///ä ö%20".encode()):
        c = dll.fmi2Instantiate(b"n", 1, TOKEN.encode(), resource, ct.byref(callbacks), 0, 1)
        assert dll.fmi2DoStep(ct.c_void_p(c), ct.c_double(0), ct.c_double(1), 1) == ERROR  # with a NULL logger
        dll.fmi2FreeInstance(c)
    assert freed == given
    assert len(given) == 4
    dll.fmi2FreeInstance(None)
    assert dll.fmi2Reset(None) == ERROR


def test_no_memory_for_an_instance_is_told(library: Callable[[Model], Library]) -> None:
    said: list[tuple[int, bytes, bytes]] = []

    def log(_env: object, _name: bytes, status: int, category: bytes, _form: bytes, text: bytes) -> None:
        said.append((status, category, text))

    callbacks = Callbacks(LOGGER(log), ALLOCATE(lambda n, size: None), FREE(lambda pointer: None))
    dll = library(CAR_TRAILER).dll
    assert dll.fmi2Instantiate(b"n", 1, TOKEN.encode(), None, ct.byref(callbacks), 0, 0) is None
    assert said == [(ERROR, b"logStatusError", b"fmi2Instantiate: there is no memory for an instance")]


def test_illegal_order(car: Unit) -> None:
    assert car.step(0.01) == ERROR
    assert car.get_status("v_c")[0] == ERROR
    assert car.call("fmi2ExitInitializationMode") == ERROR
    assert car.call("fmi2Terminate") == ERROR
    assert car.call("fmi2EnterInitializationMode") == OK
    assert car.setup() == ERROR
    assert car.step(0.01) == ERROR
    assert car.call("fmi2EnterInitializationMode") == ERROR
    assert car.call("fmi2ExitInitializationMode") == OK
    assert car.call("fmi2ExitInitializationMode") == ERROR
    assert car.step(0.01) == OK
    assert car.call("fmi2Terminate") == OK
    assert car.get("time")[0] == 0.01
    assert car.set(brake_torque=1.0) == ERROR
    assert car.step(0.01) == ERROR
    assert car.call("fmi2Reset") == OK
    assert car.initialize() == OK
    assert len(car.messages()) == 10
    assert all(m.startswith("fmi2") for m in car.messages())


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"C": NAN}, "C = NaN is not allowed: its range is 0 N.s/m to infinity"),
        ({"V_0": INF}, "V_0 = infinity is not allowed: its range is 0.1 m/s to infinity"),
        ({"brake_torque": -INF}, "brake_torque = -infinity is not allowed: its range is 0 N.m to infinity"),
        ({"compression": 1.0}, "compression cannot be set: it is calculated"),
        ({"der_v_c": 1.0}, "der_v_c cannot be set: it is calculated"),
        ({"v_c": 1.0}, "v_c cannot be set: it is a state whose start value follows from parameters"),
        ({"time": 1.0}, "time cannot be set: it is the time"),
    ],
)
def test_refused_values_change_nothing(car: Unit, values: dict[str, float], message: str) -> None:
    for prepare in (lambda: OK, lambda: car.call("fmi2EnterInitializationMode"), car.initialize):
        car.call("fmi2Reset")
        assert prepare() == OK
        before = car.state()
        assert car.set(M_t=600.0, **values) == ERROR
        assert car.messages()[-1] == message
        assert car.state() == before


def test_unknown_references_and_null(car: Unit) -> None:
    running(car)
    one, bad = ct.c_size_t(1), (ct.c_uint * 1)(9999)
    value = (ct.c_double * 1)(1.0)
    assert car.call("fmi2SetReal", bad, one, value) == ERROR
    assert "9999" in car.messages()[-1]
    assert car.call("fmi2GetReal", bad, one, value) == ERROR
    assert car.call("fmi2GetReal", None, one, value) == ERROR
    assert car.call("fmi2SetReal", bad, one, None) == ERROR
    zero = ct.c_size_t(0)
    kinds = ("Real", "Integer", "Boolean", "String")
    assert all(car.call(f"fmi2{verb}{k}", None, zero, None) == OK for verb in ("Get", "Set") for k in kinds)
    assert car.call("fmi2GetInteger", bad, one, value) == ERROR


def test_states_are_set_before_the_start_only(unit: Callable[..., Unit]) -> None:
    u = unit(OSCILLATOR)
    assert u.set(x=0.5) == OK
    assert u.call("fmi2EnterInitializationMode") == OK
    assert u.set(v=0.25) == OK
    assert u.get("x", "v", "der_x", "der_v").tolist() == [0.5, 0.25, 0.25, -2.0]
    assert u.call("fmi2ExitInitializationMode") == OK
    assert u.set(x=0.0) == ERROR
    assert "initialization" in u.messages()[-1]


@pytest.mark.parametrize(
    ("tolerance", "start", "stop"),
    [(0.0, 0, None), (1e-13, 0, None), (0.5, 0, None), (NAN, 0, None), (None, NAN, None), (None, INF, None),
     (None, 1.0, 0.5), (None, 0.0, NAN)],
)  # fmt: skip
def test_setup_refuses(car: Unit, tolerance: float | None, start: float, stop: float | None) -> None:
    before = car.state()
    assert car.setup(tolerance, start, stop) == ERROR
    assert "is not allowed" in car.messages()[-1]
    assert car.state() == before


@pytest.mark.parametrize(
    ("time", "size"), [(0.1, 0.0), (0.1, -0.1), (0.1, NAN), (0.1, INF), (0.0, 0.1), (0.2, 0.1), (NAN, 0.1)]
)
def test_step_refuses(car: Unit, time: float, size: float) -> None:
    running(car)
    assert car.step(0.1) == OK
    before = car.state()
    assert car.step(size, time) == ERROR
    assert "is not allowed" in car.messages()[-1]
    assert car.state() == before
    assert car.step(0.1, 0.1 + 1e-11) == OK


def test_outputs_before_the_first_step(car: Unit) -> None:
    assert car.setup(None, 7.0) == OK
    assert car.set(brake_torque=1000.0, compression_start=0.02) == OK
    assert car.call("fmi2EnterInitializationMode") == OK
    push = 5480 * 0.02
    names = ("time", "compression", "der_v_c", "der_w_c", "w_c")
    expected = [7.0, 0.02, push / 1000, -200.0, 40 / 0.35]
    np.testing.assert_allclose(car.get(*names), expected, rtol=1e-12)
    assert car.set(compression_start=0.01, V_0=20.0) == OK
    expected = [7.0, 0.01, push / 2000, -200.0, 20 / 0.35]
    np.testing.assert_allclose(car.get(*names), expected, rtol=1e-12)
    assert car.call("fmi2ExitInitializationMode") == OK
    np.testing.assert_allclose(car.get(*names), expected, rtol=1e-12)
    assert car.step(0.01) == OK
    assert car.set(brake_torque=0.0) == OK
    assert car.get("der_w_c")[0] > -20.0


def test_reset_repeats_bit_by_bit(car: Unit) -> None:
    names = ["compression", "v_c", "v_t"]
    rows = []
    for _ in range(2):
        assert car.setup(1e-7) == OK
        assert car.set(C=20.0) == OK
        rows.append(running(car).run(2.0, 0.05, names))
        state = car.state()
        assert car.call("fmi2Reset") == OK
        assert car.state() != state
    assert np.array_equal(rows[0], rows[1])


@pytest.mark.parametrize(
    ("model", "end", "message"),
    [
        (SINGULAR, 1.0, r"(that|derivative) of x|x = "),
        pytest.param(ROOT_OF_NEGATIVE, 1.0, r"root = NaN is not finite at t = 1", marks=pytest.mark.full),
        (DERIVATIVE_ENDS, 1.0, r"the derivative of y"),
        (SLIDING, 1.0, r"x > 0"),
    ],
    ids=lambda m: m.name if isinstance(m, Model) else None,
)
def test_never_ok_with_nan(unit: Callable[..., Unit], model: Model, end: float, message: str) -> None:
    u = unit(model)
    assert u.initialize() == OK
    status, steps = OK, 0
    while status == OK and steps < 30:
        status = u.step(0.1, steps * 0.1)
        steps += 1
        if status == OK:
            assert np.isfinite(u.get(*[v.name for v in model.variables()])).all()
    assert status == DISCARD
    assert end - 0.11 < steps * 0.1 < end + 0.21
    print(u.messages())
    assert re.search(message, u.messages("logStatusWarning")[-1])
    assert np.isfinite(u.get(*[v.name for v in model.states])).all()
    value = ct.c_double()
    assert u.call("fmi2GetRealStatus", 2, ct.byref(value)) == OK
    assert value.value == u.get("time")[0]
    assert u.call("fmi2Reset") == OK
    assert u.initialize() == OK
    assert u.step(0.1, 0.0) == OK


def test_huge_step_ends(car: Unit) -> None:
    running(car)
    assert car.step(1e300) == DISCARD
    assert "minimum" in car.messages("logStatusWarning")[-1]


def test_null_arguments_and_statuses(car: Unit) -> None:
    running(car)
    pointer = ct.c_void_p()
    calls = {
        "fmi2GetFMUstate": (None,),
        "fmi2SetFMUstate": (None,),
        "fmi2SerializedFMUstateSize": (None, None),
        "fmi2SerializeFMUstate": (None, None, ct.c_size_t(0)),
        "fmi2DeSerializeFMUstate": (None, ct.c_size_t(0), None),
        "fmi2GetDirectionalDerivative": (None, ct.c_size_t(1), None, ct.c_size_t(0), None, None),
        "fmi2SetTime": (ct.c_double(0.0),),  # for Model Exchange
        "fmi2SetRealInputDerivatives": (None, ct.c_size_t(1), None, None),
        "fmi2GetRealOutputDerivatives": (None, ct.c_size_t(1), None, None),
        "fmi2CancelStep": (),
    }
    for function, arguments in calls.items():
        assert car.call(function, *arguments) == ERROR
        assert function in car.messages()[-1]
    for function in ("fmi2GetStatus", "fmi2GetIntegerStatus", "fmi2GetStringStatus"):
        assert car.call(function, 0, ct.byref(pointer)) == DISCARD
    terminated = ct.c_int(5)
    assert car.call("fmi2GetBooleanStatus", 3, ct.byref(terminated)) == OK
    assert terminated.value == 0
    assert car.step(0.01) == OK


def test_log_categories(unit: Callable[..., Unit]) -> None:
    u = unit(OSCILLATOR, name=b"100 %s %n")

    def choose(on: int, *names: bytes) -> int:
        return u.call("fmi2SetDebugLogging", on, ct.c_size_t(len(names)), (ct.c_char_p * max(1, len(names)))(*names))

    assert u.initialize() == OK
    u.run(2.0, 0.1, ["x"])
    assert u.log == []
    assert choose(1, b"logEvents") == OK
    u.run(4.0, 0.1, ["x"])
    assert {category for category, _ in u.log} == {"logEvents"}
    n = len(u.log)
    assert n > 0
    assert choose(0) == OK
    u.run(6.0, 0.1, ["x"])
    assert len(u.log) == n
    assert choose(1, b"%s%n") == WARNING
    assert u.log[-1] == ("logStatusWarning", "fmi2SetDebugLogging: there is no log category %s%n")


def test_input_range_and_model_without_states(unit: Callable[..., Unit]) -> None:
    u = unit(NO_STATES)
    assert u.set(u=11.0) == OK
    assert u.initialize() == OK
    assert u.get("u")[0] == 10.0
    assert u.set(u=1.0) == OK
    assert u.step(1e-3) == OK
    assert u.get("y")[0] == 1.0


def test_many_instances(library: Callable[[Model], Library]) -> None:
    for _ in range(300):
        u = Unit(library(OSCILLATOR))
        assert u.initialize() == OK
        assert u.step(0.01) == OK
        u.free()


def test_time_may_be_set_in_event_mode(unit: Callable[..., Unit]) -> None:
    """As importers do that set the time of an event before they settle it."""
    u = unit(CAR_TRAILER, exchange=True)
    assert u.setup() == OK and u.initialize() == OK
    assert u.call("fmi2SetTime", ct.c_double(0.25)) == OK
    assert u.call("fmi2EnterContinuousTimeMode") == OK
    assert u.get("time")[0] == 0.25
