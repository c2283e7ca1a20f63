"""A step that cannot be made is discarded: the instance is as it was before, and goes on by another way."""

from __future__ import annotations

import ctypes as ct
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
    assert "has been discarded before" in u.messages()[-1]
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


def test_too_many_steps(unit: Create) -> None:
    u = started(unit, HARMONIC)
    assert u.step(0.1) == OK
    before = u.state()
    assert u.step(1e9) == DISCARD
    assert u.state() == before
    assert "integrator steps" in u.messages("logStatusWarning")[-1]
    assert u.step(0.1) == OK


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
