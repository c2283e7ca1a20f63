"""Loops and arrays in when-clauses and algorithm sections; when-conditions that are vectors; texts of parameters."""

from __future__ import annotations

import numpy as np
import pytest

from tests.fmu_build.models.discrete.conftest import Way

ARRAYS = """
model Arrays "What is counted at ticks, in arrays"
  parameter Integer n = 3;
  Integer count[n](each start=0, each fixed=true);
  discrete Real moments[2, 2](each start=0, each fixed=true);
  Boolean late[2];
  Integer passed(start=0, fixed=true);
  Real level[n];
  Real x[2](each start=1, each fixed=true);
algorithm
  when sample(0.1, 0.1) then
    for i in 1:n loop
      count[i] := pre(count[i]) + i;
    end for;
  end when;
equation
  when sample(0.1, 0.1) then
    moments = pre(moments) + [1, 2; 3, 4]*time;
    reinit(x, {2, 3}.*x);
  end when;
  for i in 1:2 loop
    late[i] = time > 0.25*i;
  end for;
  when late then
    passed = pre(passed) + 1;
  end when;
  der(x) = -x;
algorithm
  for i in 1:n loop
    level[i] := i*time;
  end for;
end Arrays;
"""


OUTPUTS = """
function following
  input Integer n;
  input Real x;
  output Integer next;
  output Real pair[2];
  output Real unused;
algorithm
  next := n + 1;
  pair := {x, 2*x};
  unused := 0;
end following;
model Outputs
  Integer steps(start=0, fixed=true);
  discrete Real pair[2](each start=0, each fixed=true);
algorithm
  when sample(0.1, 0.1) then
    (steps, pair) := following(pre(steps), time);
  end when;
end Outputs;
"""


def test_several_outputs_at_events(way: Way) -> None:
    for step, row in enumerate(way.run(OUTPUTS, 0.5, 0.05, ["steps", "pair[1]", "pair[2]"])):
        ticks = step // 2
        assert (row["steps"], row["pair[1]"], row["pair[2]"]) == pytest.approx((ticks, 0.1 * ticks, 0.2 * ticks))


def test_arrays_at_events(way: Way) -> None:
    outputs = ["count[1]", "count[3]", "moments[1,2]", "moments[2,1]", "passed", "level[3]", "x[1]", "x[2]"]
    result = way.run(ARRAYS, 0.95, 0.05, outputs)
    total = 0.0
    for step, row in enumerate(result):
        ticks = step // 2
        if step % 2 == 0:
            total += row["time"]
        assert (row["count[1]"], row["count[3]"]) == (ticks, 3 * ticks)
        assert (row["moments[1,2]"], row["moments[2,1]"]) == pytest.approx((2 * total, 3 * total), abs=1e-12)
        assert row["passed"] == np.sum(row["time"] > np.array([0.25, 0.5]) - 1e-9)
        assert row["level[3]"] == pytest.approx(3 * row["time"])
        decay = np.exp(-row["time"])
        assert (row["x[1]"], row["x[2]"]) == pytest.approx((2**ticks * decay, 3**ticks * decay), rel=1e-8)


QUANTITIES = """
model Quantities "FMI knows the quantity of an Integer, and none of a Boolean"
  Boolean b(quantity="switch", start=true) = time > 0.5;
  Integer n(quantity="count", min=0, max=9) = if b then 2 else 1;
end Quantities;
"""


def test_attributes_of_discrete_variables(way: Way) -> None:
    assert way.run(QUANTITIES, 1.0, 1.0, ["n"])["n"].tolist() == [1, 2]


TEXTS = """
model Texts "A message with a text of a parameter in it"
  parameter String what = "the level";
  Real x(start=1, fixed=true);
equation
  der(x) = 1;
  assert(x < 1.5, what + " is " + String(x), AssertionLevel.warning);
end Texts;
"""


def test_texts_of_parameters(way: Way) -> None:
    way.run(TEXTS, 1.0, 0.1, ["x"])
    assert [message for message in way.messages if message.startswith("the level is 1.5")]
