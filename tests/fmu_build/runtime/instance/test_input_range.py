"""Values out of range: the limit of a Real input acts, other variables keep their value; a list is set whole or not."""

from __future__ import annotations

import ctypes as ct
from collections.abc import Callable
from math import inf, nan
from pathlib import Path

import numpy as np
import pytest

from tests.fmu_build.runtime.generated_models import generate
from tests.fmu_build.runtime.hand_written import Model, Variable
from tests.fmu_build.runtime.runtime_fmi3 import Unit3
from tests.fmu_build.runtime.runtime_models import CAR_TRAILER, LAG
from tests.fmu_build.runtime.runtime_unit import DISCARD, ERROR, OK, Unit

Create = Callable[..., Unit]
WARNING = (
    "{} is beyond its range, which is -100 N to 100 N: its limit acts, now and where it is so again"  # of LAG's input
)


def test_within_rounding_of_a_limit_an_input_is_the_limit(unit: Create) -> None:
    """A solver's undershoot: nothing is said, and nothing moves."""
    u, other = unit(CAR_TRAILER), unit(CAR_TRAILER)
    assert u.set(brake_torque=-1e-8) == OK
    for each in (u, other):
        assert each.initialize() == OK
        assert each.step(0.1) == OK
    assert u.set(brake_torque=-1e-7) == OK
    assert u.get("brake_torque")[0] == 0.0
    assert u.state() == other.state()
    assert u.log == []


def test_beyond_it_the_limit_acts_and_the_caller_is_told_once(unit: Create) -> None:
    u, other = unit(LAG), unit(LAG)
    for each in (u, other):
        assert each.initialize() == OK
    for value, acting in ((150.0, 100.0), (-1e300, -100.0), (100.5, 100.0), (7.0, 7.0)):
        assert u.set(u=value) == other.set(u=acting) == OK
        assert u.get("u")[0] == acting
        assert u.step(0.25) == other.step(0.25) == OK
        assert u.state() == other.state()
    assert u.log == [("logStatusWarning", WARNING.format("u = 150 N"))]


@pytest.mark.parametrize("value", [nan, inf, -inf])
def test_what_is_not_finite_is_refused(unit: Create, value: float) -> None:
    u = unit(LAG)
    assert u.initialize() == OK
    before = u.state()
    assert u.set(u=value) == ERROR
    assert u.state() == before
    assert "is not allowed" in u.messages()[-1]


def test_fmi3_and_model_exchange(unit3: Callable[..., Unit3]) -> None:
    u = unit3(LAG, exchange=True)
    assert u.initialize() == OK
    assert u.call("EnterContinuousTimeMode") == OK
    assert u.set(u=101.0) == OK
    assert u.derivatives(0.5, np.array([20.0])).tolist() == [80.0]
    assert [text for _, _, text in u.log] == [WARNING.format("u = 101 N")]
    assert u.set(u=nan) == ERROR


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"k": -1.0}, "k = -1 N/m is not allowed: its range is 0 N/m to infinity"),
        ({"M_c": -5.0}, "M_c = -5 kg is not allowed: its range is 0.001 kg to infinity"),
        ({"M_c": 0.0}, "M_c = 0 kg is not allowed: its range is 0.001 kg to infinity"),
    ],
)
def test_a_parameter_out_of_range_is_discarded_and_the_last_value_stays(
    unit: Create, unit3: Callable[..., Unit3], values: dict[str, float], message: str
) -> None:
    u = unit(CAR_TRAILER)
    for prepare in (lambda: OK, lambda: u.call("fmi2EnterInitializationMode"), u.initialize):
        assert u.call("fmi2Reset") == OK
        assert u.set(C=20.0) == OK
        assert prepare() == OK
        before = u.state()
        assert u.set(C=30.0, **values) == DISCARD
        assert u.state() == before
        assert u.messages("logStatusWarning")[-1] == message
    other = unit3(CAR_TRAILER)
    assert other.set(**values) == DISCARD
    assert other.log[-1][0] == DISCARD


# The state follows an input that may move from 0 to 1.
FOLLOWER = Model("Follower", (Variable("x"),), "v->der_x = v->u;", {}, inputs=(Variable("u", 0.0, "m", 0.0, 1.0),))


@pytest.mark.parametrize("tolerance", [1e-6, 1e-10])
def test_a_slope_that_leads_out_of_the_range(unit: Create, tolerance: float) -> None:
    """The input moves to its limit and stays there, and the step is as accurate as others."""
    u = unit(FOLLOWER)
    assert u.setup(tolerance) == OK
    assert u.initialize() == OK
    assert u.set(u=0.5) == OK
    assert u.slopes(u=1.0) == OK
    assert u.step(1.0) == OK
    x, acting = u.get("x", "u")
    assert acting == 1.0
    assert x == pytest.approx(0.5 * 0.75 + 0.5, abs=20 * tolerance)
    assert u.slopes(u=1.0) == OK  # at the limit, outwards
    assert u.step(1.0) == OK
    assert u.get("x")[0] == pytest.approx(x + 1.0, rel=1e-12)
    (warning,) = u.messages("logStatusWarning")
    assert warning.startswith("u = 1.5 m is beyond its range, which is 0 m to 1 m")


TYPES = """model Types
  parameter Integer count(min=1, max=9) = 3;
  parameter Boolean flag = false;
  input Integer level(min=0, max=5, start=1);
  Real x(start=0, fixed=true);
equation
  der(x) = count + level + (if flag then 1 else 0);
end Types;
"""


def test_a_list_is_set_whole_or_not_at_all(unit: Create, unit3: Callable[..., Unit3], tmp_path: Path) -> None:
    (tmp_path / "Types.mo").write_text(TYPES, encoding="utf-8")
    model = generate(tmp_path / "Types.mo", "Types")
    u, u3 = unit(model), unit3(model)
    reference = model.references()
    cases = (
        ((("level", 2), ("count", 10)), DISCARD),  # there is nothing between 5 and 6 to limit it to
        ((("count", 2), ("level", 6)), DISCARD),
        ((("level", 2), ("x", 1)), ERROR),
        ((("level", 2), ("flag", 1)), ERROR),
        ((("level", 2), (None, 1)), ERROR),
    )
    for pairs, expected in cases:
        references = (ct.c_uint * 2)(*[reference[name] if name else 4711 for name, _ in pairs])
        values, n = (ct.c_int * 2)(*[value for _, value in pairs]), ct.c_size_t(2)
        before = u.state()
        assert u.call("fmi2SetInteger", references, n, values) == expected
        assert u.state() == before
        assert u3.call("SetInt32", references, n, values, n) == expected
        for name, start in (("level", 1), ("count", 3)):
            now = (ct.c_int * 1)()
            one = ct.c_size_t(1)
            assert u3.call("GetInt32", (ct.c_uint * 1)(reference[name]), one, now, one) == OK
            assert now[0] == start
    bad = (ct.c_uint * 2)(reference["flag"], reference["level"])
    before = u.state()
    assert u.call("fmi2SetBoolean", bad, ct.c_size_t(2), (ct.c_int * 2)(1, 1)) == ERROR
    assert u.state() == before
