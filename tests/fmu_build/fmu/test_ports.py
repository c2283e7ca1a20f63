"""The annotations that say how a class is to be connected: what is read, what is generated, what is refused."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from fmu_build.codegen.model import print_c
from fmu_build.equations.derive import derive
from fmu_build.equations.jacobian import differentiate
from fmu_build.equations.sort import sort
from fmu_build.errors import BuildError
from fmu_build.fmu.ports import declare
from fmu_build.frontend.annotations import read_couplings, read_terminals
from fmu_build.frontend.flatten import flatten
from fmu_build.ir.models import Across, Coupling, Member, Ports, Terminal, Through
from fmu_build.pipeline import build
from tests.fmu_build.conftest import Writer

COUPLING = {
    "across": "u",
    "acrossDerivative": "a",
    "extrapolate": "ex",
    "through": "F",
    "impulse": "p",
    "work": "W",
    "mean": "F_mean",
    "hold": "F_hold",
    "applied": "which",
    "energy": "E",
}


def text(couplings: str, more: str = "", equations: str = "") -> str:
    return f"""model M
  input Real u(unit="m/s");
  input Real a(unit="m/s2");
  parameter Real ex(unit="1", min=0, max=1) = 1;
  parameter Real which(unit="1", min=1, max=3) = 3;
  parameter Real c(unit="N.s/m") = 2;
  Real p(unit="N.s", start=0, fixed=true);
  Real W(unit="J", start=0, fixed=true);
  Real x(unit="m", start=0, fixed=true);
  output Real F(unit="N") = c*u + x;
  output Real F_mean(unit="N") = F;
  output Real F_hold(unit="N") = F;
  output Real E(unit="J") = 0;
  {more}
equation
  der(p) = F;
  der(W) = F*u;
  der(x) = u;
  {equations}
  annotation(__fmu_build(referenceExamples={{}}{couplings}), Icon(graphics={{Text(textString="coupling(x)")}}));
end M;
"""


def coupling(**changes: str | None) -> str:
    names = {key: name for key, name in (COUPLING | changes).items() if name is not None}
    return ", coupling(" + ", ".join(f'{key}="{name}"' for key, name in names.items()) + ")"


HITCH = ', terminal(name="hitch", signal(v="u"), outflow(F="F_hold"))'


@pytest.fixture
def ports(modelica_file: Writer) -> Callable[[str], Ports]:
    def read(source: str) -> Ports:
        flat = flatten(modelica_file(source), "M")
        return declare(flat, sort(derive(flat)))

    return read


def test_what_is_read(ports: Callable[[str], Ports]) -> None:
    u, force = Across("u", "a", None, 1.0), Through("F", "p", "F_mean", "F_hold")
    expected = Coupling((u,), (force,), "ex", "W", "which", "E")
    hitch = Terminal("hitch", (Member("v", "u", "signal"), Member("F", "F_hold", "outflow")))
    assert ports(text(coupling() + HITCH)) == Ports(expected, (hitch,))
    assert ports(text("")) == Ports()
    inert = Coupling((replace(u, inertia="c", sign=-1.0),), (force,), "ex", "W", "which", "E")
    assert ports(text(coupling(across="- u", inertia="c"))) == Ports(inert)
    two = coupling(across="u, -u", acrossDerivative="a, a", through="F, F", impulse="p, p", mean="F_mean, F_hold",
                   hold="F_hold, F_mean")  # fmt: skip
    both = (force, Through("F", "p", "F_hold", "F_mean"))
    assert ports(text(two)) == Ports(Coupling((u, replace(u, sign=-1.0)), both, "ex", "W", "which", "E"))


def test_only_our_own_annotation_counts() -> None:
    assert read_couplings('annotation(Icon(coupling(across="u")))') == ()
    assert read_terminals('annotation(__fmu_build(terminal(name="a)"), terminal(name="b")))') == (
        'name="a)"',
        'name="b"',
    )


def test_the_table_in_c(modelica_file: Writer) -> None:
    for source, count in ((text(""), 0), (text(coupling()), 1)):
        flat = flatten(modelica_file(source), "M")
        model = sort(derive(flat))
        files = print_c(model, differentiate(model), "M", declare(flat, model).coupling).files
        assert f"#define N_COUPLINGS {count}\n" in files["variables.h"]
        assert ("coupling_info" in files["model.c"]) == bool(count)
    assert "N_ACROSS = 1,\n    N_THROUGH = 1" in files["variables.h"]
    table = files["model.c"].partition("coupling_info = {\n")[2].partition("\n};")[0].splitlines()
    u, a = (model.value_references[name] for name in "ua")
    assert table[1].split() == f"{{.input = {u} /* u */, .derivative = {a} /* a */, .sign = 1.0}}}},".split()
    assert [line.split()[0] for line in table if not line.startswith("        ")] == [
        ".across", ".through", ".extrapolate", ".work", ".applied", ".energy",
    ]  # fmt: skip


REFUSED = {
    "no such variable": (coupling(through="nope"), "there is no variable nope"),
    "not an input": (coupling(across="F"), "across = F: this is of kind output, needed is input"),
    "not a state": (coupling(impulse="F"), "impulse = F: this is of kind output, needed is state"),
    "not an output": (coupling(mean="p"), "mean = p: this is of kind state, needed is output"),
    "not a parameter": (coupling(applied="a"), "applied = a: this is of kind input, needed is parameter"),
    "unknown key": (coupling(speed="u"), "speed is not one of across, acrossDerivative"),
    "missing key": (coupling(work=None), 'work="..." is missing'),
    "one derivative for two": (coupling(across="u, -u"), "acrossDerivative names 1 variables, needed are 2"),
    "two works": (coupling(work="W, W"), "work names 2 variables, needed are 1"),
    "no inertia": (coupling(inertia="x"), "inertia = x: this is of kind state, needed is parameter"),
    "no string": (", coupling(across=u)", "across=u"),
    "two couplings": (coupling() + coupling(), "only one"),
    "terminal without a name": (', terminal(signal(v="u"))', 'needs a name="..."'),
    "terminal without members": (', terminal(name="hitch")', "needs"),
    "terminal of nothing": (', terminal(name="hitch", signal(v="nope"))', "there is no variable nope"),
    "terminal of another kind": (', terminal(name="hitch", flow_(v="u"))', "one of signal, inflow, outflow"),
    "two terminals of one name": (HITCH + HITCH, "two terminal annotations have the name hitch"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_refused(case: str, modelica_file: Writer, tmp_path: Path) -> None:
    annotation, message = REFUSED[case]
    with pytest.raises(BuildError) as caught:
        build(modelica_file(text(annotation)), "M", tmp_path / "out" / "M.fmu")
    assert message in str(caught.value) and str(caught.value).startswith("M: ") and "\n" not in str(caught.value)
    assert not (tmp_path / "out").exists()


def test_nothing_may_depend_on_what_is_replaced(ports: Callable[[str], Ports]) -> None:
    with pytest.raises(BuildError, match=r"twice depends on E \(M.mo:\d+\)"):
        ports(text(coupling(), more='output Real twice(unit="J") = 2*E;'))
    ports(text(coupling(), more='output Real twice(unit="N") = 2*F_mean;'))  # by another name of F itself: no harm
