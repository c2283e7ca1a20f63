"""What is inside the FMU files: clean under both checkers, complete, and able to rebuild themselves."""

from __future__ import annotations

import re
import subprocess
import sys
import zipfile
from html.parser import HTMLParser
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.ssp.ssd import read_ssv
from fmpy.validation import validate_fmu
from lxml import etree

from fmu_build.fmu.compile import compiler
from tests.sampling import sampled

VERSIONS = [2, 3]
SSV_SCHEMA = Path("ssp", "schema", "SystemStructureParameterValues.xsd")
FIGURE_8 = {"stop_time": 6.0, "output_interval": 0.1, "start_values": {"brake_torque": 1000.0}}


@pytest.mark.parametrize("version", VERSIONS)
def test_fmpy_finds_nothing(car_trailer_fmus: dict[int, Path], version: int) -> None:
    assert validate_fmu(str(car_trailer_fmus[version])) == []


@pytest.mark.parametrize("version", VERSIONS)
def test_the_manipulation_toolbox_finds_nothing(car_trailer_fmus: dict[int, Path], version: int) -> None:
    command = [str(Path(sys.executable).with_name("fmutool")), "-input", str(car_trailer_fmus[version]), "-check"]
    result = subprocess.run(command, capture_output=True, text=True, check=True)
    report = result.stdout + result.stderr
    assert f"compliant with FMI-{version}.0" in report and "No semantic error" in report
    assert "WARNING" not in report and "ERROR" not in report


@pytest.mark.parametrize("version", VERSIONS)
def test_both_versions_show_the_same_variables(car_trailer_fmus: dict[int, Path], version: int) -> None:
    two, three = (fmpy.read_model_description(str(car_trailer_fmus[v])) for v in VERSIONS)
    variables = {v.name: (v.valueReference, v.causality, v.variability, v.initial, v.unit) for v in two.modelVariables}
    others = {v.name: (v.valueReference, v.causality, v.variability, v.initial, v.unit) for v in three.modelVariables}
    indicators = {v.variable.name for v in three.eventIndicators}
    assert indicators == {f"relation[{n}]" for n in range(1, 10)} and two.numberOfEventIndicators == 9
    assert variables == {name: roles for name, roles in others.items() if name not in indicators}
    assert len({reference for reference, *_ in others.values()}) == len(others)  # no shared value references


@pytest.mark.parametrize("version", sampled(VERSIONS, [3]))
def test_the_sources_inside_rebuild_the_binary(car_trailer_fmus: dict[int, Path], version: int, tmp_path: Path) -> None:
    fmu = car_trailer_fmus[version]
    fmpy.extract(str(fmu), unzipdir=str(tmp_path / "unpacked"))
    sources = tmp_path / "unpacked" / "sources"
    if version == 3:
        build = etree.parse(str(sources / "buildDescription.xml"))
        files = [element.get("name") for element in build.iter("SourceFile")]
    else:
        description = etree.parse(str(tmp_path / "unpacked" / "modelDescription.xml"))
        files = [element.get("name") for element in description.find("CoSimulation").iter("File")]
    library = tmp_path / "rebuilt.so"
    command = [
        *compiler(),
        "-std=c11",
        "-O0",
        "-ffp-contract=off",
        "-fPIC",
        "-shared",
        f"-DFMI{version}_OVERRIDE_FUNCTION_PREFIX",
        *files,
        "-o",
        str(library),
        "-lm",
    ]
    subprocess.run(command, cwd=sources, check=True)
    rebuilt = tmp_path / "rebuilt.fmu"
    with zipfile.ZipFile(fmu) as old, zipfile.ZipFile(rebuilt, "w") as new:
        for name in old.namelist():
            new.writestr(name, library.read_bytes() if name.startswith("binaries/") else old.read(name))
    first, second = (fmpy.simulate_fmu(str(path), **FIGURE_8) for path in (fmu, rebuilt))
    for name in first.dtype.names:
        np.testing.assert_array_equal(first[name], second[name])


@pytest.mark.parametrize("version", VERSIONS)
def test_documentation_picture_and_licence(car_trailer_fmus: dict[int, Path], version: int) -> None:
    with zipfile.ZipFile(car_trailer_fmus[version]) as archive:
        names = set(archive.namelist())
        page = archive.read("documentation/index.html").decode()
        licence = archive.read("documentation/licenses/runtime.txt").decode()
        picture = archive.read("model.png" if version == 2 else "terminalsAndIcons/icon.png")
    assert licence.startswith("MIT License") and picture.startswith(b"\x89PNG")
    links: list[str] = []

    class Links(HTMLParser):
        def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
            links.extend(value for key, value in attributes if key in {"src", "href"} and value)

    Links().feed(page)
    local = {link for link in links if not link.startswith("https://doi.org/")}
    assert {str(Path("documentation") / link).replace("documentation/../", "") for link in local} <= names
    for parameter in ("M_c", "k_t", "compression_start", "brake_torque", "F_hitch"):
        assert f"<code>{parameter}</code>" in page
    assert "modelica://" not in page


def test_terminals_and_icons_follow_their_schema(car_trailer_fmus: dict[int, Path]) -> None:
    schema_file = Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3TerminalsAndIcons.xsd"
    schema = etree.XMLSchema(etree.parse(str(schema_file)))
    with zipfile.ZipFile(car_trailer_fmus[3]) as archive:
        schema.assertValid(etree.fromstring(archive.read("terminalsAndIcons/terminalsAndIcons.xml")))
    build_file = schema_file.with_name("fmi3BuildDescription.xsd")
    with zipfile.ZipFile(car_trailer_fmus[3]) as archive:
        etree.XMLSchema(etree.parse(str(build_file))).assertValid(
            etree.fromstring(archive.read("sources/buildDescription.xml"))
        )


@pytest.mark.parametrize("version", VERSIONS)
def test_the_reference_results_inside_can_be_repeated(
    car_trailer_fmus: dict[int, Path], version: int, tmp_path: Path
) -> None:
    """As an importer would, from the manifest alone: parameters and inputs in, outputs to the accuracy that is told."""
    fmu = car_trailer_fmus[version]
    folder = Path(fmpy.extract(str(fmu), unzipdir=str(tmp_path))) / "extra" / "org.fmi-standard.fmi-ls-ref"
    related = etree.parse(str(folder / "fmi-ls-manifest.xml")).findall("Related")
    sources = {(item.get("description").partition(":")[0], item.get("role")): item.get("source") for item in related}
    examples = {example for example, _ in sources}
    assert {example.rpartition(".")[2] for example in examples} == {"Figure8", "Figure10"}
    told = (tmp_path / "documentation" / "fmi-ls-ref.txt").read_text()
    for example in sorted(examples):
        values = read_ssv(str(folder / sources[example, "parameter"]))
        inputs = np.genfromtxt(folder / sources[example, "testcase"], delimiter=",", names=True)
        expected = np.genfromtxt(folder / sources[example, "result"], delimiter=",", names=True)
        run = fmpy.simulate_fmu(
            str(fmu),
            fmi_type="CoSimulation",
            stop_time=expected["time"][-1],
            output_interval=0.01,
            relative_tolerance=1e-10,
            start_values={p.name: float(p.value) for p in values.parameters},
            input=inputs,
            output=list(expected.dtype.names[1:]),
        )
        assert len(expected) == 601
        accuracies = told.split(f"\n{example}, accuracy of each output\n")[1]
        for name in expected.dtype.names[1:]:
            accuracy = float(re.search(rf"  {name} +(\S+)\n", accuracies)[1])
            digits = 1e-11 * np.abs(expected[name]).max()  # the file has twelve
            distance = np.abs(run[name] - expected[name]).max()
            print(f"FMI {version}, {example}, {name}: {distance:.1e}, accuracy of the reference {accuracy:.1e}")
            assert 1e-13 < accuracy < 1e-5 and distance < accuracy + digits


def test_the_parameter_sets_follow_their_schema(car_trailer_fmu: Path, tmp_path: Path) -> None:
    fmpy.extract(str(car_trailer_fmu), unzipdir=str(tmp_path))
    files = sorted(tmp_path.rglob("*.ssv"))
    schema = etree.XMLSchema(etree.parse(str(Path(fmpy.__file__).parent / SSV_SCHEMA)))
    for file in files:
        schema.assertValid(etree.parse(str(file)))
    assert len(files) == 2


@pytest.mark.parametrize("version", VERSIONS)
def test_speeds_can_be_given_and_seen_in_kilometres_an_hour(car_trailer_fmus: dict[int, Path], version: int) -> None:
    run = fmpy.simulate_fmu(
        str(car_trailer_fmus[version]), stop_time=0.1, start_values={"V_0": (90.0, "km/h")}, output=["v_car"]
    )
    assert run["v_car"][0] == pytest.approx(25.0, rel=1e-15)
    description = fmpy.read_model_description(str(car_trailer_fmus[version]))
    assert next(v for v in description.modelVariables if v.name == "v_car").displayUnit == "km/h"


@pytest.mark.parametrize("version", VERSIONS)
def test_the_page_names_what_each_event_indicator_stands_for(car_trailer_fmus: dict[int, Path], version: int) -> None:
    with zipfile.ZipFile(car_trailer_fmus[version]) as archive:
        page = archive.read("documentation/index.html").decode()
    rows = re.findall(r"<tr><td>(\d+)</td><td>(Positive where [^<]*)</td></tr>", page)
    assert [int(number) for number, _ in rows] == list(range(1, 10))
    assert "Positive where compression &lt; 0 (Components/DrawbarSpring.mo:" in page
