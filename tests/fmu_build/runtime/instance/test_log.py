"""The log category logSteps: what each communication step takes."""

from __future__ import annotations

import ctypes as ct
import re
from collections.abc import Callable

import pytest

from fmu_build.fmu.xml_common import LOG_CATEGORIES
from tests.fmu_build.runtime.runtime_fmi3 import Unit3
from tests.fmu_build.runtime.runtime_models import OSCILLATOR, SLIDING
from tests.fmu_build.runtime.runtime_unit import DISCARD, OK, Unit

COUNTS = re.compile(
    r"from t = (\S+) s to (\S+) s: (\d+) steps, (\d+) rejected, (\d+) repeated, (\d+) events, (\d+) evaluations, "
    r"(\d+) Jacobians"
)


def choose(u: Unit, *names: str) -> int:
    return u.call(
        "fmi2SetDebugLogging", 1, ct.c_size_t(len(names)), (ct.c_char_p * len(names))(*[n.encode() for n in names])
    )


def test_the_categories_are_those_that_are_declared(unit: Callable[..., Unit]) -> None:
    assert choose(unit(OSCILLATOR), *LOG_CATEGORIES) == OK


@pytest.mark.parametrize("size", [0.01, 0.3])
def test_what_steps_take_adds_up(unit: Callable[..., Unit], size: float) -> None:
    u = unit(OSCILLATOR, logging=True)
    assert u.initialize() == OK
    assert u.step(size) == OK
    assert u.messages("logSteps") == []  # not unless it is asked for
    first = u.counters()
    assert choose(u, "logSteps") == OK
    for _ in range(40):
        assert u.step(size) == OK
    found = [COUNTS.fullmatch(message) for message in u.messages("logSteps")]
    rows = [[float(number) for number in match.groups()] for match in found if match]
    assert len(rows) == len(found) == 40
    assert [row[0] for row in rows[1:]] == [row[1] for row in rows[:-1]]
    last = u.counters()
    assert [sum(column) for column in list(zip(*rows, strict=True))[2:]] == [
        getattr(last, name) - getattr(first, name)
        for name in ("steps", "rejected", "repeated", "events", "evaluations", "jacobians")
    ]


def test_a_discarded_step_tells_what_it_has_taken(unit: Callable[..., Unit]) -> None:
    u = unit(SLIDING)
    assert u.initialize() == OK
    assert choose(u, "logSteps") == OK
    assert u.step(2.0) == DISCARD
    (message,) = u.messages("logSteps")
    match = COUNTS.fullmatch(message)
    assert match is not None and 100 <= int(match[6]) <= 110
    assert float(match[2]) == pytest.approx(1.0, abs=2e-3)


def test_fmi3(unit3: Callable[..., Unit3]) -> None:
    u = unit3(OSCILLATOR)
    assert u.initialize() == OK
    assert u.step(0.1).status == OK
    assert not any(category == "logSteps" for _, category, _ in u.log)
    assert u.call("SetDebugLogging", ct.c_bool(True), ct.c_size_t(1), (ct.c_char_p * 1)(b"logSteps")) == OK
    assert u.step(0.1).status == OK
    assert sum(category == "logSteps" for _, category, _ in u.log) == 1
