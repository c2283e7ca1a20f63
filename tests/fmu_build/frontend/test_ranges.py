"""Iterators whose ranges their subscripts tell: the same as with these ranges written out."""

from __future__ import annotations

import re

import pytest

from fmu_build.errors import BuildError
from fmu_build.frontend.flatten import flatten
from fmu_build.frontend.rewriting.ranges import with_ranges
from tests.fmu_build.conftest import Writer

# What we write, between << and >>, may be left out.
WRITTEN = """model M
  model Cell Real v[2]; end Cell;
  parameter Real a[3] = {1, 2, 3};
  Real x[3, 2], y[3](each start=1, each fixed=true), z, w[2, 3], 'an x'[3];
  Cell cells[3];
equation
  for i<< in 1:size(x, 1)>>, j<< in 1:size(x, 2)>> loop
    x[i, j] = i*time + j "for i loop x[i] in a text";
  end for; // for i loop
  for i<< in 1:size(y, 1)>> loop
    der(y[i]) = -a[i]*y[i];
  end for;
  for k in 1:2 loop for i<< in 1:size(cells, 1)>> loop cells[i].v[k] = k*time; end for; end for;
  z = sum(x[i, 1 + 1]*cells[1].v[j] for i<< in 1:size(x, 1)>>, j in 1:2) + max(a[i] for i<< in 1:size(a, 1)>>);
  w = {{x[i, j] + a[i] for i<< in 1:size(x, 1)>>} for j in 1:2};
  for i<< in 1:size('an x', 1)>> loop 'an x'[i] = i; end for;
end M;
"""


def test_what_subscripts_tell_need_not_be_written(modelica_file: Writer) -> None:
    short, long = re.sub("<<.*?>>", "", WRITTEN), re.sub("<<|>>", "", WRITTEN)
    assert with_ranges(long) == long
    assert with_ranges(short) == long
    assert flatten(modelica_file(short), "M") == flatten(modelica_file(long), "M")


def test_an_iterator_that_is_no_subscript_is_refused_with_its_place(modelica_file: Writer) -> None:
    text = "model M\n  Real x[3];\nequation\n  for i loop\n    x[i + 1] = i;\n  end for;\nend M;\n"
    with pytest.raises(BuildError, match=r"M\.mo:4: .*require an explicit range"):
        flatten(modelica_file(text), "M")
