"""A build of what has not changed takes what was built before: the same bytes, nothing loaded, nothing overlooked."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from fmu_build import cache, pipeline, rebuild
from fmu_build.cli import main
from fmu_build.errors import BuildError
from fmu_build.fmu.compile import compiler
from fmu_build.frontend import loading

MODEL = "model Decay\n  Real x(start=1, fixed=true);\nequation\n  der(x) = -x;\nend Decay;\n"
HEAVY = {"lxml", "matplotlib", "networkx", "nh3", "numpy", "rumoca", "scipy", "sympy"}
LOADED = f"""
import sys
from fmu_build.cli import main
status = main(sys.argv[1:])
print(*sorted({HEAVY} & set(sys.modules)))
sys.exit(status)
"""


@pytest.fixture
def decay(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("CFLAGS", "-O0")
    monkeypatch.setenv("CC", compiler()[0])
    monkeypatch.setenv(cache.SETTING, str(tmp_path / "kept"))
    folder = tmp_path / "models"
    folder.mkdir()
    monkeypatch.chdir(folder)
    (folder / "Decay.mo").write_text(MODEL, encoding="utf-8")
    return folder / "Decay.mo"


def test_the_same_bytes_without_any_work(decay: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    fmus = []
    for setting in (None, "", "kept", "kept"):
        if setting is not None:
            monkeypatch.setenv(cache.SETTING, setting and str(decay.parents[1] / setting))
        if len(fmus) == 3:
            monkeypatch.setattr(pipeline, "made", None)
        assert main(["Decay.mo", "Decay", "-o", "new/Decay.fmu"]) == 0
        fmus.append((decay.parent / "new" / "Decay.fmu").read_bytes())
        shutil.rmtree(decay.parent / "new")
    assert len(set(fmus)) == 1
    command = [sys.executable, "-c", LOADED, "Decay.mo", "Decay", "-o", "Decay.fmu"]
    assert subprocess.run(command, capture_output=True, text=True, check=True).stdout.split("\n")[1] == ""
    assert Path("Decay.fmu").read_bytes() == fmus[0]


def test_all_that_goes_in_counts(decay: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Texts, options, compiler, tools: another one gives another key, and the old one gives the old key."""
    keys: list[str | None] = []
    monkeypatch.setattr(rebuild, "kept", lambda parts, _: keys.append(cache._key(parts)) or b"")
    library, package = tmp_path / "libraries" / "Parts", tmp_path / "fmu_build"
    for folder in (library, package):
        folder.mkdir(parents=True)
    (library / "package.mo").write_text("package Parts\nend Parts;\n")
    (package / "text.py").touch()
    monkeypatch.setattr(rebuild, "PACKAGE", package)
    own = tmp_path / "cc"
    own.write_text("#!/bin/sh\necho 1\n")

    def asked(*arguments: str) -> None:
        assert main(["Decay.mo", "Decay", "-o", "Decay.fmu", *arguments]) == 0

    asked()
    asked("--fmi", "3")
    asked("--platforms", "host,x86_64-windows")
    asked("--library", str(library))
    asked("--library", str(library.parent))
    for name, value in [("MODELICAPATH", str(library)), ("CFLAGS", "-O1"), ("CPATH", "/tmp"), ("CC", str(own))]:
        monkeypatch.setenv(name, value)
        own.chmod(0o755)
        asked()
    for path, text in [
        (own, "#!/bin/sh\necho 2\n"), (decay, MODEL + "\n"), (decay.with_name("Other.mo"), ""), (package / "a.c", ""),
        (library / "package.order", ""), (library / "package.mo", ""), (library / "Deep" / "package.mo", ""),
        (package / "text.py", "#"),
    ]:  # fmt: skip
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
        asked()
    monkeypatch.setattr(rebuild, "tools", lambda: ["numpy-0.dist-info"])
    asked()
    assert None not in keys and len(set(keys)) == len(keys)
    asked()
    assert keys[-1] == keys[-2]


def test_what_others_write_beside_a_model_does_not(decay: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    keys: list[str | None] = []
    monkeypatch.setattr(rebuild, "kept", lambda parts, _: keys.append(cache._key(parts)) or b"")
    for name in ("notes.txt", ".#Decay.mo", "Decay.fmu"):
        assert main(["Decay.mo", "Decay", "-o", "Decay.fmu"]) == 0
        Path(name).symlink_to("nowhere") if name.startswith(".") else Path(name).write_text("x")
    assert len(set(keys)) == 1


def test_what_is_refused_is_refused_again(decay: Path, capsys: pytest.CaptureFixture[str]) -> None:
    decay.write_text(MODEL.replace("der(x)", "der(y)"), encoding="utf-8")
    said = set()
    for _ in range(2):
        assert main(["Decay.mo", "Decay", "-o", "Decay.fmu"]) == 2
        said.add(capsys.readouterr().err)
    assert len(said) == 1 and "y" in said.pop() and not (decay.parents[1] / "kept").exists()


def test_rumoca_is_asked_once(decay: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The same of the same files, whatever has changed behind the front end; errors are asked for again."""
    first = loading.load(decay, "Decay")
    monkeypatch.setattr(loading, "_answer", lambda *_: pytest.fail("asked again"))
    assert loading.load(decay, "Decay")[0] == first[0]
    with pytest.raises(pytest.fail.Exception):
        loading.run(decay, "Decay", [], [0.0, 1.0], [1e-9])
    monkeypatch.undo()
    with pytest.raises(BuildError, match="no class Decoy"):
        loading.load(decay, "Decoy")
