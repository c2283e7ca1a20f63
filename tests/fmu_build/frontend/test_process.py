"""The front end is a process of its own: its death, and its going on for ever, cost one line."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from fmu_build.errors import BuildError
from fmu_build.frontend import loading
from fmu_build.frontend.flatten import flatten

CLASS_EXTENDS = """package P
  model Base
    replaceable model Inner
      Real x(start=1, fixed=true);
    equation
      der(x) = -x;
    end Inner;
    Inner a;
  end Base;
  model M
    extends Base;
    redeclare {kind} extends Inner
      Real y = 2*x;
    end Inner;
  end M;
end P;
"""


@pytest.mark.parametrize("kind", ["model", "replaceable model"])
def test_class_extends_is_refused_with_its_place(kind: str, tmp_path: Path) -> None:
    path = tmp_path / "P.mo"
    path.write_text(CLASS_EXTENDS.format(kind=kind), encoding="utf-8")
    with pytest.raises(BuildError, match=r"P.mo:12: rumoca was ended by signal 11 .*`class extends`; write a class"):
        flatten(path, "P.M")


def test_what_does_not_end_is_ended(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "M.mo"
    path.write_text("model M\n  Real x = time;\nend M;\n", encoding="utf-8")
    monkeypatch.setattr(loading, "TIME_LIMIT", 1e-3)
    with pytest.raises(BuildError, match=r"M.mo: M: rumoca does not come to an end within 0.001 s"):
        flatten(path, "M")


def test_another_death_names_file_and_class(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A package of its name that fails stands for rumoca: the process finds modules where we do."""
    (tmp_path / "rumoca.py").write_text("raise RuntimeError('no luck')\n", encoding="utf-8")
    path = tmp_path / "M.mo"
    path.write_text("model M\n  Real x = time;\nend M;\n", encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(BuildError, match=r"M.mo: M: rumoca failed \(RuntimeError: no luck\) on it"):
        flatten(path, "M")


def test_an_error_that_leaves_no_debris(tmp_path: Path) -> None:
    path = tmp_path / "P.mo"
    path.write_text(CLASS_EXTENDS.format(kind="model"), encoding="utf-8")
    work = tmp_path / "work"
    work.mkdir()
    result = subprocess.run(
        [sys.executable, "-m", "fmu_build", str(path), "P.M", "-o", str(tmp_path / "M.fmu")],
        env={**os.environ, "TMPDIR": str(work)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode == 2 and result.stderr.count("\n") == 1
    assert list(work.iterdir()) == []


@pytest.mark.parametrize("folder", ["Parts", "."])
def test_a_library_beside_the_file(folder: str, tmp_path: Path) -> None:
    """Given as the library itself, and as the folder that it is in."""
    library = tmp_path / "libraries" / "Parts"
    library.mkdir(parents=True)
    (library / "package.mo").write_text("package Parts\nend Parts;\n", encoding="utf-8")
    (library / "Decay.mo").write_text(
        "within Parts;\nmodel Decay\n  Real x(start=1, fixed=true);\nequation\n  der(x) = -x;\nend Decay;\n",
        encoding="utf-8",
    )
    path = tmp_path / "M.mo"
    path.write_text("model M\n  Parts.Decay d;\nend M;\n", encoding="utf-8")
    model = flatten(path, "M", [tmp_path / "libraries" / folder])
    assert [v.name for v in model.variables] == ["d.x"]
    with pytest.raises(BuildError, match=r"M.mo:2: .*Parts.Decay"):
        flatten(path, "M")
    with pytest.raises(BuildError, match="nowhere: no such folder"):
        flatten(path, "M", [tmp_path / "nowhere"])
