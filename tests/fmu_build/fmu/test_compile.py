"""What the C compiler says reaches nobody as if it were about the model."""

from __future__ import annotations

import ctypes
import subprocess
import sys
from pathlib import Path

import pytest

from fmu_build.errors import BuildError
from fmu_build.fmu.compile import compile_library, host_platform


def test_wrong_c_is_told_as_a_defect_of_ours(tmp_path: Path) -> None:
    (tmp_path / "model.c").write_text("double f(void) { return b_a_i; }\n", encoding="ascii")
    with pytest.raises(BuildError, match=r"^fmu_build has made C that does not compile, a defect .*model.c:1.*b_a_i"):
        compile_library(tmp_path, tmp_path / "M.so", host_platform())


def test_a_wrong_option_is_none(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "model.c").write_text("double f(void) { return 0.0; }\n", encoding="ascii")
    monkeypatch.setenv("CFLAGS", "-std=c1066")
    with pytest.raises(BuildError, match=r"^\w+ failed: .*c1066"):
        compile_library(tmp_path, tmp_path / "M.so", host_platform())


def test_a_c_file_becomes_a_library_that_is_whole_whoever_else_makes_it(tmp_path: Path) -> None:
    source = tmp_path / "three.c"
    source.write_text('__attribute__((visibility("default"))) int three(void);\nint three(void) { return 3; }\n')
    command = [sys.executable, "-m", "fmu_build.fmu.shared", source, tmp_path / "made"]
    for made in [subprocess.Popen(command) for _ in range(3)]:
        assert made.wait() == 0
    host = host_platform()
    assert [path.name for path in (tmp_path / "made" / host.name).iterdir()] == [f"three{host.suffix}"]
    assert ctypes.CDLL(str(tmp_path / "made" / host.name / f"three{host.suffix}")).three() == 3
