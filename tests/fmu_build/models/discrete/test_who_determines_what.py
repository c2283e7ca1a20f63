"""A discrete variable that stands alone on one side of several equations: one of them gives it its value."""

from __future__ import annotations

import numpy as np
import pytest

from tests.fmu_build.models.discrete.conftest import Way
from tests.sampling import spread

# What gives the variable its value, and what that is at a time.
DEFINITIONS = {
    "integer()": ("Integer k", "k = integer(2*time)", lambda t: np.floor(2 * t)),
    "a condition": ("Integer k", "k = if time > 0.25 then 3 else 1", lambda t: np.where(t > 0.25, 3, 1)),
    "another Integer": ("Integer m = integer(2*time), k", "k = m", lambda t: np.floor(2 * t)),
    "a clock": (
        "Integer k(start=0, fixed=true)",
        "when sample(0.25, 0.25) then k = pre(k) + 2; end when",
        lambda t: 2 * np.floor(4 * t),
    ),
}
USES = {
    "a derivative": ("", "der(x) = k"),
    "a variable": ("Real y", "y = k;\n  der(x) = y"),
    "an expression": ("Real y", "y - sin(time) = k;\n  der(x) = y - sin(time)"),
    "a component": ("Gain g", "g.u = k;\n  2*der(x) = g.y"),
}
GAIN = "block Gain\n  input Integer u;\n  output Integer y;\nequation\n  y = 2*u;\nend Gain;\n"
MODEL = """model M
  {};
  {}
  Real x(start=0, fixed=true);
equation
  {};
end M;"""


@pytest.mark.parametrize(("definition", "use"), spread(DEFINITIONS, USES, every=2))
def test_equations_in_any_order(definition: str, use: str, co_simulation: Way) -> None:
    declared, defines, value = DEFINITIONS[definition]
    more, uses = USES[use]
    is_first = (list(DEFINITIONS).index(definition) + list(USES).index(use)) % 2 == 0
    equations = ";\n  ".join([defines, uses] if is_first else [uses, defines])
    result = co_simulation.run(
        GAIN + MODEL.format(declared, more and more + ";", equations), 1.0, 0.125, ["x", "k"], tolerance=1e-9
    )
    middles = np.arange(0.0625, 1.0, 0.125)
    np.testing.assert_allclose(np.diff(result["x"]), value(middles) * 0.125, atol=1e-9)
    between = (result["time"] * 8) % 2 == 1  # at the others it has just changed, or is about to
    np.testing.assert_array_equal(result["k"][between], value(result["time"][between]))
