"""The page's TypeScript, compiled and run by Node's own test runner."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

WEB = Path(__file__).parents[2] / "web"


@pytest.fixture(scope="session")
def run_node(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., None]:
    """Runs web/test/NAME.test.ts, with environment variables of ours."""
    if shutil.which("node") is None:
        pytest.skip("Node (node) is not installed")
    compiler = WEB / "node_modules" / "typescript" / "bin" / "tsc"
    if not compiler.exists():
        pytest.skip("the packages of web/ are not installed (make web)")
    folder = tmp_path_factory.mktemp("web")
    (folder / "package.json").write_text('{"type": "module"}')
    (folder / "node_modules").symlink_to(WEB / "node_modules", target_is_directory=True)
    done = subprocess.run(
        ["node", compiler, "--project", WEB, "--outDir", folder], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr

    def run(name: str, **environment: str) -> None:
        done = subprocess.run(
            ["node", "--test", "--test-reporter=tap", folder / "test" / f"{name}.test.js"],
            capture_output=True,
            text=True,
            check=False,
            env={**os.environ, **environment},
        )
        assert done.returncode == 0, done.stdout + done.stderr
        print(done.stdout)

    return run
