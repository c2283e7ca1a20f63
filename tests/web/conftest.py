"""The page and its TypeScript: bundled by esbuild, run by Node's own test runner."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from fmu_build.fmu.compile import zig_compiler
from fmu_build.pipeline import build
from tests.kept import LIBRARY, digest, kept

WEB = Path(__file__).parents[2] / "web"
# The browser's driver looks for its own files.
OPTIONS = ("--bundle", "--platform=node", "--format=esm", "--log-level=error", "--external:playwright-core")
NodeRunner = Callable[..., str]


def told(*command: str | Path, **environment: str) -> str:
    """What a command prints that does well."""
    done = subprocess.run(command, capture_output=True, text=True, check=False, env={**os.environ, **environment})
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="session")
def packages() -> Path:
    """The packages of web/; skips a test where they are not."""
    if shutil.which("node") is None:
        pytest.skip("Node (node) is not installed")
    folder = WEB / "node_modules"
    installed, wanted = folder / ".package-lock.json", WEB / "package-lock.json"
    if not installed.exists() or installed.stat().st_mtime < wanted.stat().st_mtime:  # as make sees it
        pytest.skip("the packages of web/ are not installed (make web)")
    return folder


@pytest.fixture(scope="session")
def unit_folder(packages: Path) -> Path:
    """What make web puts into build/wasm, and the page, index.html."""
    if zig_compiler() is None:
        pytest.skip("the package ziglang is not installed")

    def make(folder: Path) -> None:
        fmu = folder / "CarTrailer.fmu"
        build(LIBRARY, "OverrunHitch.Systems.CarTrailer", fmu, 3, ("wasm",), references=False)
        told(sys.executable, WEB / "unit.py", fmu, folder)
        told(sys.executable, WEB / "presets.py", folder)
        told("node", WEB / "bundle.mjs", folder, folder / "index.html")

    files = [WEB.parent / "python" / "overrun_hitch" / "parameters.py", *WEB.glob("*.*"), *(WEB / "src").iterdir()]
    return kept(make, "the live page", digest(file.read_bytes() for file in sorted(files)))


@pytest.fixture(scope="session")
def run_node(packages: Path, tmp_path_factory: pytest.TempPathFactory) -> NodeRunner:
    """Runs web/test/NAME.test.ts, with environment variables of ours, and returns what it prints."""
    told(packages / ".bin" / "tsc", "--noEmit", "--project", WEB)
    folder = tmp_path_factory.mktemp("web")
    (folder / "node_modules").symlink_to(packages, target_is_directory=True)
    told(sys.executable, WEB / "presets.py", folder)
    axe = packages / "axe-core" / "axe.min.js"
    presets = folder / "presets.json"

    def run(name: str, **environment: str) -> str:
        source, out = WEB / "test" / f"{name}.test.ts", folder / f"{name}.test.mjs"
        told(
            packages / ".bin" / "esbuild",
            source,
            f"--outfile={out}",
            *OPTIONS,
            f"--alias:presets.json={presets}",
            f"--alias:axe.source={axe}",
            "--loader:.min.js=text",
        )
        results = told("node", "--test", "--test-reporter=tap", out, **environment)
        print(results)
        return results

    return run
