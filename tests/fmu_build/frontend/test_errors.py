"""Modelica that does not compile or is not supported: one line with file and line."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from fmu_build.errors import BuildError
from fmu_build.pipeline import build
from tests.fmu_build.conftest import Writer

BROKEN = {
    "syntax": ("model M\n  Real x\nequation\n  x = 1;\nend M;", "M.mo:2", "unexpected"),
    "unknown variable": ("model M\n  Real x;\nequation\n  x = nope;\nend M;", "M.mo:4", "nope"),
    "unknown type": ("model M\n  Foo x;\nequation\n  x = 1;\nend M;", "M.mo:2", "Foo"),
    "unknown modifier": ("model M\n  Real x(nope=3);\nequation\n  x = 1;\nend M;", "M.mo:2", "nope"),
    "unbalanced": ("model M\n  Real x;\n  Real y;\nequation\n  x = 1;\nend M;", "M.mo", "unbalanced"),
    "no such class": ("model Other\n  Real x = 1;\nend Other;", "M.mo", "no class M"),
    "der of an expression in a loop": (
        "model M\n  Real x[2];\nequation\n  for i in 1:2 loop\n    der(i*x[i]) = 1;\n  end for;\nend M;",
        "M.mo:5",
        "der",
    ),
    "reinit of no state": (
        "model M\n  Real x(start=1), y;\nequation\n  der(x)=1;\n  y=2*x;\n  when x>2 then\n    reinit(y,0);\n"
        "  end when;\nend M;",
        "M.mo:2",
        "y is not a state",
    ),
    "two reinits of one state": (
        "model M\n  Real x(start=1), y(start=1);\nequation\n  der(x)=1;\n  der(y)=1;\n  when y>3 then\n"
        "    reinit(y,0);\n  end when;\n  when x>2 then\n    reinit(x,0);\n  end when;\n"
        "  when x>3 then\n    reinit(x, 1);\n  end when;\n"
        "end M;",
        "M.mo:10",
        "branches of one, by elsewhen",
    ),
    "two when-clauses": (
        "model M\n  Integer n(start=0);\nequation\n  when time>2 then\n    n=1;\n  end when;\n  when time>3 then\n"
        "    n=2;\n  end when;\nend M;",
        "M.mo:2",
        "more than one",
    ),
    "delay": ("model M\n  Real y = delay(time, 0.1);\nend M;", "M.mo:2", "Delay"),
    "derivative of an input": ("model M\n  input Real u;\n  Real v=der(x), x=u;\nend M;", "M.mo:3", "input u"),
    "external function": (
        'model M\n  function f\n    input Real u;\n    output Real y;\n    external "C" y = g(u);\n  end f;\n'
        "  Real x = f(time);\nend M;",
        "M.mo:",
        "write its algorithm in Modelica",
    ),
    "discrete variable without an equation": (
        "model M\n  Boolean b;\n  Integer n(start=0);\nequation\n  when b then\n    n = pre(n) + 1;\n"
        "  end when;\nend M;",
        "M.mo:2",
        "no equation determines b",
    ),
    "edge of an expression": (
        "model M\n  Boolean b;\n  Integer n(start=0);\nequation\n  b = time>1;\n  when edge(not b) then\n    n=1;\n"
        "  end when;\nend M;",
        "M.mo:6",
        "edge",
    ),
    "too many initial equations": (
        "model M\n  Real x(start=1, fixed=true);\ninitial equation\n  x = 2;\nequation\n  der(x) = 1;\nend M;",
        "M.mo:2",
        "more equations at the start",
    ),
    "text": ('model M\n  String s = "a";\n  Real x = time;\nend M;', "M.mo:2", "String"),
    "loop too large": (
        "model M\n  Real x(start=1, fixed=true);\n  Real u[240];\nequation\n  der(x) = -u[9];\n  u[1] = x + u[2];\n"
        "  for i in 2:239 loop\n    u[i - 1] - 3*u[i] + u[i + 1] = 0;\n  end for;\n  u[240] = u[239]/2;\nend M;",
        "M.mo:",
        "take 470 KB",  # 8*240*(240 + 4), and a column of 8*240,
    ),
    "start values that contradict a constraint": (
        "model M\n  Real x(start=0, fixed=true);\n  Real y(start=1, fixed=true);\n"
        "equation\n  der(x) + der(y) = 1;\n  x = 2*y;\nend M;",
        "M.mo:6",
        "start values contradict it",
    ),
}


@pytest.mark.parametrize("case", BROKEN)
def test_an_error_names_the_place_and_the_thing(case: str, modelica_file: Writer, tmp_path: Path) -> None:
    text, place, thing = BROKEN[case]
    with pytest.raises(BuildError) as caught:
        build(modelica_file(text), "M", tmp_path / "out" / "M.fmu")
    message = str(caught.value)
    assert place in message and thing in message
    assert "\n" not in message
    assert not (tmp_path / "out").exists()


def run_command(*arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "fmu_build", *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False, env={**os.environ, **environment})


def test_the_command_line_ends_in_status_2_and_one_line(tmp_path: Path) -> None:
    output = tmp_path / "out.fmu"
    result = run_command(str(tmp_path / "none.mo"), "M", "-o", str(output))
    assert (result.returncode, result.stderr.count("\n")) == (2, 1)
    assert "none.mo" in result.stderr and not output.exists()


@pytest.mark.full
def test_without_a_compiler(modelica_library: Path, tmp_path: Path) -> None:
    output = tmp_path / "out.fmu"
    arguments = (str(modelica_library), "OverrunHitch.Systems.CarTrailer", "-o", str(output))
    result = run_command(*arguments, CC="no-such-compiler", PATH="")
    assert (result.returncode, result.stderr.count("\n")) == (2, 1)
    assert "no C compiler" in result.stderr and list(tmp_path.iterdir()) == []


@pytest.mark.full
def test_stages_and_their_times_on_request(modelica_file: Writer, tmp_path: Path) -> None:
    source = modelica_file("model M\n  Real x(start=1, fixed=true);\nequation\n  der(x) = -x;\nend M;")
    result = run_command(str(source), "M", "-o", str(tmp_path / "M.fmu"), "--verbose", FMU_BUILD_CACHE="")
    lines = result.stderr.splitlines()
    seconds = [float(line.split()[-2]) for line in lines]
    assert result.returncode == 0 and all(line.startswith("fmu_build: ") and line.endswith(" s") for line in lines)
    assert [line.split()[1] for line in lines[:1] + lines[-1:]] == ["loading", "in"]
    assert sum(seconds[:-1]) == pytest.approx(seconds[-1], abs=0.1)


def test_an_output_that_cannot_be_written(modelica_file: Writer, tmp_path: Path) -> None:
    source = modelica_file("model M\n  Real x(start=1, fixed=true);\nequation\n  der(x) = -x;\nend M;")
    (tmp_path / "file").write_text("")
    result = run_command(str(source), "M", "-o", str(tmp_path / "file" / "M.fmu"))
    assert (result.returncode, result.stderr.count("\n")) == (2, 1)
