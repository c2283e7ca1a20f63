"""The FMU file: validity, metadata, identity."""

from __future__ import annotations

import shutil
import subprocess
import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.validation import validate_fmu

from fmu_build.fmu import binaries
from fmu_build.fmu.interface import model_identifier
from fmu_build.pipeline import build
from tests.fmu_build.conftest import Build

OUTPUTS = "v_car v_trailer a_car a_trailer compression F_hitch slip_car slip_trailer trailer_brake_torque".split()


def test_fmpy_finds_nothing_to_complain_about(car_trailer_fmu: Path) -> None:
    assert validate_fmu(str(car_trailer_fmu)) == []


def test_the_names_that_users_see(car_trailer_fmu: Path) -> None:
    """Those of the parameters: tests/test_parameters.py."""
    description = fmpy.read_model_description(str(car_trailer_fmu))
    by_causality = {
        kind: [v.name for v in description.modelVariables if v.causality == kind] for kind in ("input", "output")
    }
    assert by_causality == {"input": ["brake_torque", "grade"], "output": OUTPUTS}
    assert all(len(v.name) <= 55 for v in description.modelVariables)


def test_every_variable_has_a_unit_with_base_exponents_and_a_description(car_trailer_fmu: Path) -> None:
    description = fmpy.read_model_description(str(car_trailer_fmu))
    bases = {unit.name: unit.baseUnit for unit in description.unitDefinitions}
    for variable in description.modelVariables:
        assert bases[variable.unit] is not None, variable.name
        assert variable.description, variable.name
    force = bases["N"]
    assert (force.kg, force.m, force.s, force.A) == (1, 1, -2, 0)


def test_parameters_of_start_values_alone_are_fixed_and_the_others_tunable(car_trailer_fmu: Path) -> None:
    description = fmpy.read_model_description(str(car_trailer_fmu))
    fixed = {v.name for v in description.modelVariables if v.causality == "parameter" and v.variability == "fixed"}
    assert fixed == {"V_0", "compression_start"}


def test_dependencies_are_those_of_the_equations(car_trailer_fmu: Path) -> None:
    description = fmpy.read_model_description(str(car_trailer_fmu))
    depends = {u.variable.name: {v.name for v in u.dependencies} for u in description.outputs}
    assert depends["v_car"] == {"car.body.v"}
    assert depends["slip_trailer"] == {"trailer.body.v", "trailer.wheel.omega", "trailer.tyre.u"}
    assert depends["compression"] == {"drawbar.compression"}
    assert all("brake_torque" not in names for names in depends.values())  # no direct feedthrough
    assert {name for name, names in depends.items() if "grade" in names} == {"a_car", "a_trailer"}
    rates = {u.variable.name: {v.name for v in u.dependencies} for u in description.derivatives}
    assert "brake_torque" in rates["der(car.wheel.omega)"]


@pytest.mark.full
def test_the_same_source_gives_the_same_bytes(car_trailer_fmu: Path, modelica_library: Path, tmp_path: Path) -> None:
    again = tmp_path / "again.fmu"
    build(modelica_library, "OverrunHitch.Systems.CarTrailer", again)
    assert again.read_bytes() == car_trailer_fmu.read_bytes()


@pytest.mark.full
def test_the_guid_changes_with_the_content(
    modelica_library: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("CFLAGS", "-O0")
    library = tmp_path / "OverrunHitch"
    shutil.copytree(modelica_library, library)
    drawbar = library / "Interfaces" / "PartialDrawbar.mo"
    drawbar.write_text(drawbar.read_text().replace("F_free = F_damper", "F_free = 1.0001*F_damper"))
    tokens = set()
    for folder in (modelica_library, library):
        output = tmp_path / "out.fmu"
        build(folder, "OverrunHitch.Systems.CarTrailer", output, references=False)
        tokens.add(fmpy.read_model_description(str(output)).guid)
    assert len(tokens) == 2


def test_a_failed_build_leaves_the_old_file(
    modelica_library: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    output = tmp_path / "CarTrailer.fmu"
    output.write_bytes(b"old")

    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(binaries, "compile_library", interrupted)
    with pytest.raises(KeyboardInterrupt):
        build(modelica_library, "OverrunHitch.Systems.CarTrailer", output, references=False)
    assert output.read_bytes() == b"old" and [f.name for f in tmp_path.iterdir()] == ["CarTrailer.fmu"]


@pytest.mark.skipif(shutil.which("nm") is None, reason="nm (binutils) is not installed")
def test_the_library_exports_the_standard_and_nothing_else(car_trailer_fmu: Path, tmp_path: Path) -> None:
    with zipfile.ZipFile(car_trailer_fmu) as archive:
        name = next(n for n in archive.namelist() if n.startswith("binaries/"))
        library = archive.extract(name, tmp_path)
    listing = subprocess.run(["nm", "-D", "--defined-only", library], capture_output=True, text=True, check=True)
    symbols = {line.split()[-1] for line in listing.stdout.splitlines()}
    assert symbols and all(s.startswith("fmi2") for s in symbols)
    assert {"fmi2Instantiate", "fmi2DoStep", "fmi2GetFMUstate", "fmi2GetTypesPlatform"} <= symbols


def test_an_fmu_of_another_model_against_its_closed_form(built: Build) -> None:
    fmu = built(
        'model Decay "Exponential decay"\n  parameter Real T(unit="s") = 2;\n'
        '  output Real x(unit="1", start=3, fixed=true);\n  input Real u(unit="1");\n'
        "equation\n  T*der(x) = u - x;\nend Decay;\n",
        2,
    )
    result = fmpy.simulate_fmu(
        str(fmu), stop_time=4, output_interval=0.5, start_values={"T": 1.5, "u": 1.0}, relative_tolerance=1e-9
    )
    np.testing.assert_allclose(result["x"], 1 + 2 * np.exp(-result["time"] / 1.5), rtol=1e-8)


def test_protected_parameters_and_states_do_not_disturb(built: Build) -> None:
    fmu = built(
        'model Hidden\n  parameter Real a(unit="1/s") = 2;\n  parameter Real b(unit="1/s") = 3*a + c;\n'
        '  output Real y(unit="1");\nprotected\n  parameter Real c(unit="1/s") = 1;\n'
        '  Real x(unit="1", start=a, fixed=true);\nequation\n  der(x) = -b*x;\n  y = 2*x;\nend Hidden;\n',
        2,
    )
    names = [v.name for v in fmpy.read_model_description(str(fmu)).modelVariables]
    assert names == ["time", "a", "b", "y", "x", "der(x)"]
    result = fmpy.simulate_fmu(str(fmu), stop_time=1, output_interval=0.1, start_values={"a": 1.0})
    np.testing.assert_allclose(result["y"], 2 * np.exp(-4 * result["time"]), rtol=1e-5)


@pytest.mark.parametrize(
    ("class_name", "identifier"),
    [
        ("A.Car", "Car"),
        ("Car", "Car"),
        ("P.'my car'", "my_car"),
        ("P.'a.b'", "a_b"),
        ("'1a'", "M_1a"),
        ("P.'*/'", "M_"),
    ],
)
def test_the_model_identifier_is_one_of_c(class_name: str, identifier: str) -> None:
    assert model_identifier(class_name) == identifier
