"""``inner`` and ``outer``: parameters and discrete variables reach as deep as they should, others are refused."""

from __future__ import annotations

import fmpy
import numpy as np
import pytest

from fmu_build.errors import BuildError
from fmu_build.frontend.flatten import flatten
from tests.fmu_build.conftest import Build, Writer
from tests.sampling import sampled

LEAF = "model Leaf\n  outer {0} k;\n  Real x(start=0, fixed=true);\nequation\n  der(x) = k;\nend Leaf;\n"
MIDDLE = 'model Middle "an outer one; says nothing"\n  {0};\n  Leaf leaf;\n{1}end Middle;\n'
TOP = "model M\n  {0};\n  Middle middle;\n  Leaf leaf;\n{1}end M;\n"

# Declarations in the middle and on top, what determines them, and the slopes of the two x.
CASES = {
    "passed on": ("parameter Real", "inner outer parameter Real k", "", "inner parameter Real k = 4", "", (4, 4)),
    "hidden": ("parameter Real", "inner parameter Real k = 3", "", "inner parameter Real k = 4", "", (3, 4)),
    "not mentioned": ("parameter Real", "parameter Real j = 2", "", "inner parameter Real k = 4", "", (4, 4)),
    "a constant": ("constant Real", "Real j = 1", "", "inner constant Real k = 4", "", (4, 4)),
    "a constant, hidden": ("constant Real", "inner constant Real k = 3", "", "inner constant Real k = 4", "", (3, 4)),
    "a constant, passed on": (
        "constant Real",
        "inner outer constant Real k",
        "",
        "inner constant Real k = 4",
        "",
        (4, 4),
    ),
    "an Integer": ("Integer", "Real j = 1", "", "inner Integer k", "equation\n  k = integer(time) + 2;\n", (2, 2)),
    "an Integer, hidden": (
        "Integer",
        "inner Integer k",
        "equation\n  k = integer(time) + 5;\n",
        "inner Integer k",
        "equation\n  k = integer(time) + 2;\n",
        (5, 2),
    ),
}


@pytest.mark.parametrize("case", sampled(CASES, {"passed on", "a constant, passed on", "an Integer, hidden"}))
def test_the_nearest_inner_one_counts(case: str, built: Build) -> None:
    kind, middle, gives, top, gives_top, slopes = CASES[case]
    text = LEAF.format(kind) + MIDDLE.format(middle, gives) + TOP.format(top, gives_top)
    result = fmpy.simulate_fmu(str(built(text, 2)), stop_time=0.5, output=["middle.leaf.x", "leaf.x"])
    np.testing.assert_allclose([result["middle.leaf.x"][-1], result["leaf.x"][-1]], 0.5 * np.array(slopes), rtol=1e-6)


def test_what_rumoca_does_not_connect_is_refused_with_its_place(modelica_file: Writer) -> None:
    text = LEAF.format("Real") + TOP.replace("  Middle middle;\n", "").format("inner Real k = time", "")
    with pytest.raises(BuildError, match=r"M.mo:2: unbalanced model.*`outer k` for parameters and discrete variables"):
        flatten(modelica_file(text), "M")
