"""C sources to a shared library: with this machine's compiler for itself, with ``zig cc`` for any platform."""

from __future__ import annotations

import importlib.util
import os
import platform as machine
import re
import shlex
import shutil
import subprocess
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from ..errors import BuildError

RUNTIME = Path(__file__).parents[1] / "runtime"
HEADERS = Path(__file__).parents[1] / "headers"  # the standard's, a folder for each version
WARNINGS = ("-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Wdouble-promotion")
# No fused multiply-add: the same source gives the same digits on every machine.
# A shared library's functions have the standard's own names; a prefix is for static linking (see unit_header.py).
UNPREFIXED = ("-DFMI2_OVERRIDE_FUNCTION_PREFIX", "-DFMI3_OVERRIDE_FUNCTION_PREFIX")
OPTIONS = ("-std=c11", "-O3", "-ffp-contract=off", "-fvisibility=hidden", *UNPREFIXED, *WARNINGS)
SHARED = ("-fPIC", "-shared")
# Calls from inside the library stay inside, whatever else the process has loaded under the same names. Windows and
# macOS bind them so by themselves.
ELF = ("-Wl,-Bsymbolic",)
# A module that is called into, not run. Beside the standard's functions its host needs memory for what it passes, and
# the table of functions, into which it puts its callbacks.
WEBASSEMBLY = (
    "-mexec-model=reactor",
    "-Wl,--export-dynamic,--export=malloc,--export=free,--export-table,--growable-table",
)
# What else compilers read of their surroundings (CFLAGS is ours).
ENVIRONMENT = ("CPATH", "C_INCLUDE_PATH", "LIBRARY_PATH", "SDKROOT", "MACOSX_DEPLOYMENT_TARGET")


@dataclass(frozen=True)
class Platform:
    """Where a library runs. ``name`` is the platform tuple after FMI 3 and the name of its folder there.

    ``zig_target`` names the oldest system that the library is to run on; None: this machine, by its own compiler.
    """

    name: str
    fmi2_folder: str
    suffix: str
    zig_target: str | None

    @property
    def fmi3_folder(self) -> str:
        """The folder under binaries/ in an FMI 3 FMU."""
        return self.name


# FMI 2.0.5 names linux64, win64 and darwin64, for x86 alone, and refers to FMI 3's tuples for everything else. On Apple
# silicon importers look into darwin64 all the same (FMPy there only), so that its library is one for both processors.
PLATFORMS = {
    p.name: p
    for p in (
        Platform("x86_64-linux", "linux64", ".so", "x86_64-linux-gnu.2.17"),
        Platform("aarch64-linux", "aarch64-linux", ".so", "aarch64-linux-gnu.2.17"),
        Platform("x86_64-windows", "win64", ".dll", "x86_64-windows-gnu"),
        Platform("x86_64-darwin", "darwin64", ".dylib", "x86_64-macos.11.0"),
        Platform("aarch64-darwin", "darwin64", ".dylib", "aarch64-macos.11.0"),
    )
}
# Neither FMI 3.0.2 nor 2.0.5 has a tuple for WebAssembly, and leave it to vendors to add names. The draft of a standard
# for it (FMI-LS-WASM) puts components with an interface of their own into wasm32-wasip2; this is a module with the C
# functions of FMI, and must not be taken for one.
WASM = Platform("wasm32-wasi", "wasm32-wasi", ".wasm", "wasm32-wasi")
PROCESSORS = {"x86_64": "x86_64", "amd64": "x86_64", "aarch64": "aarch64", "arm64": "aarch64"}


def host_platform() -> Platform:
    """This machine, to be compiled for by its own compiler."""
    system, processor = machine.system(), machine.machine()
    name = f"{PROCESSORS.get(processor.lower(), processor)}-{system.lower()}"
    if name not in PLATFORMS:
        raise BuildError(f"platform {name}: no FMU can be built for it; known are {', '.join(PLATFORMS)}")
    return replace(PLATFORMS[name], zig_target=None)


def named_platforms(names: Sequence[str]) -> tuple[Platform, ...]:
    """Platforms by name, each once, in the order of the table; "all" is all of it, "host" this machine, "wasm" beside.

    "host" alone is compiled for by this machine's own compiler, and runs on systems as new as this one. Among others
    it gets what they get: zig, and the oldest system that the table names.
    """
    allowed = ("host", "all", *PLATFORMS, "wasm")
    for name in names:
        if name not in allowed:
            raise BuildError(f"platform {name!r} is not known: allowed are {', '.join(allowed)}")
    if not names:
        raise BuildError("no platform is named")
    if set(names) == {"host"}:
        return (host_platform(),)
    chosen = {host_platform().name if name == "host" else name for name in names}
    native = tuple(p for p in PLATFORMS.values() if p.name in chosen or "all" in chosen)
    return (*native, WASM) if "wasm" in chosen else native


def zig_compiler() -> list[str] | None:
    """The command of the C compiler that the package ziglang ships; None where that is not installed."""
    spec = importlib.util.find_spec("ziglang")
    if spec is None or spec.origin is None:
        return None
    return [str(Path(spec.origin).parent / ("zig.exe" if os.name == "nt" else "zig")), "cc"]


def compiler() -> list[str]:
    """This machine's C compiler: the environment variable CC, a path or a command with options, else cc, else zig's."""
    text = os.environ.get("CC") or "cc"
    command = [text] if shutil.which(text) else _words("CC", text)
    if command and shutil.which(command[0]) is not None:
        return command
    zig = zig_compiler()
    if zig is None or os.environ.get("CC"):
        name = command[0] if command else text
        raise BuildError(f"no C compiler: {name!r} was not found; install gcc or clang, or set CC to a C11 compiler")
    return zig


def compilers(platforms: Sequence[Platform]) -> Iterator[str]:
    """What compiles for each platform: the command and, of this machine's own compiler, all that it says of itself.

    That is its version, where it looks for its parts, and what -march=native means here. zig has the version of its
    package, and knows nothing of this machine. Raises BuildError where there is none.
    """
    for platform in platforms:
        command = _command(platform, "")
        yield from (platform.name, *command)
        if platform.zig_target is None:
            asked = [*command, "-###", "-E", "-xc", os.devnull]
            told = subprocess.run(asked, capture_output=True, text=True, errors="replace", check=False)
            where = os.path.realpath(shutil.which(command[0]) or command[0])
            yield from (told.stdout, told.stderr, where, str(os.stat(where).st_mtime_ns))
    yield from (f"{name}={os.environ.get(name)}" for name in ENVIRONMENT)


def _words(variable: str, text: str) -> list[str]:
    """The words of an environment variable; in quotes they may hold spaces, as in a shell."""
    try:
        return shlex.split(text, posix=os.name != "nt")  # where a backslash is no quote
    except ValueError as error:
        raise BuildError(f"{variable} is {text!r}, which is no command: {error}") from None


def compile_library(folder: Path, library: Path, platform: Platform) -> None:
    """Compile the C files of ``folder`` (model, runtime and facade), as one unit, to the shared library ``library``.

    The bytes depend on the sources, the platform, the compiler and, for this machine, the environment variable CFLAGS
    alone: names of files given to the compiler are relative to ``folder``. What a linker leaves beside the library
    (import library, debug symbols) is dropped.
    """
    sources = sorted(file.name for file in folder.glob("*.c"))
    with tempfile.TemporaryDirectory(prefix="fmu_build-cache-") as cache:
        # Objects are of no further use; what lasts is zig's own cache of the targets' C libraries.
        environment = {"ZIG_LOCAL_CACHE_DIR": cache, **os.environ}
        linked = Path(f"link-{platform.name}") / library.name
        (folder / linked).parent.mkdir()
        try:
            unit = linked.with_name("unit.c")
            (folder / unit).write_text("".join(f'#include "{source}"\n' for source in sources), encoding="utf-8")
            command = [*_command(platform, library.name), "-I.", unit.as_posix()]
            command += ["-o", linked.as_posix(), *([] if platform.suffix == ".dll" else ["-lm"])]
            _run(command, folder, environment)
            if not (folder / linked).is_file():
                raise BuildError(f"{command[0]} made no library: set CC to a C11 compiler")
            library.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(folder / linked, library)
        finally:
            shutil.rmtree((folder / linked).parent)


def _command(platform: Platform, library: str) -> list[str]:
    linking = {
        ".so": [*SHARED, *ELF],
        ".dll": [*SHARED],
        ".dylib": [*SHARED, f"-Wl,-install_name,@rpath/{library}"],
        ".wasm": [*WEBASSEMBLY],
    }[platform.suffix]
    if platform.zig_target is None:
        return [*compiler(), *OPTIONS, *_words("CFLAGS", os.environ.get("CFLAGS", "")), *linking]
    zig = zig_compiler()
    if zig is None:
        raise BuildError(f"platform {platform.name}: the package ziglang, which compiles for it, is not installed")
    return [*zig, "-target", platform.zig_target, "-s", *OPTIONS, *linking]


def _run(command: list[str], folder: Path, environment: dict[str, str]) -> None:
    result = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    if result.returncode != 0:
        lines = result.stderr.splitlines()
        first = next((line for line in lines if "error" in line), lines[0] if lines else f"status {result.returncode}")
        files = re.findall(r"([\w.-]+\.[ch]):\d+", first)
        if files and (folder / files[0]).is_file():
            raise BuildError(f"fmu_build has made C that does not compile, a defect of its, please report it: {first}")
        raise BuildError(f"{Path(command[0]).name} failed: {first}")
