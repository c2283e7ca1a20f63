"""rumoca reads the files that a class needs, of a library; what it makes of them is what it makes of all."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest
import rumoca

from fmu_build.frontend import rumoca_process
from fmu_build.frontend.loading import load
from fmu_build.frontend.needed_files import needed_files, packages
from fmu_build.frontend.source_tree import copy_of_needed, whole_tree
from tests import standard_library

ROOT = Path(__file__).parents[3]
DECAY = "  Real x(start=1, fixed=true);\nequation\n  der(x) = -x;\n"
# A library, a file a class, with a class that nothing names, as broken as can be, in each package.
LIBRARY = {
    "Big/package.mo": "package Big\nend Big;\n",
    "Big/Broken.mo": "within Big;\nmodel Broken = Nowhere.Else;\n",
    "Big/Parts/package.mo": "within Big;\npackage Parts\n  constant Real c = 2;\nend Parts;\n",
    "Big/Parts/Broken.mo": "within Big.Parts;\nmodel Broken\n  Unheard.Of u;\nend Broken;\n",
    "Big/Parts/Base.mo": f"within Big.Parts;\npartial model Base\n{DECAY}end Base;\n",
    "Big/Parts/Fast.mo": "within Big.Parts;\nmodel Fast\n  extends Base;\n  Real y = twice(x);\nend Fast;\n",
    "Big/Parts/twice.mo": (
        "within Big.Parts;\nfunction twice\n  input Real u;\n  output Real y;\nalgorithm\n  y := Hidden.factor*u;\n"
        "  annotation(derivative=twice_der);\nend twice;\n"
    ),
    "Big/Parts/twice_der.mo": (
        "within Big.Parts;\nfunction twice_der\n  input Real u;\n  input Real du;\n  output Real dy;\nalgorithm\n"
        "  dy := Hidden.factor*du;\nend twice_der;\n"
    ),
    "Big/Parts/Hidden.mo": "within Big.Parts;\npackage Hidden\n  constant Real factor = 2;\nend Hidden;\n",
    "Big/Parts/Holder.mo": (
        "within Big.Parts;\nmodel Holder\n  replaceable model Inside = Base;\n  Inside inside;\nend Holder;\n"
    ),
    "Big/Other/package.mo": "within Big;\npackage Other\n  extends Big.Parts;\nend Other;\n",
    "Big/Other/Road.mo": "within Big.Other;\nmodel Road\n  parameter Real slope = 0.1;\nend Road;\n",
    "Big/Other/Body.mo": (
        f"within Big.Other;\nmodel Body\n  outer Road road;\n  Real s = road.slope;\n{DECAY}end Body;\n"
    ),
    "../alone/Single.mo": (
        f"package Single\n  model A\n{DECAY}  end A;\n  model B\n    Unheard.Of u;\n  end B;\nend Single;\n"
    ),
}
# What a model may say, and the files that it needs beside the packages.
USES = {
    "Big.Parts.Fast p;": "Base Fast Hidden twice twice_der",
    "import Big.Parts.Fast; Fast p;": "Base Fast Hidden twice twice_der",
    "import Q = Big.Parts; Q.Fast p;": "Base Fast Hidden twice twice_der",
    "import Big.Parts.*; Fast p;": "Base Fast Hidden twice twice_der",
    "import Big.Parts.{Base, Hidden}; extends Base; Real z = Hidden.factor;": "Base Hidden",
    "Big.Other.Fast p;": "Base Fast Hidden twice twice_der",  # inherited
    "package Mine = Big.Other; Mine.Fast p;": "Base Fast Hidden twice twice_der",
    "Big.Parts.Holder h;": "Base Holder",
    "Big.Parts.Holder h(redeclare model Inside = Big.Parts.Fast);": "Base Fast Hidden Holder twice twice_der",
    "inner Big.Other.Road road; Big.Other.Body b;": "Body Road",
    "parameter Real k = Big.Parts.c;": "",
    "Real z = Big.Parts.twice(time);": "Hidden twice twice_der",
    "Single.A a;": "Single",
    'Real z = 1 "Big.Parts.Fast"; // Big.Parts.Fast': "",
}

OURS = ("Examples.Figure8", "Validation.SteadyBraking", "Validation.Wheel")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for name, text in LIBRARY.items():
        path = tmp_path / "libraries" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return tmp_path


def without_numbers(tree: Any, names: Mapping[int, str]) -> Any:
    """A flat model with names of files in place of their numbers. Flow sums bear the place of any one of the pins."""
    if isinstance(tree, list):
        return [without_numbers(item, names) for item in tree]
    if not isinstance(tree, dict):
        return tree
    summed = isinstance(tree.get("origin"), dict) and next(iter(tree["origin"])) in {"Connection", "FlowSum"}
    items = {key: item for key, item in tree.items() if not (summed and key in {"span", "residual"})}
    return {key: names[item] if key == "source" else without_numbers(item, names) for key, item in items.items()}


def flat(entry: Path, class_name: str, libraries: list[Path], folder: Path, *, whole: bool) -> Any:
    """What rumoca makes of a class, from all files or from those that are needed."""
    tree = whole_tree(entry, [str(path) for path in libraries])
    if not whole:
        tree = copy_of_needed(tree, class_name, folder)
    model, files = rumoca_process._compiled(tree, class_name)
    return without_numbers(json.loads(model.to_json("flat")), {number: name for number, name, _ in files})


@pytest.mark.parametrize("said", USES)
def test_as_from_the_whole_library(said: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(folder / "cache"))
    monkeypatch.setenv("MODELICAPATH", "")
    path = folder / "M.mo"
    path.write_text(f"model M\n  {said}\nend M;\n", encoding="utf-8")
    libraries = [folder / "libraries", folder / "alone"]
    ours = outcome(lambda: flat(path, "M", libraries, folder / "copy", whole=False))
    assert ours == outcome(lambda: flat(path, "M", libraries, folder, whole=True))
    assert isinstance(ours, dict) or "Big.Other" in said, ours  # what is inherited rumoca does not find in any way
    found = needed_files([path, *(top for library in libraries for top in packages(library))], "M") - {path}
    assert {file.stem for file in found} - {"package"} == set(USES[said].split())


@pytest.mark.parametrize("way", ["library", "path", "both"])
def test_wherever_libraries_are_named(way: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Names in messages are those of the originals, relative ones too; nothing is left in the user's cache."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(folder / "cache"))
    monkeypatch.setenv("MODELICAPATH", "" if way == "library" else str(folder / "libraries"))
    (folder / "M.mo").write_text("model M\n  Big.Parts.Fast p;\nend M;\n", encoding="utf-8")
    monkeypatch.chdir(folder)
    given = [] if way == "path" else [Path("libraries")]
    _, sources = load(Path("M.mo"), "M", given)
    names = {name for name, _ in sources._files.values()}
    assert "M.mo" in names and {Path(name).name for name in names} >= {"Fast.mo", "twice.mo"}
    assert all(Path(name).exists() for name in names)
    assert not (folder / "cache").exists()


def test_a_library_behind_a_link(folder: Path) -> None:
    """It is found there; links that lead in circles are not followed."""
    (folder / "links").mkdir()
    (folder / "links" / "Big").symlink_to(folder / "libraries" / "Big")
    (folder / "links" / "round").symlink_to(folder / "links")
    (folder / "M.mo").write_text("model M\n  Big.Parts.Fast p;\nend M;\n", encoding="utf-8")
    _, sources = load(folder / "M.mo", "M", [folder / "links"])
    names = {name for name, _ in sources._files.values()}
    assert str(folder / "links" / "Big" / "Parts" / "Fast.mo") in names and len(names) < len(LIBRARY)


def test_files_that_are_not_called_like_their_classes(folder: Path) -> None:
    """Only the whole library has them."""
    odd = folder / "libraries" / "Big" / "Parts" / "Fast.mo"
    odd.rename(odd.with_name("Quick.mo"))
    (folder / "M.mo").write_text("model M\n  Big.Parts.Fast p;\nend M;\n", encoding="utf-8")
    found, sources = load(folder / "M.mo", "M", [folder / "libraries"])
    assert "p.y" in found["variables"] and len(sources.texts_by_number()) == len(LIBRARY)  # with M, without Single


def test_operators_and_external_objects_are_called_without_their_names(tmp_path: Path) -> None:
    (tmp_path / "L").mkdir()
    (tmp_path / "L" / "package.mo").write_text("package L\nend L;\n", encoding="utf-8")
    for name in ("Sum", "Start", "Rest"):
        (tmp_path / "L" / f"{name}.mo").write_text(f"within L;\nfunction {name}\nend {name};\n", encoding="utf-8")
    (tmp_path / "L" / "N.mo").write_text(
        "within L;\noperator record N\n  encapsulated operator '+'\n    function add\n    algorithm\n      Sum();\n"
        "    end add;\n  end '+';\nend N;\n",
        encoding="utf-8",
    )
    (tmp_path / "L" / "E.mo").write_text(
        "within L;\nclass E\n  extends ExternalObject;\n  function constructor\n  algorithm\n    Start();\n"
        "  end constructor;\nend E;\n",
        encoding="utf-8",
    )
    (tmp_path / "M.mo").write_text("model M\n  L.N n;\n  L.E e;\nend M;\n", encoding="utf-8")
    found = {file.stem for file in needed_files([tmp_path / "M.mo", tmp_path / "L"], "M")}
    assert found == {"M", "package", "N", "E", "Sum", "Start"}


@pytest.mark.parametrize("name", ["Systems.CarTrailer", *(pytest.param(n, marks=pytest.mark.full) for n in OURS)])
def test_our_own_library(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setenv("MODELICAPATH", "")
    entry = ROOT / "modelica" / "OverrunHitch" / "package.mo"
    ours = [flat(entry, f"OverrunHitch.{name}", [], tmp_path / "copy", whole=whole) for whole in (False, True)]
    assert ours[0] == ours[1]


@pytest.mark.full
@standard_library.needed
def test_the_standard_library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A dozen of its examples; what rumoca refuses, it refuses in the same words."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    named = os.environ["MODELICAPATH"]
    session = rumoca.Session()
    entry = standard_library.FOLDER / "package.mo"
    for number, name in enumerate(EXAMPLES.split()):
        class_name = f"Modelica.{name}"
        monkeypatch.setenv("MODELICAPATH", named)
        whole = outcome(lambda: session.load(str(entry), model=class_name))  # noqa: B023 - called at once
        ours = outcome(lambda: flat(entry, class_name, [], tmp_path / str(number), whole=False))  # noqa: B023
        assert ours == whole, name


def outcome(make: Callable[[], Any]) -> Any:
    """A flat model, or the first line of an error."""
    try:
        made = make()
    except rumoca.RumocaError as error:
        return str(error).splitlines()[0]
    if not isinstance(made, rumoca.Model):
        return made
    files = {number: name for number, name, _ in made.to_dict("dae")["source_map"]["files"]}
    return without_numbers(json.loads(made.to_json("flat")), files)


EXAMPLES = """
Blocks.Examples.PID_Controller Blocks.Examples.Filter Mechanics.Translational.Examples.SignConvention
Mechanics.Translational.Examples.Brake Mechanics.Rotational.Examples.First Mechanics.Rotational.Examples.CoupledClutches
Mechanics.MultiBody.Examples.Elementary.DoublePendulum Electrical.Analog.Examples.CauerLowPassAnalog
Electrical.Analog.Examples.OpAmps.Comparator Thermal.HeatTransfer.Examples.TwoMasses
Clocked.Examples.Elementary.RealSignals.Sample1 Magnetic.FluxTubes.Examples.BasicExamples.ToroidalCoreAirgap
"""
