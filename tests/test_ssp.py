"""CarTrailer.ssp: valid, the same bytes again, the paper's cases, and run by FMPy's own master.

FMPy 0.3.32's `simulate_ssp` (fmpy/ssp/simulation.py) is a Jacobi master: in each step it sets every component's inputs,
steps it and fetches its outputs, one component after the other, and hands values on when all have stepped. It fetches
nothing before the first step, so that all inputs are 0 in it, and what a system's input is set to reaches the units one
step late. It applies the parameter set that it is given, and no binding of the SSD.
"""

from __future__ import annotations

import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.ssp.simulation import simulate_ssp
from fmpy.ssp.ssd import read_ssd, read_ssv, validate_tree
from lxml import etree

from overrun_hitch.coupling.ssp import OUTPUTS, main, write_ssp
from overrun_hitch.parameters import CASES, DATUM, Parameters
from tests.unit import Unit

H, COUNT = 1.0 / 128.0, 512  # s; four seconds, in steps that add up without rounding
TORQUE = 1000.0  # N.m
SETTINGS = {"extrapolation": 1.0, "applied_force": 3.0}


@pytest.fixture(scope="module")
def ssp(pair_fmus: dict[int, dict[str, Path]], tmp_path_factory: pytest.TempPathFactory) -> Path:
    output = tmp_path_factory.mktemp("ssp") / "CarTrailer.ssp"
    write_ssp(pair_fmus[2]["Car"], pair_fmus[2]["Trailer"], output)
    return output


def of_units(case: Parameters, fmus: dict[str, Path]) -> dict[str, dict[str, float]]:
    """Each unit's own parameters for a case, told by the names that it has."""
    known = {**case.model_dump(), **SETTINGS}
    described = {name: fmpy.read_model_description(str(fmu)) for name, fmu in fmus.items()}
    return {
        name: {v.name: known[v.name] for v in description.modelVariables if v.causality == "parameter"}
        for name, description in described.items()
    }


def test_every_document_is_valid(ssp: Path) -> None:
    schemas = {".ssd": "SystemStructureDescription.xsd", ".ssv": "SystemStructureParameterValues.xsd"}
    with zipfile.ZipFile(ssp) as archive:
        names = [name for name in archive.namelist() if Path(name).suffix in schemas]
        for name in names:
            validate_tree(etree.fromstring(archive.read(name)), schemas[Path(name).suffix])
    assert len(names) == 2 * len(CASES)
    assert "SystemStructure.ssd" in names


def test_what_has_a_name_is_an_identifier(ssp: Path) -> None:
    """OMSimulator's command line takes no others; variables below the top level have their dots."""
    with zipfile.ZipFile(ssp) as archive:
        for name in archive.namelist():
            if name.endswith((".ssd", ".ssv")):
                root = etree.fromstring(archive.read(name))
                kinds = ("System", "Component", "ParameterSet")
                named = [root, *(element for kind in kinds for element in root.iterfind(f".//{{*}}{kind}"))]
                assert all(element.get("name").isidentifier() for element in named), name


def test_names_that_it_uses_are_there(ssp: Path, pair_fmus: dict[int, dict[str, Path]]) -> None:
    """Connectors are variables of the units, with their units; every unit of measure is defined."""
    spaces = {"ssd": "http://ssp-standard.org/SSP1/SystemStructureDescription"}
    with zipfile.ZipFile(ssp) as archive:
        documents = {
            name: etree.fromstring(archive.read(name)) for name in archive.namelist() if not name.endswith(".fmu")
        }
    for component in documents["SystemStructure.ssd"].iterfind(".//ssd:Component", spaces):
        fmu = fmpy.read_model_description(str(pair_fmus[2][component.get("name")]))
        variables = {variable.name: variable for variable in fmu.modelVariables}
        for connector in component.iterfind(".//ssd:Connector", spaces):
            variable = variables[connector.get("name")]
            unit = variable.unit or variable.declaredType.unit
            assert (connector.get("kind"), connector[0].get("unit")) == (variable.causality, unit), connector.get(
                "name"
            )
    for name, document in documents.items():
        used = {element.get("unit") for element in document.iterfind(".//{*}Real")}
        assert used == {element.get("name") for element in document.iterfind(".//{*}Unit")}, name


def test_a_place_that_cannot_be_written(
    pair_fmus: dict[int, dict[str, Path]], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").touch()
    for output in (tmp_path, tmp_path / "file" / "CarTrailer.ssp"):
        assert main([str(pair_fmus[2]["Car"]), str(pair_fmus[2]["Trailer"]), "-o", str(output)]) == 2
        (line,) = capsys.readouterr().err.splitlines()
        assert str(output if output == tmp_path else output.parent) in line


def test_the_same_bytes_again(ssp: Path, pair_fmus: dict[int, dict[str, Path]], tmp_path: Path) -> None:
    write_ssp(pair_fmus[2]["Car"], pair_fmus[2]["Trailer"], tmp_path / "again.ssp")
    assert (tmp_path / "again.ssp").read_bytes() == ssp.read_bytes()


def test_the_datum_is_bound_and_each_variant_has_its_own_case(ssp: Path) -> None:
    assert CASES["ii"] == DATUM
    (binding,) = read_ssd(str(ssp)).system.parameterBindings
    assert binding.source == "resources/case-ii.ssv"
    with zipfile.ZipFile(ssp) as archive:
        datum = archive.read("SystemStructure.ssd")
        for case in set(CASES) - {"ii"}:
            expected = datum
            for separator in ("_", " ", "-"):  # in the name, the description and the file
                expected = expected.replace(f"case{separator}ii".encode(), f"case{separator}{case}".encode())
            assert archive.read(f"case-{case}.ssd") == expected


@pytest.mark.parametrize("case", CASES)
def test_a_parameter_set_has_all_parameters_of_its_case(
    ssp: Path, pair_fmus: dict[int, dict[str, Path]], case: str
) -> None:
    found = {p.name: float(p.value) for p in read_ssv(str(ssp), resource=f"resources/case-{case}.ssv").parameters}
    wanted = {
        f"{unit}.{name}": value
        for unit, values in of_units(CASES[case], pair_fmus[2]).items()
        for name, value in values.items()
    }
    assert found == {**wanted, "Trailer.v_car": CASES[case].V_0}


def coupled(fmus: dict[str, Path], folder: Path, case: Parameters, names: dict[str, str]) -> np.ndarray:
    """What FMPy's master does, call by call: the outputs at the end of each step."""
    units = {name: Unit(fmu, folder / name) for name, fmu in fmus.items()}
    for name, values in of_units(case, fmus).items():
        units[name].slave.instantiate()
        units[name].start(**values, **({"v_car": case.V_0} if name == "Trailer" else {}))
    rows, speed, force, torque = [], 0.0, 0.0, 0.0
    for n in range(COUNT):
        units["Trailer"].set(v_car=speed)
        units["Car"].set(F_hitch=force, brake_torque=torque)
        for unit in units.values():
            unit.slave.doStep(n * H, H)
        (speed,), (force,) = units["Car"].get("v_car"), units["Trailer"].get("F_hitch_hold")
        torque = TORQUE
        rows.append([units[owner].get(name)[0] for name, owner in names.items()])
    for unit in units.values():
        unit.slave.terminate()
        unit.slave.freeInstance()
    return np.array(rows)


@pytest.mark.parametrize("case", ["ii", "viii"])
def test_fmpy_runs_it(ssp: Path, pair_fmus: dict[int, dict[str, Path]], tmp_path: Path, case: str) -> None:
    chosen = read_ssv(str(ssp), resource=f"resources/case-{case}.ssv")
    inputs = {"brake_torque": lambda time: TORQUE}
    result = simulate_ssp(str(ssp), stop_time=COUNT * H, step_size=H, parameter_set=chosen, input=inputs)
    inside = np.stack([result[name] for name in OUTPUTS], axis=1)
    direct = coupled(pair_fmus[2], tmp_path, CASES[case], OUTPUTS)
    speed = list(OUTPUTS).index("v_car")
    print(f"case {case}: largest difference {abs(inside - direct).max():.1e}, v_car at the end {inside[-1, speed]:.3f}")
    assert inside[-1, speed] < 32.0  # braked
    assert result["compression"][0] > 0.9 * CASES[case].V_0 * H  # the ball stood still in the first step
    np.testing.assert_array_equal(inside, direct)


def test_other_files_are_refused(
    pair_fmus: dict[int, dict[str, Path]], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    car, trailer = pair_fmus[2]["Car"], pair_fmus[2]["Trailer"]
    for first, second, message in [
        (trailer, trailer, "it has no variable brake_torque"),
        (pair_fmus[3]["Car"], trailer, "SSP 1.0 takes units of FMI 2.0"),
        (car, tmp_path / "missing.fmu", "is no FMU"),
    ]:
        assert main([str(first), str(second), "-o", str(tmp_path / "out.ssp")]) == 2
        assert message in capsys.readouterr().err
    assert not (tmp_path / "out.ssp").exists()
