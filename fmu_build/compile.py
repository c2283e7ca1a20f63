"""C sources to a shared library for the machine this runs on."""

from __future__ import annotations

import importlib.util
import os
import platform
import shutil
import subprocess
from pathlib import Path

from .errors import BuildError

RUNTIME = Path(__file__).parent / "runtime"
WARNINGS = ("-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Wdouble-promotion")
# No fused multiply-add: the same source gives the same digits on every machine.
OPTIONS = ("-std=c11", "-O2", "-ffp-contract=off", "-fPIC", "-shared", "-fvisibility=hidden", *WARNINGS)
PLATFORMS = {  # (system, machine): FMI 2 folder, file suffix
    ("Linux", "x86_64"): ("linux64", ".so"),
    ("Linux", "aarch64"): ("aarch64-linux", ".so"),
    ("Darwin", "x86_64"): ("darwin64", ".dylib"),
    ("Darwin", "arm64"): ("aarch64-darwin", ".dylib"),
    ("Windows", "AMD64"): ("win64", ".dll"),
}


def host_platform() -> tuple[str, str]:
    """FMI's folder name and file suffix for this machine."""
    host = (platform.system(), platform.machine())
    if host not in PLATFORMS:
        allowed = ", ".join(" ".join(pair) for pair in PLATFORMS)
        raise BuildError(f"platform {' '.join(host)}: no FMU can be built for it; known are {allowed}")
    return PLATFORMS[host]


def compiler() -> list[str]:
    """The C compiler's command: the environment variable CC if it is set, else cc."""
    command = os.environ.get("CC", "cc").split()
    if not command or shutil.which(command[0]) is None:
        name = command[0] if command else "CC"
        raise BuildError(f"no C compiler: {name!r} was not found; install gcc or clang, or set CC to a C11 compiler")
    return command


def fmi_headers() -> Path:
    """The folder with the standard's C headers, as the installed fmpy package ships them."""
    spec = importlib.util.find_spec("fmpy")
    if spec is None or spec.origin is None:
        raise BuildError("the package fmpy, which ships the FMI headers, is not installed")
    return Path(spec.origin).parent / "c-code"


def compile_library(folder: Path, library: Path) -> None:
    """Compile the C files of ``folder`` (model, runtime and facade) to the shared library ``library``."""
    sources = sorted(str(file) for file in folder.glob("*.c"))
    command = [*compiler(), *OPTIONS, f"-I{folder}", f"-isystem{fmi_headers()}", *sources, "-o", str(library), "-lm"]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    if result.returncode != 0:
        lines = result.stderr.splitlines()
        first = next((line for line in lines if "error" in line), lines[0] if lines else "no message")
        raise BuildError(f"{command[0]} failed: {first}")
