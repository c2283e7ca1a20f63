"""A step that cannot be made is discarded: the instance is as it was before, and goes on by another way."""

from __future__ import annotations

import ctypes as ct
import re
from collections.abc import Callable

import numpy as np
import pytest

from tests.fmu_build.runtime.coupled_models import TOWED
from tests.fmu_build.runtime.hand_written import Model, Variable
from tests.fmu_build.runtime.runtime_fmi3 import Unit3
from tests.fmu_build.runtime.runtime_models import DERIVATIVE_ENDS, OSCILLATOR, ROOT_OF_NEGATIVE, SINGULAR
from tests.fmu_build.runtime.runtime_unit import DISCARD, ERROR, OK, Unit

Create = Callable[..., Unit]

# Slides along x = 0 where abs(u) < 1, and passes it otherwise.
PUSHED = Model(
    "Pushed",
    (Variable("x", 1.0, "m"),),
    "v->der_x = holds[0] ? -1.0 + v->u : 1.0 + v->u;",
    {},
    inputs=(Variable("u"),),
    relations=(("x > 0", "v->x"),),
)

HARMONIC = Model("Harmonic", (Variable("x", 1.0), Variable("y")), "v->der_x = v->y; v->der_y = -v->x;",
                 {(0, 1): "1.0", (1, 0): "-1.0"})  # fmt: skip


def started(unit: Create, model: Model, **values: float) -> Unit:
    u = unit(model)
    assert u.set(**values) == OK
    assert u.initialize() == OK
    return u


def test_chattering_then_a_shorter_step_and_another_input(unit: Create) -> None:
    u, other = started(unit, PUSHED), started(unit, PUSHED)
    for each in (u, other):
        assert each.step(0.5) == OK
        assert each.set(u=0.25) == OK
        assert each.slopes(u=0.125) == OK
    before = u.state()
    assert u.step(1.0) == DISCARD
    assert u.state() == before
    (message,) = u.messages("logStatusWarning")
    assert "x > 0 is chattering at t = 1.2" in message
    for each in (u, other):
        assert each.step(0.125) == OK
        assert each.set(u=-3.0) == OK
        assert each.step(1.0) == OK
    assert u.state() == other.state()
    assert u.get("x")[0] < 0.0


def test_the_same_step_again_is_an_error(unit: Create) -> None:
    """FMPy repeats a discarded step as it was: that must end."""
    u = started(unit, PUSHED)
    assert u.step(0.5) == OK
    statuses = [u.step(1.0), u.step(1.0)]
    assert statuses == [DISCARD, ERROR]
    reason, remedy, _ = u.messages("logStatusWarning")[-1].rsplit("; ", 2)
    again = "the step from 0.5 s to 1.5 s has been discarded before, and nothing has changed since"
    assert u.messages()[-1] == f"{again}: {reason}; {remedy}"
    assert u.step(1.25) == DISCARD
    assert u.set(u=-2.0) == OK
    assert u.step(1.25) == OK


@pytest.mark.parametrize(
    ("model", "place"),
    [(SINGULAR, "derivative of x"), (ROOT_OF_NEGATIVE, "root = NaN"), (DERIVATIVE_ENDS, "derivative of y")],
    ids=lambda m: m.name if isinstance(m, Model) else None,
)
@pytest.mark.parametrize("size", [0.03125, 0.25, 0.75])
def test_what_is_not_finite(unit: Create, model: Model, place: str, size: float) -> None:
    """By short steps, which only follow the course of a long one, and by long ones."""
    u = started(unit, model)
    before = u.state()
    while (status := u.step(size)) == OK:
        before = u.state()
    assert status == DISCARD
    assert u.state() == before
    assert place in u.messages("logStatusWarning")[-1]
    assert u.time >= 1.0 - size
    while u.time < 0.99:
        assert u.step(0.5 * (1.0 - u.time)) == OK, u.log


def test_a_course_stays_open(unit: Create) -> None:
    """A try that fails where steps go across communication points leaves nothing behind."""
    u = started(unit, PUSHED)
    rows = []
    while u.time < 0.9:
        before = u.state()
        assert u.step(1.5) == DISCARD
        assert u.state() == before
        assert u.step(0.0625) == OK
        rows.append(u.get("x")[0])
    np.testing.assert_allclose(rows, 1.0 - 0.0625 * np.arange(1, len(rows) + 1), rtol=1e-12)


# A jump outside of an event, an overflow in the second state, a slope without bound in the second state.
JUMPING = Model("Jumping", (Variable("y"), Variable("x", -1.0, "m")),
                "v->der_y = 1.0; v->der_x = v->x < 0.0 ? 1.0 : -1e30;", {})  # fmt: skip
OVERFLOWING = Model("Overflowing", (Variable("y"), Variable("x", 1.0, "m")), "v->der_y = v->x; v->der_x = 1e307;",
                    {(0, 1): "1.0"})  # fmt: skip
LEAVING = Model("Leaving", (Variable("y"), Variable("x", 1.0, "m", 0.0)), "v->der_y = 1.0; v->der_x = -1.0;", {})


@pytest.mark.parametrize(
    ("model", "size", "reasons"),
    [
        (PUSHED, 2.0, ["the relation x > 0 is chattering at t = 1", "changes without end", "tanh"]),
        (HARMONIC, 1e9, ["1000000 integrator steps have led from t = 0 s to", "the error of (x|y) allows no longer"]),
        (JUMPING, 2.0, ["no step can be made from t = 1", "largest error is that of x, as where its derivative jumps"]),
        (OVERFLOWING, 1e300, ["no step can be made from t = 0 s", "beyond all numbers leads the derivative of x"]),
        (DERIVATIVE_ENDS, 2.0, ["from t = 1", "the derivative of y"]),
        (SINGULAR, 2.0, ["(that|derivative) of x"]),
        (LEAVING, 2.0, ["x = .* has fallen below its minimum of 0 m at t = "]),
        (ROOT_OF_NEGATIVE, 2.0, ["root = NaN is not finite at t = 2 s"]),
    ],
    ids=lambda value: value.name if isinstance(value, Model) else "",
)  # fmt: skip
def test_a_discard_names_what_prevents_the_step(unit: Create, model: Model, size: float, reasons: list[str]) -> None:
    """And leaves the instance where it was: from there it goes on."""
    u = started(unit, model)
    before = u.state()
    assert u.step(size) == DISCARD
    assert u.state() == before
    (message,) = u.messages("logStatusWarning")
    print(message)
    for reason in reasons:
        assert re.search(reason, message)
    assert message.endswith("; the instance is as before the step: a shorter one or other inputs may lead on")
    assert model is OVERFLOWING or u.step(0.1) == OK


def test_a_coupling_is_taken_back_too(unit: Create) -> None:
    u = unit(TOWED)
    assert u.set(u=-15.0, x=0.0, v=-15.0, k_push=0.0, k_pull=0.0, damping=100.0, applied=2.0) == OK
    assert u.initialize() == OK
    assert u.set(a=-160.0) == OK
    assert u.step(0.02) == OK
    assert u.set(u=-15.0 - 3.2) == OK
    before = u.state()
    assert u.step(0.02) == DISCARD
    assert u.state() == before
    assert u.set(u=-15.0, a=0.0) == OK
    assert u.step(0.02) == OK


def test_what_fmi2_allows_then(unit: Create) -> None:
    """The state stepFailed of FMI 2.0.5, section 4.2.4."""
    u = started(unit, PUSHED)
    assert u.step(0.5) == OK
    assert u.step(1.0) == DISCARD
    time, ended, status = ct.c_double(), ct.c_int(7), ct.c_int()
    assert u.call("fmi2GetRealStatus", 2, ct.byref(time)) == OK
    assert time.value == 0.5
    assert u.call("fmi2GetBooleanStatus", 3, ct.byref(ended)) == OK
    assert ended.value == 0
    assert u.call("fmi2GetStatus", 0, ct.byref(status)) == DISCARD  # no step is going on
    assert u.get("time", "x").tolist() == pytest.approx([0.5, 0.5], abs=1e-12)
    assert u.output_slopes("x")[0] == OK
    saved = u.save()
    assert u.restore(saved) == OK
    u.drop(saved)
    assert u.call("fmi2Terminate") == OK


def test_fmi3(unit3: Callable[..., Unit3]) -> None:
    u = unit3(PUSHED)
    assert u.initialize() == OK
    assert u.step(0.5).status == OK
    before = u.get("time", "x", "der_x")
    assert u.step(1.0).status == DISCARD
    assert np.array_equal(u.get("time", "x", "der_x"), before)
    assert u.set(u=-3.0) == OK
    assert u.step(1.0).status == OK
    assert u.get("time")[0] == 1.5


def test_a_good_step_after_a_discarded_one_is_that_of_an_instance_without(unit: Create) -> None:
    """Also behind events, and where steps have gone across communication points."""
    u, other = started(unit, OSCILLATOR), started(unit, OSCILLATOR)
    for n in range(60):
        if n % 7 == 3:
            assert u.step(1e9) == DISCARD
        assert u.step(0.05) == other.step(0.05) == OK
        assert u.state() == other.state()
