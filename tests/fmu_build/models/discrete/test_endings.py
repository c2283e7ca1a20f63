"""Assertions, terminate, and events without end."""

from __future__ import annotations

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from tests.fmu_build.models.discrete.conftest import Way

ERROR = 3
GROWTH = """
model Growth
  parameter Real limit = 0.9;
  parameter Real warning = 0.5;
  Real x(start=0.1, fixed=true);
  output Integer n(start=0, fixed=true);
  discrete output Real last(start=0, fixed=true);
equation
  der(x) = x;
  assert(x < limit, "x = " + String(x) + " is above its limit, after " + String(n) + " 100% steps");
  assert(x < warning, "x is getting large", AssertionLevel.warning);
  when sample(0.5, 0.5) then
    n = pre(n) + 1;
    assert(n < 6, "n is " + String(n));
  end when;
  when terminal() then
    last = x;
  end when;
  when x > 0.8 then
    terminate("x has grown enough");
  end when;
end Growth;
"""
END = np.log(8)
CHATTERING = """
model Chattering "Cooling without hysteresis"
  Real T(start=2, fixed=true);
  output Boolean cold;
equation
  der(T) = if cold then 1 else -1;
  cold = T < 1;
end Chattering;
"""


def test_terminate_ends_the_simulation(way: Way) -> None:
    result = way.run_until_its_end(GROWTH, 3.0, 0.01, ["x", "n"])
    if (way.fmi, way.interface) != (3, "CoSimulation"):  # there FMPy gives the row the time that it had asked for
        assert result["time"][-1] == pytest.approx(END, abs=1e-6)
    assert result["x"][-1] == pytest.approx(0.8, abs=1e-6)
    assert result["n"][-1] == 4
    assert sum("x has grown enough" in message for message in way.messages) == 1


def test_a_warning_is_given_once(way: Way) -> None:
    way.run_until_its_end(GROWTH, 3.0, 0.01, ["x"])
    assert sum("x is getting large" in message for message in way.messages) == 1


def test_an_assertion_is_an_error_with_its_message(way: Way) -> None:
    with pytest.raises(FMICallException) as caught:
        way.run(GROWTH, 3.0, 0.01, ["x"], start_values={"limit": 0.6})
    assert caught.value.status == ERROR
    assert any("is above its limit, after 3 100% steps" in message for message in way.messages)


def test_an_assertion_at_an_event(way: Way) -> None:
    with pytest.raises(FMICallException) as caught:
        way.run(GROWTH.replace("n < 6", "n < 2"), 3.0, 0.01, ["x"])
    assert caught.value.status == ERROR
    assert any("n is 2 (t = 1 s)" in message for message in way.messages)


def test_events_without_end_are_given_up(co_simulation: Way) -> None:
    """FMPy asks for the same step again after a discarded one; that is refused."""
    with pytest.raises(FMICallException):
        co_simulation.run(CHATTERING, 3.0, 0.1, ["T"])
    assert any("T < 1" in m and "is chattering at t = 1 s" in m for m in co_simulation.messages)


TICKING = """
model Ticking
  discrete Real x(start=0, fixed=true);
  discrete Real y(start=0, fixed=true);
equation
  when sample(0, 1) then
    x = pre(x) + 1;
  end when;
  when sample(0.1, 1e-6) then
    y = pre(y) + 1;
  end when;
end Ticking;
"""


def test_ticks_that_are_too_many_are_told(co_simulation: Way) -> None:
    with pytest.raises(FMICallException):
        co_simulation.run(TICKING, 2.0, 2.0, ["x"])
    assert any("they end at ticks, the densest those of sample(0.1 s, 1e-06 s)" in m for m in co_simulation.messages)


IMPATIENT = """
model Impatient "Events that set off each other"
  Real x(start=0, fixed=true);
  Integer n(start=0, fixed=true);
  Boolean b(start=false, fixed=true);
equation
  der(x) = 1;
  b = if x > 0.5 then not pre(b) else false;
  when change(b) then
    n = pre(n) + 1;
  end when;
end Impatient;
"""


def test_an_event_that_does_not_end(way: Way) -> None:
    with pytest.raises(FMICallException):
        way.run(IMPATIENT, 1.0, 0.1, ["x"])
    assert any("the event at t = 0.5" in m and "changes without end" in m for m in way.messages)
