"""What tests build, kept in build/test-cache from run to run under a key of everything that goes into it."""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator
from functools import cache
from importlib.metadata import version
from pathlib import Path

import locket

from fmu_build.fmu.compile import compiler
from fmu_build.rebuild import rebuild

ROOT = Path(__file__).parents[1]
LIBRARY = ROOT / "modelica" / "OverrunHitch"
FOLDER = ROOT / "build" / "test-cache"
LARGEST = 2**30  # bytes that stay; what was used longest ago goes first
PACKAGES = ("fmpy", "lxml", "matplotlib", "networkx", "nh3", "numpy", "rumoca", "scipy", "sympy")
SETTINGS = ("CFLAGS", "CPATH", "C_INCLUDE_PATH", "LIBRARY_PATH")  # environment variables that change what cc does
DIGEST = "digest"


def kept(make: Callable[[Path], object], *inputs: str) -> Path:
    """The folder that ``make`` fills, once for equal inputs, whichever process asks first.

    ``inputs`` are all that it depends on, but for the surroundings below. What has been changed since is made again.
    """
    FOLDER.mkdir(parents=True, exist_ok=True)
    folder = FOLDER / key(*inputs)
    with locket.lock_file(f"{folder}.lock"):
        if not is_whole(folder):
            shutil.rmtree(folder, ignore_errors=True)
            with tempfile.TemporaryDirectory(dir=FOLDER) as work:
                made = Path(work) / "made"
                made.mkdir()
                make(made)
                (made / DIGEST).write_text(digest(contents(made)), encoding="ascii")
                made.rename(folder)
        (folder / DIGEST).touch()
    return folder


def kept_fmus(*classes: str, fmi: int) -> dict[str, Path]:
    """The FMUs, in one folder, of classes of the library (Systems.Car), by the last part of their names."""
    files = {name: name.rpartition(".")[2] + ".fmu" for name in classes}

    def make(folder: Path) -> None:
        for name, file in files.items():
            rebuild(LIBRARY, f"OverrunHitch.{name}", folder / file, fmi)

    folder = kept(make, "FMUs of the library", str(fmi), *classes)
    return {Path(file).stem: folder / file for file in files.values()}


def prune() -> None:
    """Leave what was used last, up to LARGEST bytes, and nothing of runs that were killed a day ago or earlier."""
    for work in FOLDER.glob("tmp*"):
        if time.time() - work.stat().st_mtime > 86400.0:
            shutil.rmtree(work)
    size = 0
    for mark in sorted(FOLDER.glob(f"*/{DIGEST}"), key=lambda path: path.stat().st_mtime, reverse=True):
        size += sum(file.stat().st_size for file in mark.parent.rglob("*"))
        if size > LARGEST:
            shutil.rmtree(mark.parent)
            mark.parent.with_suffix(".lock").unlink(missing_ok=True)


def key(*inputs: str) -> str:
    """A name for what is made of the inputs, in the surroundings and settings that there are."""
    settings = [os.environ.get(name) for name in SETTINGS]
    return digest([json.dumps([inputs, settings, surroundings(tuple(compiler()))]).encode()])


@cache
def surroundings(command: tuple[str, ...]) -> list[str]:
    """The sources that FMUs are made of, and the tools that make them; ``command`` is the compiler's."""
    made_by = subprocess.run([*command, "--version"], capture_output=True, text=True, check=True).stdout
    versions = [f"{name} {version(name)}" for name in PACKAGES]
    return [sources(ROOT), *command, str(shutil.which(command[0])), made_by, sys.version, *versions]


def sources(root: Path) -> str:
    """A digest of all that FMUs are made of: the Modelica library, the generator, the runtime, the licence."""
    folders = (part for top in ("modelica", "fmu_build") for part in contents(root / top))
    return digest([(root / "LICENSE").read_bytes(), *folders])


def is_whole(folder: Path) -> bool:
    """Whether it holds what was put there."""
    mark = folder / DIGEST
    return mark.is_file() and mark.read_bytes() == digest(contents(folder)).encode()


def contents(folder: Path) -> Iterator[bytes]:
    """Names and bytes of the files in a folder, but for its digest and what Python compiles."""
    for path in sorted(folder.rglob("*")):
        if path.is_file() and path.name != DIGEST and path.suffix != ".pyc":
            yield from (path.relative_to(folder).as_posix().encode(), path.read_bytes())


def digest(parts: Iterable[bytes]) -> str:
    """SHA-256 of the parts, each by its own."""
    whole = hashlib.sha256()
    for part in parts:
        whole.update(hashlib.sha256(part).digest())
    return whole.hexdigest()
