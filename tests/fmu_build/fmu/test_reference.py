"""Reference results of a small model: against its closed form, and what an example must be."""

from __future__ import annotations

import io
import zipfile
from pathlib import Path

import numpy as np
import pytest

from fmu_build.errors import BuildError
from fmu_build.pipeline import build
from tests.fmu_build.conftest import Writer

UNIT = """
model M
  parameter Real rate(min=0) = 1;
  input Real u;
  output Real y;
  Real x(start=0, fixed=true);
equation
  der(x) = rate*(u - x);
  y = 2*x;
  annotation(__fmu_build(referenceExamples={"Example"}));
end M;
"""
EXAMPLE = "model Example\n  {}\nequation\n  {}\n  annotation({});\nend Example;"
EXPERIMENT = "experiment(StopTime=2, Interval=0.1)"


@pytest.mark.full
def test_a_low_pass(modelica_file: Writer, tmp_path: Path) -> None:
    build(
        modelica_file(UNIT + EXAMPLE.format("M filter(rate=3);", "filter.u = 5;", EXPERIMENT)), "M", tmp_path / "M.fmu"
    )
    with zipfile.ZipFile(tmp_path / "M.fmu") as archive:
        text = archive.read("extra/org.fmi-standard.fmi-ls-ref/Example_ref.csv").decode()
        inputs = archive.read("extra/org.fmi-standard.fmi-ls-ref/Example_in.csv").decode()
        values = archive.read("extra/org.fmi-standard.fmi-ls-ref/Example.ssv").decode()
    table = np.genfromtxt(io.StringIO(text), delimiter=",", names=True)
    assert inputs.splitlines()[:3] == ["time,u", "0,5", "0.1,5"] and len(table) == 21
    assert 'name="rate"' in values and 'value="3.0"' in values
    np.testing.assert_allclose(table["y"], 10.0 * (1.0 - np.exp(-3.0 * table["time"])), atol=1e-9)


@pytest.mark.parametrize(
    ("example", "message"),
    [
        (EXAMPLE.format("M filter;", "filter.u = 5;", ""), "StopTime and Interval"),
        (EXAMPLE.format("Real x;", "x = time;", EXPERIMENT), "0 components"),
        (EXAMPLE.format("M a, b;", "a.u = 1; b.u = 2;", EXPERIMENT), "2 components"),
        ("", "no class Example"),
    ],
)
def test_an_example_that_is_none(modelica_file: Writer, tmp_path: Path, example: str, message: str) -> None:
    with pytest.raises(BuildError, match=message):
        build(modelica_file(UNIT + example), "M", tmp_path / "M.fmu")
    assert not (tmp_path / "M.fmu").exists()
