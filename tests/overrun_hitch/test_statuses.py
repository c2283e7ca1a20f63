"""What the exit status of `hitch` says: 1 that something differs, or a run failed, and nothing else."""

from __future__ import annotations

import subprocess
import sys

import pytest

from overrun_hitch import cli


@pytest.mark.parametrize("error", [RuntimeError("broken"), KeyError("x"), AssertionError(), MemoryError()])
def test_a_fault_of_ours_is_not_told_as_a_difference(
    error: Exception, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def fail(**_: object) -> int:
        raise error

    monkeypatch.setattr(cli, "app", fail)
    assert cli.main([]) == 70
    assert type(error).__name__ in capsys.readouterr().err


def test_python_gives_the_status_as_it_is() -> None:
    code = "import sys; from overrun_hitch import cli; cli.app = None; sys.exit(cli.main([]))"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, check=False).returncode == 70
