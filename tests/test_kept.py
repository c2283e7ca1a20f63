"""What is kept from run to run: made again when anything that goes into it is another, or when it is broken."""

from __future__ import annotations

import os
import shutil
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import grimp
import pytest

from tests import kept as module
from tests.kept import DIGEST, ROOT, kept, key, prune, sources, surroundings


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A cache of the test's own."""
    monkeypatch.setattr(module, "FOLDER", tmp_path / "cache")
    yield tmp_path / "cache"
    surroundings.cache_clear()


def file(text: str, made: list[Path]) -> Path:
    """A kept file with the text; ``made`` is told where it was made."""

    def make(folder: Path) -> None:
        made.append(folder)
        (folder / "file").write_text(text)

    return kept(make, text) / "file"


def test_it_is_made_once() -> None:
    made: list[Path] = []
    assert file("a", made) == file("a", made) != file("b", made)
    assert file("a", made).read_text() == "a" and len(made) == 2


@pytest.mark.parametrize("name", ["file", DIGEST, "another"])
@pytest.mark.parametrize("content", [b"", b"\xff"])
def test_what_is_broken_is_made_again(name: str, content: bytes) -> None:
    made: list[Path] = []
    file("a", made).with_name(name).write_bytes(content)
    assert file("a", made).read_text() == "a" and len(made) == 2
    assert {path.name for path in file("a", made).parent.iterdir()} == {"file", DIGEST}


def test_what_cannot_be_made_leaves_nothing(folder: Path) -> None:
    def half(folder: Path) -> None:
        (folder / "half").touch()
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        kept(half, "half")
    assert all(path.suffix == ".lock" for path in folder.iterdir())


def test_what_was_used_last_stays(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    files = [file(text, []) for text in "abcd"]
    for age, one in enumerate(files):
        os.utime(one.with_name(DIGEST), (1000.0 - age, 1000.0 - age))
    file("d", [])
    for name, age in (("tmp-old", 90000.0), ("tmp-new", 0.0)):
        (folder / name).mkdir()
        os.utime(folder / name, (time.time() - age, time.time() - age))
    monkeypatch.setattr(module, "LARGEST", 2 * sum(part.stat().st_size for part in files[0].parent.iterdir()))
    prune()
    assert [one.exists() for one in files] == [True, False, False, True]
    assert len(list(folder.iterdir())) == 5 and (folder / "tmp-new").exists()


@pytest.mark.full
def test_a_changed_byte_in_any_source_gives_another_key(tmp_path: Path) -> None:
    for top in ("modelica", "fmu_build"):
        shutil.copytree(ROOT / top, tmp_path / top, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "LICENSE", tmp_path)
    paths = [path for path in tmp_path.rglob("*") if path.is_file()]
    assert {path.suffix for path in paths} >= {".mo", ".order", ".py", ".c", ".h"}
    seen = {sources(tmp_path)}
    assert seen == {sources(ROOT)}
    for path in paths:
        content = path.read_bytes()
        path.write_bytes(bytes([content[0] ^ 1]) + content[1:] if content else b"#")
        seen.add(sources(tmp_path))
        path.write_bytes(content)
    path.rename(path.with_name("another"))
    assert len(seen | {sources(tmp_path)}) == len(paths) + 2


def test_everything_else_that_goes_in_gives_another_key(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CC", "cc")
    keys = [key("a", "b"), key("ab"), key("b", "a")]
    for name in module.SETTINGS:
        monkeypatch.setenv(name, "/tmp")
        keys.append(key("a", "b"))
    compiler = tmp_path / "cc"
    for version in ("1", "2"):
        compiler.write_text(f"#!/bin/sh\necho {version}\n")
        compiler.chmod(0o755)
        monkeypatch.setenv("CC", str(compiler))
        surroundings.cache_clear()
        keys.append(key("a", "b"))
    for package in module.PACKAGES:
        surroundings.cache_clear()
        monkeypatch.setattr(module, "version", lambda name, changed=package: "0" if name == changed else "1")
        keys.append(key("a", "b"))
    assert len(set(keys)) == len(keys)


def test_no_package_is_forgotten() -> None:
    """What the generator imports is in the key, but for what its command line and its own cache are made of."""
    graph = grimp.build_graph("fmu_build", include_external_packages=True, cache_dir=None)
    imported = {name for name in graph.modules if not name.startswith("fmu_build")} - sys.stdlib_module_names
    assert imported - {"platformdirs", "rich", "typer"} <= set(module.PACKAGES)
