"""Discrete variables whose values can be told exactly."""

from __future__ import annotations

import numpy as np
import pytest

from tests.fmu_build.models.discrete.conftest import Way

COUNTER = """
model Counter "Edges, changes and branches of a when-clause"
  Real x(start=0.003, fixed=true);
  output Boolean low(start=false);
  output Boolean high(start=false);
  output Integer first(start=0, fixed=true) "Of two edges at once the first branch counts";
  output Integer changes(start=0, fixed=true);
  output Integer either(start=0, fixed=true);
  output Integer chained(start=0, fixed=true) "Set off by what another when-clause has done";
equation
  der(x) = 1;
  low = mod(x, 1) >= 0.2;
  high = mod(x, 1) >= 0.45;
  when edge(low) then
    first = pre(first) + 1;
  elsewhen edge(high) then
    first = pre(first) + 100;
  end when;
  when change(low) then
    changes = pre(changes) + 1;
  end when;
  when {low, not high} then
    either = pre(either) + 1;
  end when;
  when first > 101 then
    chained = first;
  end when;
end Counter;
"""


def test_edges_changes_and_branches(way: Way) -> None:
    names = ["first", "changes", "either", "chained"]
    result = way.run(COUNTER, 2.125, 0.125, names)
    state = {name: 0 for name in names}
    low = high = False
    for i, row in enumerate(result):
        phase = (0.003 + i / 8) % 1
        rises = (phase >= 0.2 and not low, phase >= 0.45 and not high)
        state["first"] += 1 if rises[0] else 100 if rises[1] else 0
        state["changes"] += (phase >= 0.2) != low
        state["either"] += rises[0] + (phase < 0.45 and high)
        state["chained"] = 102 if state["first"] > 101 else 0
        low, high = phase >= 0.2, phase >= 0.45
        assert {name: row[name] for name in names} == state, row["time"]
    assert state == {"first": 202, "changes": 4, "either": 4, "chained": 102}


ROUNDING = """
model Rounding "Functions that jump"
  Real x(start=-2.3137, fixed=true);
  output Real up;
  output Real down;
  output Real rest;
  output Real remainder;
  output Integer quotient;
  output Integer whole;
  Real area(start=0, fixed=true) "Its integral shows that the jumps are located";
equation
  der(x) = 1;
  up = ceil(x);
  down = floor(x);
  rest = mod(x, 0.7);
  remainder = rem(x, 0.7);
  quotient = div(integer(10*x), 3);
  whole = integer(2*x);
  der(area) = down;
end Rounding;
"""


def test_rounding(way: Way) -> None:
    result = way.run(ROUNDING, 5.0, 0.05, ["up", "down", "rest", "remainder", "quotient", "whole", "area"])
    fine = np.linspace(0, 5.0, 1000001)
    areas = np.concatenate([[0.0], np.cumsum(np.floor(-2.3137 + 0.5 * (fine[1:] + fine[:-1])))]) * 5e-6
    for row in result:
        x = row["time"] - 2.3137
        assert row["up"] == np.ceil(x) and row["down"] == np.floor(x) and row["whole"] == np.floor(2 * x)
        assert row["rest"] == pytest.approx(np.mod(x, 0.7), abs=1e-7)
        assert row["remainder"] == pytest.approx(np.fmod(x, 0.7), abs=1e-7)
        assert row["quotient"] == int(np.floor(10 * x) / 3)
        assert row["area"] == pytest.approx(np.interp(row["time"], fine, areas), abs=1e-5)


MACHINE = """
model Machine "An enumeration as state"
  type Mode = enumeration(idle, rising, falling);
  parameter Mode after = Mode.falling "What follows on rising";
  output Mode mode(start=Mode.idle, fixed=true);
  Real x(start=0, fixed=true);
equation
  der(x) = if mode == Mode.rising then 1 elseif mode == Mode.falling then -2 else 0;
  when time >= 0.3 then
    mode = Mode.rising;
  elsewhen x > 1 then
    mode = after;
  elsewhen x < 0 then
    mode = Mode.idle;
  end when;
end Machine;
"""


def test_an_enumeration(way: Way) -> None:
    result = way.run(MACHINE, 2.5, 0.1, ["mode", "x"])
    modes = {round(row["time"], 3): row["mode"] for row in result}
    assert [modes[t] for t in (0.2, 0.4, 1.2, 1.4, 1.7, 1.9)] == [1, 2, 2, 3, 3, 1]
    again = way.run(MACHINE, 2.5, 0.1, ["mode", "x"], start_values={"after": 1})
    assert again["mode"][-1] == 1 and again["x"][-1] == pytest.approx(1.0, abs=1e-6)


TICKS = """
model Ticks "Events at times known beforehand"
  parameter Real T = 0.3;
  parameter Integer n_0 = 2;
  final parameter Integer twice = 2*n_0;
  output Integer n(start=n_0, fixed=true);
  output Integer m(start=twice, fixed=true);
  output Integer k(start=0, fixed=true);
  discrete output Real next(start=0.25, fixed=true);
  output Real exact(start=0, fixed=true) "The integral of n";
equation
  der(exact) = n;
  when sample(0, 0.1) then
    n = pre(n) + 1;
  end when;
  when {initial(), time >= T, time > 2*T} then
    m = pre(m) + 10;
  end when;
  when time >= pre(next) then
    next = pre(next) + 0.25;
    k = pre(k) + 1;
  end when;
end Ticks;
"""


def test_events_at_known_times(way: Way) -> None:
    result = way.run(TICKS, 1.05, 0.05, ["n", "m", "k", "next", "exact"], tolerance=1e-6)
    for i, row in enumerate(result):
        assert row["n"] == 3 + i // 2, row["time"]
        assert row["m"] == 14 + 10 * (i >= 6) + 10 * (i >= 12)
        assert (row["k"], row["next"]) == (i // 5, 0.25 * (1 + i // 5))
        full, part = divmod(i, 2)
        assert row["exact"] == pytest.approx(0.1 * sum(range(3, 3 + full)) + 0.05 * part * (3 + full), abs=1e-12)


def test_parameters_of_discrete_start_values(way: Way) -> None:
    result = way.run(TICKS, 0.2, 0.1, ["n", "m"], start_values={"n_0": 7})
    assert (result["n"][0], result["m"][0]) == (8, 24)


INITIAL = """
model Initial "Initial equations and a free parameter"
  parameter Real rate(fixed=false, start=1);
  parameter Real slope = -3;
  Real x(start=2, fixed=true);
  Real y "Starts from where it rests";
  Real z "Starts from an equation";
  output Integer n;
  output Boolean b;
initial equation
  der(x) = slope;
  der(y) = 0;
  z = 2*y + 1;
  n = 4;
  pre(b) = true;
equation
  der(x) = -rate*x;
  der(y) = x - 4*y;
  der(z) = if b then 1 else 0;
  when x < 1 then
    n = pre(n) + 1;
    b = false;
  end when;
end Initial;
"""


def test_initial_equations(way: Way) -> None:
    result = way.run(INITIAL, 1.0, 0.1, ["rate", "x", "y", "z", "n", "b"])
    assert result["rate"][0] == pytest.approx(1.5)
    assert (result["y"][0], result["z"][0], result["n"][0], result["b"][0]) == (0.5, 2.0, 4, 1)
    assert result["x"][-1] == pytest.approx(2 * np.exp(-1.5), abs=1e-8)
    assert (result["n"][-1], result["b"][-1]) == (5, 0)
    assert result["z"][-1] == pytest.approx(2 + np.log(2) / 1.5, abs=1e-8)
    steeper = way.run(INITIAL, 0.1, 0.1, ["rate"], start_values={"slope": -5.0})
    assert steeper["rate"][0] == pytest.approx(2.5)


ALGORITHM = """
model Algorithms "Statements one after another"
  Real x(start=1, fixed=true);
  output Real y;
  output Integer n(start=0, fixed=true);
  output Boolean up(start=true, fixed=true);
algorithm
  if x > 0.5 then
    y := 2*x + 1;
  else
    y := 3*x + 1;
  end if;
algorithm
  when sample(0.1, 0.1) then
    if pre(up) then
      n := pre(n) + 1;
    else
      n := pre(n) - 1;
    end if;
    up := n < 5 and (pre(up) or n <= 0);
  end when;
initial algorithm
  n := 3;
equation
  der(x) = -x;
end Algorithms;
"""


def test_algorithm_sections(way: Way) -> None:
    result = way.run(ALGORITHM, 1.55, 0.05, ["x", "y", "n"])
    n, up = 3, True
    for i, row in enumerate(result):
        if i and i % 2 == 0:
            n += 1 if up else -1
            up = n < 5 and (up or n <= 0)
        assert row["n"] == n, row["time"]
        x = np.exp(-row["time"])
        assert row["y"] == pytest.approx((2 * x if x > 0.5 else 3 * x) + 1, abs=1e-6)


TEETH = """
model Teeth "A relation that changes faster than any state does"
  Real phi(start=0, fixed=true);
  output Integer count(start=0, fixed=true);
equation
  der(phi) = 1 + 0.1*phi;
  when sin(20*phi) > 0 then
    count = pre(count) + 1;
  end when;
end Teeth;
"""


def test_a_relation_that_swings_within_a_step_is_seen(co_simulation: Way) -> None:
    result = co_simulation.run(TEETH, 6.0, 2.0, ["count"])
    phi = 10 * (np.exp(0.1 * result["time"]) - 1)
    assert list(result["count"]) == list(np.ceil(20 * phi / (2 * np.pi)))
    assert result["count"][-1] > 25
