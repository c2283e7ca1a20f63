"""FMUs for several platforms, and C programs that drive them there."""

from __future__ import annotations

import os
import shutil
import subprocess
import zipfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import fmpy
import pytest

from fmu_build.fmu.compile import HEADERS, PLATFORMS, WARNINGS, Platform, compiler, host_platform, zig_compiler
from fmu_build.pipeline import build

HERE = Path(__file__).parent
FLAGS = ("-std=c11", "-O2", *WARNINGS, "-Werror")
SYSROOT = Path(os.environ.get("QEMU_LD_PREFIX", "/usr/aarch64-linux-gnu"))
OUTPUTS = ("v_car", "v_trailer", "a_car", "a_trailer", "compression", "F_hitch", "slip_car", "slip_trailer")


@dataclass(frozen=True)
class Program:
    """A driver for a platform; ``before`` is what runs programs of that platform here."""

    path: Path
    before: tuple[str, ...] = ()

    def run(
        self, library: Path, fmu: Path, names: Sequence[str] = ("brake_torque", *OUTPUTS), **environment: str
    ) -> subprocess.CompletedProcess[str]:
        """Run it on a library of the FMU; the first of the names is what it sets, to 1000, the others are seen."""
        description = fmpy.read_model_description(str(fmu))
        references = {v.name: str(v.valueReference) for v in description.modelVariables}
        arguments = [str(library), description.guid, *(references[name] for name in names)]
        return subprocess.run(
            [*self.before, str(self.path), *arguments],
            capture_output=True,
            text=True,
            check=False,
            env={**os.environ, **environment},
        )


@pytest.fixture(scope="session")
def everywhere_fmu(modelica_library: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An FMI 2 FMU for every platform. The first time on a machine, zig builds the platforms' C libraries: minutes."""
    if zig_compiler() is None:
        pytest.skip("the package ziglang is not installed")
    output = tmp_path_factory.mktemp("everywhere") / "CarTrailer.fmu"
    build(modelica_library, "OverrunHitch.Systems.CarTrailer", output, platforms=("all",))
    return output


@pytest.fixture(scope="session")
def everywhere_hitch(modelica_library: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Hitch.fmu, likewise."""
    if zig_compiler() is None:
        pytest.skip("the package ziglang is not installed")
    output = tmp_path_factory.mktemp("everywhere") / "Hitch.fmu"
    build(modelica_library, "OverrunHitch.Systems.Hitch", output, platforms=("all",))
    return output


@pytest.fixture(scope="session")
def extracted(tmp_path_factory: pytest.TempPathFactory) -> Callable[[Path], Path]:
    """The folder that an FMU is unpacked to."""

    def extract(fmu: Path) -> Path:
        folder = tmp_path_factory.mktemp("extracted")
        with zipfile.ZipFile(fmu) as archive:
            archive.extractall(folder)
        return folder

    return extract


@pytest.fixture(scope="session")
def program(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Program]:
    """Compile one of the drivers beside this file for a platform; skip the test where that cannot run here."""

    def compile_program(name: str, platform: Platform | None = None, options: Sequence[str] = ()) -> Program:
        folder = tmp_path_factory.mktemp(name)
        before = () if platform is None else _runner(platform, folder)
        suffix = ".exe" if platform is not None and platform.suffix == ".dll" else ""
        zig = zig_compiler() or []
        command = compiler() if platform is None else [*zig, "-target", str(platform.zig_target), "-s", "-fPIC"]
        libraries = [] if suffix else ["-ldl", "-lm", "-lpthread"]
        path = folder / f"{name}{suffix}"
        sources = [str(HERE / f"{name}.c"), str(HERE / "unit.c")]
        command = [
            *command,
            *FLAGS,
            *options,
            *(f"-isystem{HEADERS / version}" for version in ("fmi2", "fmi3")),
            *sources,
            "-o",
            str(path),
            *libraries,
        ]
        subprocess.run(command, check=True, env={"ZIG_LOCAL_CACHE_DIR": str(folder), **os.environ})
        return Program(path, before)

    return compile_program


def _runner(platform: Platform, folder: Path) -> tuple[str, ...]:
    if platform.name == host_platform().name:
        return ()
    if platform == PLATFORMS["x86_64-windows"]:
        if shutil.which("wine") is None:
            pytest.skip("wine is not installed")
        prefix = f"WINEPREFIX={folder / 'wine'}"  # nothing of the user's own is touched
        return ("env", prefix, "WINEDEBUG=-all", "WINEDLLOVERRIDES=mscoree=;mshtml=", "wine")
    if platform == PLATFORMS["aarch64-linux"]:
        if shutil.which("qemu-aarch64") is None:
            pytest.skip("qemu-aarch64 is not installed (Debian: qemu-user)")
        if not (SYSROOT / "lib" / "ld-linux-aarch64.so.1").exists():
            pytest.skip(f"no C library for aarch64 in {SYSROOT} (Debian: libc6-arm64-cross)")
        return ("qemu-aarch64", "-L", str(SYSROOT))
    pytest.skip(f"nothing runs programs for {platform.name} here")
