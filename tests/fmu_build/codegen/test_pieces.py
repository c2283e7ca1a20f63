"""Long functions of generated C are cut into pieces: the numbers stay the same, to the bit."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from fmu_build.codegen import model as printing
from fmu_build.codegen import text as pieces
from fmu_build.ir.models import SortedModel
from tests.fmu_build.conftest import CompiledModel
from tests.sampling import sampled

WITH_LOOPS = """
model M
  parameter Real k = 2;
  parameter Real k_2 = k^2;
  parameter Real k_3 = 3*k_2;
  input Real u(start=0.3);
  Real x(start=k/4, fixed=true);
  Real y(start=k_2/3, fixed=true);
  Real a, b, c, f, p, q, r;
equation
  der(x) = a - x*b + p;
  der(y) = f + sin(time)*x + q*u;
  k*a + exp(b) = 3 + x;
  b = c*y - a;
  c = time + a^3/5;
  f = if c > 0 then a*b else -a*b;
  p + k*q = x;
  p - q*y = u;
  r = x^2*p;
end M;"""

STRAIGHT = """
model M
  parameter Real k = 2;
  Real x[4](start={k, k/2, 1, 0}, each fixed=true);
  Real y[4];
equation
  for i in 1:4 loop
    y[i] = if x[i] > 0.3 then sin(k*x[i]) else x[i]^2*time;
  end for;
  der(x[1]) = y[1]*y[2] - exp(-y[3]);
  der(x[2]) = y[2]/(1 + y[4]^2);
  der(x[3]) = y[3] - x[3]*y[1];
  der(x[4]) = time*y[4] + y[1];
end M;"""


def all_numbers(model: CompiledModel) -> list[float]:
    """What every function of the model computes at one point, by each seed."""
    model["time"] = 0.4
    model.outputs()
    numbers = [*model.at, *model.relations(), *model.derivatives(), *model.jacobian().flat]
    for name in model.references:
        for chain in (model.tangent, model.adjoint):
            for at_start in (False, True):
                numbers += chain({name: 1.0}, at_start).values()
    return numbers


@pytest.mark.parametrize("text", sampled([WITH_LOOPS, STRAIGHT], {WITH_LOOPS}))
def test_pieces_compute_the_same(
    text: str, sorted_model: Callable[[str], SortedModel], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sorted_ = sorted_model(text)
    folders = {size: tmp_path / str(size) for size in (pieces.LONGEST_FUNCTION, 1, 3)}
    results = {}
    for size, folder in folders.items():
        folder.mkdir()
        for module in (printing, pieces):
            monkeypatch.setattr(module, "LONGEST_FUNCTION", size)
            monkeypatch.setattr(module, "PIECE", size)
        results[size] = all_numbers(CompiledModel(sorted_, folder))
    whole, *others = results.values()
    for other in others:
        np.testing.assert_array_equal(other, whole)
    cut = re.findall(r"^NOT_INLINED static void (\w+)_1\(", (folders[1] / "model.c").read_text(), re.MULTILINE)
    assert {"model_jacobian", "model_outputs", "model_tangent", "model_adjoint"} <= set(cut)
    assert "NOT_INLINED" not in (next(iter(folders.values())) / "model.c").read_text()
