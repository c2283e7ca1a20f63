"""FMU files as they come: in folders with any name, and with a description that does not fit what is in them."""

from __future__ import annotations

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
import pytest

from overrun_hitch.fmu.opening import opened_unit
from overrun_hitch.fmu.unpacking import UNWRITABLE
from overrun_hitch.parameters import HitchError

OPENING = """
import sys
from pathlib import Path
from overrun_hitch.fmu.opening import opened_unit
from overrun_hitch.parameters import HitchError
try:
    with opened_unit(Path(sys.argv[1])):
        pass
except HitchError as error:
    sys.stderr.write(str(error))
"""
AWKWARD = "\u00fcml \u0141 \"q\" 'a' 100%20 $HOME;b " + "long" * 40


@pytest.fixture
def awkward(tmp_path: Path, car_trailer_fmu: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """CarTrailer.fmu under an awkward name, in a working directory with one."""
    folder = tmp_path / AWKWARD
    folder.mkdir()
    monkeypatch.chdir(folder)
    fmu = folder / f"{AWKWARD}.fmu"
    fmu.write_bytes(car_trailer_fmu.read_bytes())
    return fmu


def test_a_folder_and_a_file_with_awkward_names(awkward: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(awkward.parent))
    with opened_unit(Path(awkward.name)) as unit:
        assert unit.name == awkward.name
    assert [path.name for path in awkward.parent.iterdir()] == [awkward.name]


@pytest.mark.skipif(os.name == "nt", reason="paths are Unicode there")
@pytest.mark.parametrize(("utf8", "said"), [pytest.param("1", "", marks=pytest.mark.full), ("0", UNWRITABLE)])
def test_the_locale_is_blamed_and_not_the_fmu(utf8: str, said: str, awkward: Path) -> None:
    environment = {**os.environ, "LC_ALL": "POSIX", "PYTHONUTF8": utf8, "PYTHONCOERCECLOCALE": "0"}
    command = [sys.executable, "-c", OPENING, awkward.name]
    done = subprocess.run(command, env=environment, capture_output=True, check=False)
    assert done.stderr.decode() == said


@pytest.mark.parametrize("identifier", ["Other", "../../Other", ""])
def test_a_model_identifier_that_is_not_the_librarys(identifier: str, car_trailer_fmu: Path, tmp_path: Path) -> None:
    other, suffix = tmp_path / "other.fmu", fmpy.sharedLibraryExtension
    with zipfile.ZipFile(car_trailer_fmu) as ours, zipfile.ZipFile(other, "w") as theirs:
        for name in ours.namelist():
            content = ours.read(name)
            if name == "modelDescription.xml":
                content = content.replace(b'modelIdentifier="CarTrailer"', f'modelIdentifier="{identifier}"'.encode())
            theirs.writestr(name, content)
    with pytest.raises(HitchError) as caught, opened_unit(other):
        pass
    said = f"{other} has no {identifier}{suffix}, the library of its modelIdentifier; it has CarTrailer{suffix}"
    assert str(caught.value) == said
