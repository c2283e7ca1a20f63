"""What a user of OMEdit or Dymola expects of the library: order, descriptions, units, icons, documentation."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from fmu_build.frontend.flatten import flatten
from fmu_build.ir.models import FlatModel
from tests.sampling import sampled

LIBRARY = Path(__file__).parents[2] / "modelica" / "OverrunHitch"
FILES = sorted(LIBRARY.rglob("*.mo"))
CLASSES = [file for file in FILES if file.name != "package.mo"]
FIGURES = sorted(file.stem for file in (LIBRARY / "Examples").glob("Figure*.mo"))


def relative(file: Path) -> str:
    return file.relative_to(LIBRARY).as_posix()


@pytest.mark.parametrize("folder", sorted({file.parent for file in FILES}), ids=lambda f: f.name)
def test_package_order_names_every_class_once(folder: Path) -> None:
    order = (folder / "package.order").read_text().split()
    classes = [file.stem for file in folder.glob("*.mo") if file.name != "package.mo"]
    packages = [f.name for f in folder.iterdir() if f.is_dir()]
    assert sorted(order) == sorted(classes + packages)


@pytest.mark.parametrize("file", FILES, ids=relative)
def test_within_matches_the_folder(file: Path) -> None:
    parent = file.parent.parent if file.name == "package.mo" else file.parent
    expected = ".".join(("OverrunHitch", *parent.relative_to(LIBRARY).parts)) if parent != LIBRARY.parent else ""
    assert file.read_text().splitlines()[0] == f"within {expected};"


@pytest.mark.parametrize("file", FILES, ids=relative)
def test_every_class_has_a_description_an_icon_and_documentation(file: Path) -> None:
    text = file.read_text()
    assert re.search(r'^(partial )?(package|model|connector) \w+ (= \w+ [\w.]+ )?"[^"]+"', text, re.MULTILINE)
    assert re.search(r"Documentation\(info=\"<html>\s*<p>.+</p>\s*</html>\"\)", text, re.DOTALL)
    assert "Icon(" in text or "extends StepBrake" in text
    assert max(map(len, text.splitlines())) <= 260


@pytest.fixture(scope="module")
def car_trailer() -> FlatModel:
    return flatten(LIBRARY, "OverrunHitch.Systems.CarTrailer")


def test_every_variable_has_a_unit_and_a_description(car_trailer: FlatModel) -> None:
    bare = [v.name for v in car_trailer.variables if not (v.unit and v.description)]
    assert bare == []


def test_every_quantity_of_units_has_a_unit() -> None:
    types = re.findall(r"^  type (\w+) = Real\((.*)\) \"[^\"]+\";", (LIBRARY / "Units.mo").read_text(), re.MULTILINE)
    assert len(types) == (LIBRARY / "Units.mo").read_text().count("  type ")
    assert all('final unit="' in attributes and 'final quantity="' in attributes for _, attributes in types)


@pytest.mark.parametrize("figure", sampled(FIGURES, ["8"]))
def test_examples_carry_their_experiment(figure: str) -> None:
    flat = flatten(LIBRARY, f"OverrunHitch.Examples.{figure}")
    assert (flat.experiment.start_time, flat.experiment.stop_time) == (0.0, 6.0)
    assert flat.experiment.interval == 0.01 and flat.experiment.tolerance == 1e-6


def test_there_is_an_example_for_each_simulated_figure() -> None:
    assert sorted(f"Figure{name}" for name in ("6a", "6b", "7", "8", "9", "10", "11")) == FIGURES


def test_the_library_needs_no_other() -> None:
    for file in FILES:
        code = re.sub(r'"(\\.|[^"\\])*"', '""', file.read_text())
        assert "Modelica." not in code, relative(file)
