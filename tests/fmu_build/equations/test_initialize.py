"""Parameters that initial equations determine, and all that follows from them."""

from __future__ import annotations

import re
from collections.abc import Callable

import fmpy
import pytest

from fmu_build.errors import BuildError
from fmu_build.ir.models import SortedModel
from tests.fmu_build.conftest import Build
from tests.sampling import sampled

# What determines the parameter a, with declarations and equations of its own, and the value of a by that of q.
DETERMINED = {
    "parameters alone": ("", "", "a + 1 = q;", lambda q: q - 1),
    "parameters alone, nonlinear": ("", "", "a^3 = q;", lambda q: q ** (1 / 3)),
    "two parameters": ("parameter Real o(fixed=false);", "", "a + o = q; a - o = 1;", lambda q: (q + 1) / 2),
    "a constant variable": ("Real o;", "o = 2*q;", "a = o/3;", lambda q: 2 * q / 3),
    "a variable by its declaration": ("Real o = 2*q;", "", "a = o/3;", lambda q: 2 * q / 3),
    "a variable that follows from it": ("Real o;", "o = 2*a + sin(time);", "o = q;", lambda q: q / 2),
    "a derivative": ("Real o(start=1, fixed=true);", "der(o) = -a*o;", "der(o) = -q;", lambda q: q),
    "a derivative by what is bound": (
        "Real o(start=1, fixed=true);",
        "der(o) = -b*o;",
        "der(o) = -q;",
        lambda q: q / 3,
    ),
    "a state that is fixed": ("Real o(start=q, fixed=true);", "der(o) = 1;", "a = o;", lambda q: q),
    "its start value alone": ("", "", "", lambda q: 7.0),
    "an array": ("parameter Real o[2](each fixed=false);", "", "o = {q, 2*q}; a = o[2];", lambda q: 2 * q),
}
# What follows from it: declarations, an equation, and the value of y by that of a.
FOLLOWS = {
    "itself": ("Real y = a;", "", lambda a: a),
    "bound": ("Real y = b;", "", lambda a: 3 * a),
    "chain": ("parameter Real d = b + 1; parameter Real e = d^2 + a; Real y = e;", "", lambda a: (3 * a + 1) ** 2 + a),
    "chain against the order": (
        "Real y = e; parameter Real e = d + 1; parameter Real d = -b;",
        "",
        lambda a: 1 - 3 * a,
    ),
    "alias": ("parameter Real d = b; parameter Real e = d; Real y = 2*e;", "", lambda a: 6 * a),
    "element": ("parameter Real d[2] = {a, 2*b}; Real y = d[2];", "", lambda a: 6 * a),
    "component": ("model C parameter Real k = 1; Real v = 2*k; end C; C c(k=b); Real y = c.v;", "", lambda a: 6 * a),
    "fixed start": ("Real y(start=b + 1, fixed=true);", "der(y) = 0;", lambda a: 3 * a + 1),
    "start": ("Real y(start=b + 1);", "der(y) = 0;", lambda a: 3 * a + 1),
    "discrete start": (
        "discrete Real y(start=2*b);",
        "when time > 1 then y = pre(y) + 1; end when;",
        lambda a: 6 * a,
    ),
    "slope": ("Real y(start=0, fixed=true);", "der(y) = 1e3*b;", lambda a: 3 * a),  # after a thousandth
    "condition": ("parameter Boolean d = b > 0; Real y = if d then 1 else -1;", "", lambda a: 1.0),
}
MODEL = """model M
  parameter Real q = 8;
  {declarations}
initial equation
  {initial}
equation
  {equations}
end M;
"""
Value = Callable[[float], float]


def own(text: str, number: int) -> str:
    """The text with names of its own."""
    return re.sub(r"\b[abcdeoyC]\b", rf"\g<0>{number}", text)


def chained(inner: Value, outer: Value) -> Value:
    return lambda q: outer(inner(q))


def model() -> tuple[str, dict[str, tuple[str, Value]]]:
    """The crossing in one class: its text, and by the name of each y its title and its value by that of q."""
    lines: dict[str, list[str]] = {"declarations": [], "initial": [], "equations": []}
    values: dict[str, tuple[str, Value]] = {}
    for way, (declared, equation, initial, of_q) in DETERMINED.items():
        for what, (followed, law, of_a) in FOLLOWS.items():
            number = len(values) + 1
            head = "parameter Real a(start=7, fixed=false); parameter Real b = 3*a;"
            for key, text in (
                ("declarations", head + declared + followed),
                ("initial", initial),
                ("equations", equation + law),
            ):
                lines[key].append(own(text, number))
            values[f"y{number}"] = (f"{what} of {way}", chained(of_q, of_a))
    return MODEL.format(**{key: "\n  ".join(part) for key, part in lines.items()}), values


@pytest.mark.full
@pytest.mark.parametrize("fmi", [2, 3])
def test_what_follows_from_a_parameter_that_initial_equations_determine(fmi: int, built: Build) -> None:
    text, values = model()
    fmu = str(built(text, fmi))
    for settings in ({}, {"q": 27.0}):
        last = fmpy.simulate_fmu(
            fmu, stop_time=1e-3, start_values=settings, output=list(values), relative_tolerance=1e-9
        )[-1]
        q = settings.get("q", 8.0)
        wrong = {
            title: (float(last[name]), value(q))
            for name, (title, value) in values.items()
            if abs(last[name] - value(q)) > 1e-6 + 1e-6 * abs(value(q))
        }
        assert wrong == {}


PENDULUM = """
model M
  parameter Real L = 0.5, angle = 0.3;
  Real x({}), y({}), v(start=0, fixed=true), w(start=0, fixed=true), F;
{}equation
  der(x) = v;
  der(y) = w;
  der(v) = -x*F;
  der(w) = -y*F - 9.81;
  x^2 + y^2 = L^2;
end M;
"""
LEVEL = ("start=0.5, fixed=true", "start=0, fixed=true")
STARTS = {
    "fixed": (*LEVEL, "", 0),
    "fixed, contradicting": ("start=0.4, fixed=true", "start=0, fixed=true", "", 0.16 - 0.25),
    "equations": ("start=0", "start=0", "x = L; y = 0;", 0),
    "equations, contradicting": ("start=0.5", "start=0", "x = L/2; y = 0;", 0.0625 - 0.25),
    "equations, one after another": ("", "", "y = -x/2; x = 2*L/sqrt(5);", 0),
    "equations, one after another, contradicting": ("", "", "y = -x/2; 2*x = 2*L;", 0.0625),
    "an equation beside a fixed one": ("start=0.3, fixed=true", "", "y + x + 0.1 = 0;", 0),
    "an equation beside a fixed one, contradicting": ("start=0.3, fixed=true", "", "y = x;", 0.18 - 0.25),
    "of an angle": ("", "", "x = L*sin(angle); y = -L*cos(angle);", 0),
}


@pytest.mark.parametrize(
    "case", sampled(STARTS, {"equations", "equations, contradicting", "an equation beside a fixed one, contradicting"})
)
def test_a_constraint_that_nothing_is_left_of_is_checked(case: str, sorted_model: Callable[[str], SortedModel]) -> None:
    x, y, equations, error = STARTS[case]
    text = PENDULUM.replace("{}", x, 1).replace("{}", y, 1)
    text = text.replace("{}", f"initial equation\n  {equations}\n" if equations else "", 1)
    if error == 0:
        sorted_model(text)
    else:
        with pytest.raises(
            BuildError, match=rf"M\.mo:\d+: the fixed start values contradict this equation, by {error:g}:"
        ):
            sorted_model(text)
