"""Clocks, by closed forms. Modelica 3.6, chapter 16."""

from __future__ import annotations

import pytest

from fmu_build.errors import BuildError
from fmu_build.frontend.flatten import flatten
from tests.fmu_build.conftest import Writer
from tests.fmu_build.models.discrete.blocks import Case, check, ticks
from tests.fmu_build.models.discrete.conftest import Way

CASES: dict[str, Case] = {
    "a counter": (
        "Clock c = Clock(0.1); Real s(start=0); output Real y;",
        "equation when c then s = previous(s) + 1; end when; y = hold(s);",
        {"y": lambda t: ticks(t, 0.1)},
    ),
    "a clock without a name": (
        "output Integer n(start=3); Boolean b(start=false); output Boolean y;",
        "equation when Clock(0.1) then n = previous(n) + 1; b = not previous(b); end when; y = hold(b);",
        {"n": lambda t: 3 + ticks(t, 0.1), "y": lambda t: ticks(t, 0.1) % 2},
    ),
    "samples of the time by two clocks": (
        "Real x, y; output Real z;",
        "equation x = sample(time, Clock(0.1)); y = sample(time, Clock(1, 4)); z = hold(x) + hold(y);",
        {"z": lambda t: 0.1 * (ticks(t, 0.1) - 1) + 0.25 * (ticks(t, 0.25) - 1)},
    ),
    "hold of a sample of an expression": (
        "output Real y;",
        "equation y = 1 + hold(sample(2*time, Clock(0.1)));",
        {"y": lambda t: 1 + 0.2 * (ticks(t, 0.1) - 1)},
    ),
    "slower and faster": (
        "parameter Integer N = 10; Real x, z, w; output Real slow, fast;",
        "equation x = sample(time, Clock(1, N)); z = subSample(x, 3); w = superSample(x, 2);"
        " slow = hold(z); fast = hold(w);",
        {"slow": lambda t: 0.3 * (ticks(t, 0.3) - 1), "fast": lambda t: 0.1 * (ticks(t, 0.1) - 1)},
    ),
    "a faster counter": (
        "Clock c = Clock(0.1); Integer k(start=0); Real x, w, q; output Integer y;",
        "equation x = sample(time, c); w = superSample(x, 2); q = w + k; k = previous(k) + 1; y = hold(k);",
        {"y": lambda t: ticks(t, 0.05)},
    ),
    "later, and back": (
        "Clock c = Clock(0.1); Real s, r(start=-1), q(start=-1); output Real y, z;",
        "equation s = sample(time, c); r = shiftSample(s, 3); q = backSample(r, 2); y = hold(r); z = hold(q);",
        {
            "y": lambda t: 0.1 * (ticks(t, 0.1) - 1) if t > 0.299 else -1,
            "z": lambda t: 0.1 * (ticks(t, 0.1) - 1) if t > 0.299 else -1,
        },
    ),
    "half an interval later": (
        "Clock c = Clock(0.1); Clock d = shiftSample(c, 1, 2); Integer n(start=0); output Integer y;",
        "equation when d then n = previous(n) + 1; end when; y = hold(n);",
        {"y": lambda t: ticks(t, 0.1, 0.05)},
    ),
    "a sample is the left limit": (
        "Clock c = Clock(0.1); Real k(start=0); Real u; output Real s;",
        "equation when c then k = previous(k) + 1; end when; u = hold(k); s = sample(u, c);",
        {"s": lambda t: ticks(t, 0.1) - 1},
    ),
    "values of another clock at the same instant": (
        "Clock c = Clock(0.1); Clock d = subSample(c, 3); Real s(start=0), z; output Real y;",
        "equation when c then s = previous(s) + 1; end when; when d then z = subSample(s, 3); end when; y = hold(z);",
        {"y": lambda t: 1 + 3 * (ticks(t, 0.3) - 1)},
    ),
    "interval, first tick": (
        "Clock c = Clock(0.1); output Real s(start=0), f(start=0);",
        "equation when c then s = previous(s) + interval(s); f = if firstTick() then 7 else previous(f) + 1; end when;",
        {"s": lambda t: 0.1 * ticks(t, 0.1), "f": lambda t: 6 + ticks(t, 0.1)},
    ),
    "a condition": (
        "Real x(start=0, fixed=true); output Real n(start=0);",
        "equation der(x) = 1; when Clock(x > 0.52) then n = previous(n) + sample(x); end when;",
        {"n": lambda t: 0.52 * (t > 0.52)},
    ),
    "declarations, and values from before": (
        "Real u = sample(time, Clock(0.1)); Real u1(start=0) = previous(u); Real m; output Real y;",
        "equation m = (u + u1 + previous(u1))/3; y = hold(m);",
        {"y": lambda t: sum(0.1 * max(0, ticks(t, 0.1) - 1 - i) for i in range(3)) / 3},
    ),
    "elements": (
        "Real b[4](each start=0); output Real y;",
        "equation when Clock(0.1) then b[1] = sample(time);"
        " for i in 2:4 loop b[i] = previous(b[i - 1]); end for; end when; y = hold(b[4]);",
        {"y": lambda t: 0.1 * max(0, ticks(t, 0.1) - 4)},
    ),
    "a matrix": (
        "parameter Real P[2, 2] = [0.5, 0.5; 0, 1]; Real x[2](start={0, 1}); output Real y;",
        "equation when Clock(0.1) then x = P*previous(x); end when; y = hold(x[1]);",
        {"y": lambda t: 1 - 0.5 ** ticks(t, 0.1)},
    ),
    "an enumeration inside and outside": (
        "type E = enumeration(a, b); Clock c = Clock(0.1); E e(start=E.a); Integer k(start=0); output Integer y;"
        " E f(start=E.b, fixed=true);",
        "equation when c then e = if previous(e) == E.a then E.b else E.a; k = if e == E.b then 1 else 2; end when;"
        " when time > 0.52 then f = E.a; end when; y = hold(k) + (if f == E.a then 10 else 0);",
        {"y": lambda t: 2 - ticks(t, 0.1) % 2 + 10 * (t > 0.52)},
    ),
    "blocks that know no clock": (
        "block Sum input Real u; output Real y(start=0); equation y = previous(y) + u; end Sum;"
        " block Sampler input Real u; output Real y; Clock c = Clock(0.1); equation y = sample(u, c); end Sampler;"
        " Sum sum; Sampler sampler; output Real y;",
        "equation sampler.u = time; connect(sampler.y, sum.u); y = hold(sum.y);",
        {"y": lambda t: 0.05 * ticks(t, 0.1) * (ticks(t, 0.1) - 1)},
    ),
}


def test_clocks(way: Way) -> None:
    check(way, "Clocks", CASES)


CONTROL = """
model Control "A sampled controller of a double integrator"
  Clock c = Clock(1, 50);
  Real x(start=0, fixed=true), v(start=0, fixed=true);
  Real xd, vd, ud, I(start=0);
  output Real y = x;
equation
  der(x) = v;
  der(v) = hold(ud);
  xd = sample(x, c);
  vd = sample(v, c);
  I = previous(I) + interval(I)*(1 - xd);
  ud = 4*(1 - xd) - 3*vd + 0.5*I;
end Control;
"""


def test_a_sampled_controller(way: Way) -> None:
    result = way.run(CONTROL, 2.0, 0.02, ["x"])
    x = v = total = 0.0
    for row in result:
        assert row["x"] == pytest.approx(x, abs=1e-7)
        total += 0.02 * (1 - x)
        u = 4 * (1 - x) - 3 * v + 0.5 * total
        x, v = x + 0.02 * v + 0.0002 * u, v + 0.02 * u


@pytest.mark.parametrize(
    ("clock", "said"),
    [
        ('Clock(Clock(0.1), solverMethod="ExplicitEuler")', "takes no solverMethod: write the method out"),
        ("Clock(k, 10)", "Clock"),
    ],
)
def test_other_clocks_are_refused_with_their_place(clock: str, said: str, modelica_file: Writer) -> None:
    path = modelica_file(
        f"model M\n  Integer k(start=1);\n  Clock c = {clock};\nequation\n  when c then\n"
        "    k = previous(k) + 1;\n  end when;\nend M;\n"
    )
    with pytest.raises(BuildError, match=rf"M.mo:\d: .*{said}"):
        flatten(path, "M")


def test_a_sample_of_what_has_a_clock_is_refused(modelica_file: Writer) -> None:
    """interval(u) says that u has a clock; sample(u) would be a value one tick old."""
    path = modelica_file(
        "model M\n  Real u = time;\n  Real y(start=0);\nequation\n  when Clock(0.2) then\n"
        "    y = previous(y) + interval(u)*sample(u);\n  end when;\nend M;\n"
    )
    with pytest.raises(BuildError, match=r"M.mo:6: sample of u, which has a clock already"):
        flatten(path, "M")
