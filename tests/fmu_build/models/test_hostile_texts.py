"""Names and texts that try to become C, XML or HTML: the unit says them, and computes what the model says."""

from __future__ import annotations

import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fmu_build.pipeline import build

SCRIPT = "<script>alert(1)</script>"
HOSTILE = f"""
package P
type E = enumeration('*/ x' "weird <b>&", b "c??/d");
model M "desc */ \\" ??/ {SCRIPT} & \\a \\\\ é"
  parameter Real 'k */ double shift; /* x' (unit="m/s") = 2 "d */ \\n line2 \\t tab ??/";
  parameter E e = E.'*/ x';
  Real 'NULL'(start=1, fixed=true), 'NAN', '1a' = 3, 'INFINITY' = 4, 'HUGE_VAL' = 5, 'errno' = 6;
  output Real y = 'NULL' + 'NAN' + '1a' + 'INFINITY' + 'HUGE_VAL' + 'errno';
equation
  der('NULL') = 'k */ double shift; /* x';
  'NAN' = 2*'NULL';
  assert('NULL' < 2.5, "too low??/ \\"quoted\\" %s %n */");
  annotation(
    __fmu_build(author="A <b> */ \\"x\\"", license="none ??/"),
    Documentation(info="<html><p onclick=\\"x()\\">hi &lt;</p>{SCRIPT}<img src=x onerror=alert(1)></html>"));
end M;
end P;
"""


@pytest.fixture(autouse=True)
def without_optimizing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CFLAGS", "-O0")


@pytest.mark.parametrize("fmi", [2, 3])
def test_what_the_unit_says_is_what_the_model_said(fmi: int, tmp_path: Path) -> None:
    folder = tmp_path / "a */ ??!" / "b'\"; é"
    folder.mkdir(parents=True)
    (folder / "p.mo").write_text(HOSTILE, encoding="utf-8")
    fmu = tmp_path / "m.fmu"
    build(folder / "p.mo", "P.M", fmu, fmi)
    description = fmpy.read_model_description(str(fmu))
    variables = {v.name: v for v in description.modelVariables}
    assert description.description == f'desc */ " ??/ {SCRIPT} & \ufffd \\ é'
    assert description.author == 'A <b> */ "x"' and description.license == "none ??/"
    assert variables["'k */ double shift; /* x'"].description.split() == ["d", "*/", "line2", "tab", "??/"]
    assert [item.name for item in description.typeDefinitions[0].items] == ["*/ x", "b"]
    with zipfile.ZipFile(fmu) as archive:
        page = archive.read("documentation/index.html").decode()
    assert "alert(1)</script>" not in page.replace("&lt;", "<").partition("</strong>")[2].lower()
    assert "onclick" not in page and "onerror" not in page and "<p>hi &lt;</p>" in page
    run = fmpy.simulate_fmu(str(fmu), stop_time=0.7, output=["y"], step_size=0.1)
    np.testing.assert_allclose(run["y"], 3 * (1 + 2 * run["time"]) + 18, rtol=1e-9)
    told: list[str] = []

    def listen(*arguments: object) -> None:
        told.append(arguments[-1].decode() if isinstance(arguments[-1], bytes) else str(arguments[-1]))

    with pytest.raises(FMICallException):
        fmpy.simulate_fmu(str(fmu), stop_time=1.0, step_size=0.1, logger=listen, debug_logging=True)
    assert any('too low??/ "quoted" %s %n */' in text for text in told)


NAMES = st.text(
    st.characters(min_codepoint=32, max_codepoint=126, exclude_characters="'\\\\"), min_size=1, max_size=12
).map(lambda text: f"'{text}'")


@settings(max_examples=3, deadline=None, suppress_health_check=list(HealthCheck))
@given(st.lists(NAMES, min_size=6, max_size=10, unique=True))
def test_any_name_is_a_name(tmp_path_factory: pytest.TempPathFactory, names: list[str]) -> None:
    folder = tmp_path_factory.mktemp("names")
    declared = "\n".join(f"  output Real {name} = {number} + time;" for number, name in enumerate(names))
    (folder / "m.mo").write_text(f"model M\n{declared}\nend M;\n")
    build(folder / "m.mo", "M", folder / "m.fmu", 2)
    found = {v.name for v in fmpy.read_model_description(str(folder / "m.fmu")).modelVariables}
    assert set(names) <= found
    run = fmpy.simulate_fmu(str(folder / "m.fmu"), stop_time=0.5, output=names, step_size=0.5)
    for number, name in enumerate(names):
        np.testing.assert_allclose(run[name], number + run["time"], rtol=1e-15)
