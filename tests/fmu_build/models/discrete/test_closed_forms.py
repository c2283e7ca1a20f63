"""Models with events against their closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from tests.fmu_build.models.discrete.conftest import Way

BALL = """
model BouncingBall "A ball that loses speed at every bounce"
  type Height = Real(unit="m");
  type Velocity = Real(unit="m/s");
  parameter Real e(unit="1") = 0.8 "Coefficient of restitution";
  parameter Height h0 = 1.0;
  constant Real g(unit="m/s2") = 9.81;
  Height h;
  Velocity v(start=0.0, fixed=true);
  output Integer bounces(start=0, fixed=true);
  discrete output Real last(start=0, fixed=true, unit="s") "Time of the last bounce";
initial equation
  h = h0;
equation
  v = der(h);
  der(v) = -g;
  when h < 0 then
    reinit(v, -e*pre(v));
    bounces = pre(bounces) + 1;
    last = time;
  end when;
end BouncingBall;
"""


def bounce_times(count: int, e: float = 0.8, h0: float = 1.0) -> np.ndarray:
    first = np.sqrt(2 * h0 / 9.81)
    return first * np.cumsum([1.0, *(2 * e**k for k in range(1, count))])


def test_a_bouncing_ball_bounces_when_it_should(way: Way) -> None:
    tolerance = 1e-10 if way.interface == "CoSimulation" else 1e-12  # FMPy's CVode integrates to its tolerance
    result = way.run(BALL, 3.5, 0.01, ["last", "bounces", "h"], tolerance=tolerance)
    times = bounce_times(20)
    seen = result["bounces"][-1]
    assert seen == np.searchsorted(times, 3.5)
    for count in range(1, seen + 1):
        assert result["last"][result["bounces"] == count][0] == pytest.approx(times[count - 1], abs=1e-9)


def test_the_height_before_and_after_a_bounce(co_simulation: Way) -> None:
    result = co_simulation.run(BALL, 1.2, 0.1, ["h", "v"], start_values={"e": 0.5, "h0": 2.0})
    first = np.sqrt(4 / 9.81)
    speed = 0.5 * 9.81 * first
    for time, height in zip(result["time"], result["h"], strict=True):
        later = time - first
        exact = 2 - 9.81 / 2 * time**2 if later < 0 else speed * later - 9.81 / 2 * later**2
        assert height == pytest.approx(exact, abs=1e-9)


THERMOSTAT = """
model Thermostat "Heating with hysteresis"
  parameter Real T_amb = 10;
  parameter Real T_low = 19;
  parameter Real T_high = 21;
  parameter Real Q = 30;
  Real T(start=10, fixed=true);
  output Boolean heating(start=true, fixed=true);
  output Integer switches(start=0, fixed=true);
protected
  Boolean cold;
equation
  der(T) = (if heating then Q else 0) - (T - T_amb);
  cold = T < T_low;
  when T > T_high then
    heating = false;
  elsewhen cold then
    heating = true;
  end when;
  when change(heating) then
    switches = pre(switches) + 1;
  end when;
end Thermostat;
"""


def thermostat(time: float) -> tuple[float, int]:
    """Temperature and number of switches: exponentials between the limits."""
    temperature, now, switches, heating = 10.0, 0.0, 0, True
    while True:
        goal, limit = (40.0, 21.0) if heating else (10.0, 19.0)
        duration = np.log((temperature - goal) / (limit - goal))
        if now + duration > time:
            return goal + (temperature - goal) * np.exp(now - time), switches
        now, temperature, heating, switches = now + duration, limit, not heating, switches + 1


def test_a_thermostat_with_hysteresis(way: Way) -> None:
    result = way.run(THERMOSTAT, 4.0, 0.05, ["T", "switches"])
    for time, temperature, switches in result:
        exact, count = thermostat(time)
        assert temperature == pytest.approx(exact, abs=1e-6)
        assert switches == count
    assert count > 20


SAMPLED_PI = """
model SampledPI "A PI controller that samples every 50 ms"
  parameter Real T_s(unit="s") = 0.05;
  parameter Real k = 2;
  parameter Real T_i(unit="s") = 0.4;
  parameter Real target = 1;
  Real x(start=0, fixed=true);
  discrete output Real u(start=0, fixed=true);
protected
  discrete Real e(start=0, fixed=true);
  discrete Real sum(start=0, fixed=true);
equation
  der(x) = -x + u;
  when sample(0, T_s) then
    e = target - x;
    sum = pre(sum) + T_s*e/T_i;
    u = k*(e + sum);
  end when;
end SampledPI;
"""


def test_a_sampled_controller_is_a_recurrence(way: Way) -> None:
    result = way.run(SAMPLED_PI, 2.0, 0.05 / 2, ["x", "u"], tolerance=1e-11)
    x, total, rows = 0.0, 0.0, {}
    for i in range(40):
        total += 0.05 * (1 - x) / 0.4
        u = 2 * (1 - x + total)
        rows[2 * i + 1] = (u + (x - u) * np.exp(-0.025), u)  # in the middle between two ticks
        x = u + (x - u) * np.exp(-0.05)
    middle = {round(row["time"] / 0.025): row for row in result}
    for index, (position, control) in rows.items():
        assert middle[index]["x"] == pytest.approx(position, abs=1e-7)
        assert middle[index]["u"] == pytest.approx(control, abs=1e-7)


RLC = """
model SwitchedRLC "A circuit that is connected at t_on"
  type Voltage = Real(unit="V");
  type Current = Real(unit="A");
  parameter Voltage V_b = 24;
  parameter Real L(unit="H") = 1;
  parameter Real R(unit="Ohm") = 100;
  parameter Real C(unit="F") = 1e-3;
  parameter Real t_on(unit="s") = 0.3;
  Voltage V_s;
  output Voltage V;
  Current i_L;
  Current i_R;
  Current i_C;
initial equation
  der(V) = 0;
  der(i_L) = 0;
equation
  V_s = if time >= t_on then V_b else V_b/2;
  V = i_R*R;
  C*der(V) = i_C;
  L*der(i_L) = V_s - V;
  i_L = i_R + i_C;
end SwitchedRLC;
"""


def test_a_switched_circuit_from_its_steady_state(way: Way) -> None:
    result = way.run(RLC, 1.5, 0.1, ["V"])
    damping, frequency = 1 / (2 * 100 * 1e-3), np.sqrt(1 / 1e-3 - (1 / (2 * 100 * 1e-3)) ** 2)
    for time, voltage in result:
        late = max(0.0, time - 0.3)
        swing = np.exp(-damping * late) * (np.cos(frequency * late) + damping / frequency * np.sin(frequency * late))
        assert voltage == pytest.approx(24 - 12 * swing, abs=2e-6)


BACKLASH = """
model Backlash "A mass that moves freely in a gap, between two springs"
  parameter Real m(unit="kg") = 2;
  parameter Real k(unit="N/m") = 50 "Stiffness of each spring";
  parameter Real b(unit="m") = 0.1 "Half of the gap";
  Real x(unit="m", start=0, fixed=true);
  Real v(unit="m/s", start=1, fixed=true);
  Real F(unit="N") = if x > b then k*(x - b) elseif x < -b then k*(x + b) else 0;
equation
  der(x) = v;
  m*der(v) = -F;
end Backlash;
"""


def test_backlash(way: Way) -> None:
    result = way.run(BACKLASH, 5.0, 0.02, ["x", "v"], tolerance=1e-11)
    omega = 5.0  # of half a swing on a spring, pi/omega long, between flights through the gap, 0.2 s long
    period = 2 * (0.2 + np.pi / omega)
    for time, x, v in result:
        late = (time + 0.1) % (period / 2)  # since it entered the gap
        side = 1 if (time + 0.1) % period < period / 2 else -1
        swing = omega * (late - 0.2)
        exact = (late - 0.1, 1.0) if late < 0.2 else (0.1 + np.sin(swing) / omega, np.cos(swing))
        assert (x, v) == pytest.approx((side * exact[0], side * exact[1]), abs=2e-7), time


STICK_SLIP = """
model StickSlip "A block on a belt, on a spring"
  parameter Real k(unit="N/m") = 10;
  parameter Real v_b(unit="m/s") = 0.3 "Speed of the belt";
  parameter Real F_s(unit="N") = 2 "Friction that the block sticks with, at most";
  parameter Real F_d(unit="N") = 1 "Friction that it slips with";
  Real x(start=0, fixed=true, unit="m");
  Real v(start=0.3, fixed=true, unit="m/s");
  output Boolean sticks(start=true, fixed=true);
  output Integer slips(start=0, fixed=true);
equation
  der(x) = v;
  der(v) = if sticks then 0 else F_d - k*x;
  when k*x > F_s then
    sticks = false;
    slips = pre(slips) + 1;
  elsewhen v > v_b then
    sticks = true;
    slips = pre(slips);
    reinit(v, v_b);
  end when;
end StickSlip;
"""


def test_stick_slip(way: Way) -> None:
    result = way.run(STICK_SLIP, 6.0, 0.02, ["x", "sticks", "slips"])
    omega = np.sqrt(10.0)
    first = 0.2 / 0.3
    for time, x, sticks, _ in result:
        phase = time - first
        if phase < 0:
            exact = (0.3 * time, True)
        else:  # x - 0.1 = 0.1 cos + 0.3/omega sin until the velocity is 0.3 again, then along with the belt
            slip = 2 * (np.pi - np.arctan2(0.1, 0.3 / omega)) / omega
            phase %= slip + 0.2 / 0.3
            swing = 0.1 + 0.1 * np.cos(omega * phase) + 0.3 / omega * np.sin(omega * phase)
            exact = (swing, False) if phase < slip else (0.3 * (phase - slip), True)
        assert x == pytest.approx(exact[0], abs=1e-6), time
        assert sticks == exact[1]
    assert result["slips"][-1] == 3


PREY = """
model PredatorPrey "Lotka and Volterra, steady until someone hunts the prey"
  parameter Real a = 1.5, b = 1, c = 3, d = 1;
  parameter Real hunting = 0.4;
  Real x(start=2.5) "Prey", y(start=1.2) "Predators";
  Real growth = if time < 1 then a else a - hunting;
initial equation
  der(x) = 0;
  der(y) = 0;
equation
  der(x) = growth*x - b*x*y;
  der(y) = d*x*y - c*y;
end PredatorPrey;
"""


@pytest.mark.parametrize("a", [1.5, 1.7])
def test_predator_and_prey_from_a_steady_start(way: Way, a: float) -> None:
    result = way.run(PREY, 5.0, 0.1, ["x", "y"], start_values={"a": a})
    x, y = result["x"], result["y"]
    invariant = x - 3 * np.log(x) + y - (a - 0.4) * np.log(y)
    steady = result["time"] < 1.05
    np.testing.assert_allclose(x[steady], 3, atol=1e-8)
    np.testing.assert_allclose(y[steady], a, atol=1e-8)
    np.testing.assert_allclose(invariant, invariant[0], atol=1e-7)
    assert np.ptp(x) > 1
