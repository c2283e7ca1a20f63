"""``--show STAGE``: every variable, equation and assignment of a stage's value is in its text."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

from fmu_build.equations.derive import derive
from fmu_build.equations.initialize import initialize
from fmu_build.equations.jacobian import differentiate
from fmu_build.equations.lower import lower
from fmu_build.equations.sort import sort
from fmu_build.frontend.flatten import flatten
from fmu_build.ir.equations import Loop
from fmu_build.ir.models import Partials, SortedModel
from fmu_build.ir.symbols import partial_name
from fmu_build.pipeline import show
from tests.fmu_build.conftest import Build, Writer
from tests.fmu_build.frontend.test_errors import run_command
from tests.sampling import sampled

EVENTS = """model M "Balls"
  parameter Real e = 0.8;
  Real h(start=1, fixed=true), v(start=0, fixed=true), p, q(start=1), floor = integer(3*h);
  Integer bounces(start=0, fixed=true), up, ticks(start=0);
  Boolean high = h > 0.5;
equation
  der(h) = v;
  der(v) = -9.81 + 0*p;
  p + q = h;
  p - exp(q) = v;
  up = if high then 1 else 2;
  when h < 0 then
    reinit(v, -e*pre(v));
    bounces = pre(bounces) + 1;
  elsewhen time > 2 then
    bounces = 0;
  end when;
  assert(h < 10, "too high");
algorithm
  when sample(0.5, 1) then
    if high then
      ticks := pre(ticks) + 1;
    end if;
  end when;
end M;
"""
CLASSES = ("Examples.Figure8", "Systems.Trailer", "M")


@pytest.fixture
def place(modelica_library: Path, modelica_file: Writer) -> Callable[[str], tuple[Path, str]]:
    """File or folder, and the full name of a class."""
    return lambda name: (modelica_file(EVENTS), name) if name == "M" else (modelica_library, f"OverrunHitch.{name}")


def sorted_(path: Path, name: str) -> SortedModel:
    return sort(initialize(derive(lower(flatten(path, name)))))


@pytest.mark.parametrize("name", sampled(CLASSES, CLASSES[1:]))
def test_flat_has_every_variable_and_every_equation(name: str, place: Callable[[str], tuple[Path, str]]) -> None:
    model, text = flatten(*place(name)), show(*place(name), "flat")
    declared = re.findall(
        r"^  (?:\w+ )*\w[\w.]* (\S+?)(?:\(.*)?(?: = .*)?(?: \".*\")?   // .*:\d+$", text, re.MULTILINE
    )
    assert [n for n in declared if n in {v.name for v in model.variables}] == [v.name for v in model.variables]
    assert text.count("\n  0 = ") == len(model.equations) + len(model.initial_equations)
    assert all(
        f"// {equation.origin}" in text and relation.text in text
        for equation in model.equations
        for relation in model.relations
    )


@pytest.mark.parametrize("name", sampled(CLASSES, CLASSES[1:]))
def test_sorted_has_every_assignment_in_order(name: str, place: Callable[[str], tuple[Path, str]]) -> None:
    model, text = sorted_(*place(name)), show(*place(name), "sorted")
    section = text.partition("\nat any time\n")[2].partition("\n\n")[0]
    found = re.findall(r"^  (\S+) :=", section, re.MULTILINE)
    assert found == [block.target for block in model.assignments if not isinstance(block, Loop)]
    states = text.partition("\nstates\n")[2].partition("\n\n")[0].splitlines()
    assert [re.split(r" = |,", line.strip())[0] for line in states] == list(model.states)
    for loop in (block for block in model.assignments if isinstance(block, Loop)):
        assert f"{', '.join(loop.iterated)} such that" in text
        assert all(f"    {a.target} := " in text for a in loop.explicit)


@pytest.mark.parametrize("name", sampled(CLASSES, CLASSES[1:]))
def test_jacobian_has_every_partial_derivative(name: str, place: Callable[[str], tuple[Path, str]]) -> None:
    model = sorted_(*place(name))
    jacobian, text = differentiate(model), show(*place(name), "jacobian")
    lines = {line.strip().partition(" = ")[0] for line in text.splitlines()}
    simple = [p for p in jacobian.partials if isinstance(p, Partials)]
    assert {partial_name(p.target, argument) for p in simple for argument, _ in p.by_argument} <= lines
    assert {partial_name(model.derivatives[i], model.states[j]) for i, j in jacobian.entries} <= lines


def test_events_are_told_as_the_model_tells_them(place: Callable[[str], tuple[Path, str]]) -> None:
    flat, model = show(*place("M"), "flat"), show(*place("M"), "sorted")
    for text in (
        "when ",
        "reinit(v, -e*pre(v))",
        "bounces := pre(bounces) + 1",
        "sample(0.5, 1)",
        "too high",
        "ticks :=",
    ):
        assert text in flat
    assert "fires{1} := (if" in model and "at events\n" in model and "to be checked\n" in model
    assert "v := reinit{1}.value where reinit{1}.active" in model


def test_c_is_that_of_the_fmu(place: Callable[[str], tuple[Path, str]], built: Build) -> None:
    with zipfile.ZipFile(built(EVENTS, 2)) as fmu:
        assert show(*place("M"), "c").encode() == fmu.read("sources/model.c")


@pytest.mark.full
def test_the_command_prints_and_writes_nothing(place: Callable[[str], tuple[Path, str]], tmp_path: Path) -> None:
    path, name = place("M")
    result = run_command(str(path), name, "--show", "sorted")
    assert (result.returncode, result.stderr, result.stdout) == (0, "", show(path, name, "sorted"))
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--show", "all"), ("flat", "sorted", "jacobian", "'c'")),
        pytest.param((), ("-o OUT.fmu", "--show STAGE"), marks=pytest.mark.full),
        (("--show", "flat", "-o", "M.fmu"), ("-o OUT.fmu", "--show STAGE")),
    ],
)
def test_a_stage_or_an_fmu(options: tuple[str, ...], said: tuple[str, ...], modelica_file: Writer) -> None:
    result = run_command(str(modelica_file(EVENTS)), "M", *options)
    assert (result.returncode, result.stdout, result.stderr.count("\n")) == (2, "", 1)
    assert all(word in result.stderr for word in said)
