"""Functions that round, of the time and of a state, rising and falling, against their closed forms."""

from __future__ import annotations

import numpy as np

from tests.fmu_build.models.discrete.conftest import Way

FORMS = {
    "floor": np.floor,
    "ceil": np.ceil,
    "integer": np.floor,
    "mod": lambda x: np.mod(x, 0.3),
    "rem": lambda x: np.fmod(x, 0.4),
    "div": lambda x: np.trunc(x / 0.4),
}
CALLS = {"mod": "mod({}, 0.3)", "rem": "rem({}, 0.4)", "div": "div({}, 0.4)"}

# Arguments, and the same as functions of time. The jumps of several fall on one time that each rounds in its own way.
ARGUMENTS = {
    "3*time": lambda t: 3 * t,
    "-3*time": lambda t: -3 * t,
    "time - 1.1": lambda t: t - 1.1,
    "0.2 - 7*time": lambda t: 0.2 - 7 * t,
    "f*time": lambda t: 2.97 * t,
    "3*time + n": lambda t: 3 * t + 2 * np.floor(0.5 + t),
    "x": lambda t: 1.5 * np.sin(t),
}
MODEL = """
model Rounded
  parameter Real f = 2.97;
  Integer n = 2*integer(0.5 + time);
  Real x(start=0, fixed=true);
{declarations}
equation
  der(x) = 1.5*cos(time);
end Rounded;
"""


OUTPUTS = {
    f"{name}_{i}": CALLS.get(name, name + "({})").format(argument)
    for name in FORMS
    for i, argument in enumerate(ARGUMENTS)
}


def test_rounding_a_value_that_rises_and_falls(way: Way) -> None:
    text = MODEL.format(declarations="\n".join(f"  output Real {name} = {call};" for name, call in OUTPUTS.items()))
    result = way.run(text, 9.875, 0.125, list(OUTPUTS), tolerance=1e-8)[1:]
    for name, form in FORMS.items():
        for i, (argument, value) in enumerate(ARGUMENTS.items()):
            exact = form(value(result["time"] + 1e-6))  # at a jump: the value behind it
            np.testing.assert_allclose(result[f"{name}_{i}"], exact, atol=2e-5, err_msg=f"{name} of {argument}")
