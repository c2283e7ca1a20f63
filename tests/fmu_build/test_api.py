"""``fmu_build.build`` as scripts call it: text, files and folders in, a path out, BuildError for what can be mended."""

from __future__ import annotations

import doctest
import subprocess
import sys
from pathlib import Path

import pytest

import fmu_build
from fmu_build import api

DECAY = "model Decay\n  Real x(start=1, fixed=true);\nequation\n  der(x) = -x;\nend Decay;\n"


@pytest.fixture(autouse=True)
def quickly_in_a_folder_of_its_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("CFLAGS", "-O0")


def test_the_example_of_the_docstring() -> None:
    found = doctest.testmod(api)
    assert (found.attempted, found.failed) == (3, 0)


@pytest.mark.full
@pytest.mark.parametrize("as_path", [str, Path])
def test_text_and_file_give_the_same_fmu(as_path: type, tmp_path: Path) -> None:
    Path("Decay.mo").write_text(DECAY, encoding="utf-8")
    of_file = fmu_build.build(as_path("Decay.mo"), output=as_path(tmp_path / "file.fmu"))
    assert of_file.read_bytes() == fmu_build.build(DECAY, "Decay").read_bytes()


def test_what_a_caller_can_mend(tmp_path: Path) -> None:
    for arguments, told in [
        ((DECAY.replace("-x", "-y"),), "Decay.mo:4: unresolved component reference: 'y'"),
        (("a;b",), "no class: it must end with `end NAME;`"),
        (("nowhere.mo",), "nowhere.mo: no such Modelica file"),
        ((tmp_path,), "is a folder: name the class to build"),
        ((DECAY, None, tmp_path), "is a folder; name the FMU to write"),
    ]:
        with pytest.raises(fmu_build.BuildError) as caught:
            fmu_build.build(*arguments)
        assert told in str(caught.value)
        assert "fmu_build-" not in str(caught.value)  # a folder that is gone
        assert "\n" not in str(caught.value)
    with pytest.raises(fmu_build.BuildError, match=r"^fmi = 1 is not allowed; allowed: 2 or 3$"):
        fmu_build.build(DECAY, fmi=1)
    with pytest.raises(fmu_build.BuildError, match=r"platform 'linux' is not known: allowed are host, "):
        fmu_build.build(DECAY, platforms="linux")
    assert list(tmp_path.rglob("*.fmu")) == []


def test_a_missing_package_is_such_an_error() -> None:
    code = "import sys; sys.modules['sympy'] = None; import fmu_build; fmu_build.build('model M end M;')"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.stderr.splitlines()[-1].endswith("BuildError: needs sympy: pip install 'overrun-hitch[build]'")


def test_nothing_is_loaded_before_it_is_used() -> None:
    code = "import sys; before = set(sys.modules); import fmu_build; print(*(set(sys.modules) - before))"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert {name for name in loaded if name.startswith("fmu_build")} == {"fmu_build"}
    assert set(fmu_build.__all__) <= set(dir(fmu_build))
