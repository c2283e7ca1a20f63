"""What the C compiler says reaches nobody as if it were about the model."""

from __future__ import annotations

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
