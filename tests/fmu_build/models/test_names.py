"""Variables that are called what fmu_build might call its own, and what C does not allow."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from tests.fmu_build.cases import Case, Columns, check
from tests.fmu_build.conftest import Build

TAKEN = """
model Taken
  Real relation[2](each start=0, each fixed=true);
  Real holds[3](each start=0, each fixed=true);
  Real fires[1](each start=0, each fixed=true);
  Real sample[2](each start=0, each fixed=true);
  Real check[1](each start=0, each fixed=true);
  Real floor[1](each start=0, each fixed=true);
  Real time_event[1](each start=0, each fixed=true);
  Real 'pre(n)'(start=3, fixed=true), 'holds[1]', '*/', '1+1', '+';
  Integer n(start=0, fixed=true), cells;
equation
  der(relation[1]) = if holds[2] > 0.5 then 1 else 0;
  der(relation[2]) = if time >= 0.75 then 1 else 0;
  for i in 1:3 loop
    der(holds[i]) = 1;
  end for;
  der(fires[1]) = 2;
  der(sample[1]) = 3;
  der(sample[2]) = 4;
  der(check[1]) = 5;
  der(floor[1]) = 6;
  der(time_event[1]) = 7;
  der('pre(n)') = -'+';
  'holds[1]' = if holds[1] > 0.3 then 1 else -1;
  '*/' = 'pre(n)'/2;
  '1+1' = 2*'*/';
  '+' = '1+1';
  cells = integer(floor[1]);
  when sample(0.25, 0.5) then
    n = pre(n) + 1;
  end when;
  assert(check[1] < 10, "far");
end Taken;
"""


def taken(t: NDArray[np.float64]) -> Columns:
    return {
        "relation[1]": np.maximum(t - 0.5, 0),
        "relation[2]": np.maximum(t - 0.75, 0),
        "holds[3]": t,
        "fires[1]": 2 * t,
        "sample[2]": 4 * t,
        "check[1]": 5 * t,
        "floor[1]": 6 * t,
        "time_event[1]": 7 * t,
        "'pre(n)'": 3 * np.exp(-t),
        "'holds[1]'": np.where(t > 0.3, 1.0, -1.0),
        "n": np.floor(2 * t + 0.5),
        "cells": np.floor(6 * t),
    }


@pytest.mark.parametrize("fmi", [2, 3])
def test_names_of_ours_are_free_for_models(fmi: int, built: Build) -> None:
    check(Case(TAKEN, 0.97, taken), fmi, built)
