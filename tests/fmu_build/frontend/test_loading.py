"""Files in folders with other files."""

from __future__ import annotations

from pathlib import Path

import pytest

from fmu_build.errors import BuildError
from fmu_build.frontend.flatten import flatten

MODEL = """connector Pin
  Real {0};
end Pin;
model {1}
  Pin p;
  {2} x(start=1);
equation
  p.{0} = 1;
  der(x) = -x;
"""


def write(folder: Path, name: str, potential: str, kind: str, end: str = "end {};\n") -> Path:
    path = folder / f"{name}.mo"
    path.write_text(MODEL.format(potential, name, kind) + end.format(name), encoding="utf-8")
    return path


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "Types.mo").write_text(
        'package Types\n  type Voltage = Real(unit="V");\nend Types;\n', encoding="utf-8"
    )
    return tmp_path


def test_a_file_that_needs_the_one_beside_it(folder: Path) -> None:
    model = flatten(write(folder, "One", "v", "Types.Voltage"), "One")
    assert {v.name: v.unit for v in model.variables} == {"p.v": "", "x": "V"}
    assert {v.origin for v in model.variables} == {"One.mo:2", "One.mo:6"}


def test_unrelated_files_with_classes_of_the_same_name(folder: Path) -> None:
    write(folder, "Other", "u", "Real")
    model = flatten(write(folder, "One", "v", "Real"), "One")
    assert [v.name for v in model.variables] == ["p.v", "x"]


@pytest.mark.parametrize(
    ("kind", "end", "message"),
    [("Nothing", "end {};\n", "One.mo:6: .*'Nothing'"), ("Real", "  y = ;\nend {};\n", "One.mo:10: unexpected")],
)
def test_the_error_is_that_of_the_file_itself(kind: str, end: str, message: str, folder: Path) -> None:
    write(folder, "Other", "u", "Real")
    path = write(folder, "One", "v", kind, end)
    with pytest.raises(BuildError, match=f"^{path.parent}/{message}"):
        flatten(path, "One")
