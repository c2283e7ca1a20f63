"""A release: one version everywhere, and sources from which the wheel is made and tested."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import pytest

from tests.conftest import ROOT

WHERE = {  # the place that decides is the first
    "pyproject.toml": r'^version = "(.*?)"',
    "CITATION.cff": r"^version: (.*)$",
    "modelica/OverrunHitch/package.mo": r'^    version="(.*?)",$',
    "CHANGELOG.md": r"^## (\S+)",
}
SMALLEST = ("tests/overrun_hitch/test_parameters.py", "tests/overrun_hitch/theory")


def test_one_version_everywhere() -> None:
    found = {name: re.search(pattern, (ROOT / name).read_text("utf-8"), re.M) for name, pattern in WHERE.items()}
    versions = {name: match and match[1] for name, match in found.items()}
    assert len({*versions.values()}) == 1, versions


def test_the_changelog_is_grouped() -> None:
    """By release, the newest first, and by what a user notices."""
    headings = re.findall(r"^(##+) (\S+)", (ROOT / "CHANGELOG.md").read_text("utf-8"), re.M)
    releases = [tuple(map(int, name.split("."))) for marks, name in headings if marks == "##"]
    assert releases == sorted({*releases}, reverse=True) and len(releases) > 1
    assert {name for marks, name in headings if marks == "###"} <= {"Added", "Changed", "Fixed", "Removed"}
    assert {marks for marks, _ in headings} == {"##", "###"}


def hatchling(folder: Path, kind: str, output: Path) -> Path:
    command = [sys.executable, "-m", "hatchling", "build", "-t", kind, "-d", str(output)]
    subprocess.run(command, cwd=folder, check=True, capture_output=True)
    (made,) = output.glob("*.whl" if kind == "wheel" else "*.tar.gz")
    return made


@pytest.mark.full
def test_the_sources_make_the_same_wheel_and_test_themselves(tmp_path: Path) -> None:
    wheel = hatchling(ROOT, "wheel", tmp_path / "here")
    with tarfile.open(hatchling(ROOT, "sdist", tmp_path)) as archive:
        archive.extractall(tmp_path, filter="data")
    (sources,) = (path for path in tmp_path.glob("overrun_hitch-*") if path.is_dir())
    with zipfile.ZipFile(wheel) as one, zipfile.ZipFile(hatchling(sources, "wheel", tmp_path / "there")) as other:
        assert {name: one.read(name) for name in one.namelist()} == {
            name: other.read(name) for name in other.namelist()
        }
    search = os.pathsep.join([str(sources), str(sources / "python")])
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-m", "not full", *SMALLEST]
    done = subprocess.run(
        command, cwd=sources, env={**os.environ, "PYTHONPATH": search}, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout
