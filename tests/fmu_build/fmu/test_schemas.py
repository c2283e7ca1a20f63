"""Every XML file of every unit against the schemas that the standard publishes (tests/schemas)."""

from __future__ import annotations

import zipfile
from pathlib import Path

import pytest
from lxml import etree

from tests.kept import kept_fmus

SCHEMAS = Path(__file__).parents[2] / "schemas"
FILES = {
    2: {"modelDescription.xml": "fmi2/fmi2ModelDescription.xsd"},
    3: {
        "modelDescription.xml": "fmi3/fmi3ModelDescription.xsd",
        "terminalsAndIcons/terminalsAndIcons.xml": "fmi3/fmi3TerminalsAndIcons.xsd",
        "sources/buildDescription.xml": "fmi3/fmi3BuildDescription.xsd",
    },
}


@pytest.fixture(scope="module")
def units(car_trailer_fmus: dict[int, Path], pair_fmus: dict[int, dict[str, Path]]) -> dict[tuple[str, int], Path]:
    return {
        (name, fmi): path
        for fmi in (2, 3)
        for name, path in (pair_fmus[fmi] | kept_fmus("Systems.Hitch", fmi=fmi)).items()
    } | {("CarTrailer", fmi): path for fmi, path in car_trailer_fmus.items()}


@pytest.mark.full
@pytest.mark.parametrize(("fmi", "file"), [(fmi, file) for fmi in FILES for file in FILES[fmi]])
def test_valid(units: dict[tuple[str, int], Path], fmi: int, file: str) -> None:
    schema = etree.XMLSchema(etree.parse(str(SCHEMAS / FILES[fmi][file])))
    for name in ("CarTrailer", "Car", "Trailer", "Hitch"):
        with zipfile.ZipFile(units[name, fmi]) as archive:
            document = etree.fromstring(archive.read(file))
        schema.assertValid(document)
        document.set("nonsense", "1")
        assert not schema.validate(document)
