"""What the libraries ask of the systems that load them."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import lief
import pytest

from fmu_build.fmu.compile import PLATFORMS, WASM, Platform, compile_library
from fmu_build.pipeline import build

pytestmark = pytest.mark.platforms

FUNCTION = """#if defined _WIN32
__declspec(dllexport)
#else
__attribute__((visibility("default")))
#endif
int answer(void);
int answer(void) { return 42; }
"""


@pytest.fixture(scope="module")
def binaries(everywhere_fmu: Path, extracted: Callable[[Path], Path]) -> Path:
    return extracted(everywhere_fmu) / "binaries"


def test_fmi_2_has_a_folder_for_each_system(binaries: Path) -> None:
    assert sorted(str(path.relative_to(binaries)) for path in binaries.rglob("*.*")) == [
        "aarch64-linux/CarTrailer.so",
        "darwin64/CarTrailer.dylib",
        "linux64/CarTrailer.so",
        "win64/CarTrailer.dll",
    ]


@pytest.mark.parametrize("folder", ["linux64", "aarch64-linux"])
def test_linux_libraries_need_an_old_glibc_alone(binaries: Path, folder: str) -> None:
    library = lief.ELF.parse(str(binaries / folder / "CarTrailer.so"))
    assert library is not None
    assert set(library.libraries) <= {"libc.so.6", "libm.so.6"}
    assert not [e for e in library.dynamic_entries if isinstance(e, lief.ELF.DynamicEntryRunPath)]
    assert not [e for e in library.dynamic_entries if isinstance(e, lief.ELF.DynamicEntryRpath)]
    versions = [v.name for r in library.symbols_version_requirement for v in r.get_auxiliary_symbols()]
    print(folder, sorted(set(versions)))
    assert versions and all(tuple(map(int, re.findall(r"\d+", v))) <= (2, 17) for v in versions)
    exported = {s.name for s in library.exported_symbols}
    assert "fmi2DoStep" in exported and all(name.startswith("fmi2") for name in exported)


def test_the_windows_library_needs_the_system_alone(binaries: Path) -> None:
    library = lief.PE.parse(str(binaries / "win64" / "CarTrailer.dll"))
    assert library is not None
    needed = [i.name.lower() for i in library.imports]
    print(needed)
    assert all(name == "kernel32.dll" or name.startswith("api-ms-win-crt-") for name in needed)  # the latter: UCRT
    exported = {e.name for e in library.get_export().entries}
    assert "fmi2DoStep" in exported and all(name.startswith("fmi2") for name in exported)


def test_the_macos_library_is_one_for_both_processors(binaries: Path) -> None:
    both = lief.MachO.parse(str(binaries / "darwin64" / "CarTrailer.dylib"))
    assert both is not None
    assert [b.header.cpu_type for b in both] == [lief.MachO.Header.CPU_TYPE.X86_64, lief.MachO.Header.CPU_TYPE.ARM64]
    for binary in both:
        needed = [lib.name for lib in binary.libraries if lib.command == lief.MachO.LoadCommand.TYPE.LOAD_DYLIB]
        assert needed == ["/usr/lib/libSystem.B.dylib"]
        assert not binary.has_rpath and binary.build_version.minos[:2] == [11, 0]
        exported = {s.name for s in binary.exported_symbols} - {"___dso_handle", "__mh_dylib_header"}  # the linker's
        assert "_fmi2DoStep" in exported and all(name.startswith("_fmi2") for name in exported)
    assert both[1].has_code_signature  # Apple silicon loads nothing unsigned


def test_no_library_names_a_place_on_this_machine(binaries: Path, tmp_path: Path) -> None:
    for path in binaries.rglob("*.*"):
        content = path.read_bytes()
        for place in (tmp_path.parts[1], str(Path.home()), Path(__file__).parts[1]):
            assert f"/{place.lstrip('/')}/".encode() not in content, path


def test_two_builds_are_the_same_bytes(everywhere_fmu: Path, modelica_library: Path, tmp_path: Path) -> None:
    again = tmp_path / "CarTrailer.fmu"
    build(modelica_library, "OverrunHitch.Systems.CarTrailer", again, platforms=("all",))
    assert again.read_bytes() == everywhere_fmu.read_bytes()


@pytest.mark.parametrize("platform", [*PLATFORMS.values(), WASM], ids=lambda platform: platform.name)
def test_nothing_is_left_beside_a_library(everywhere_fmu: Path, tmp_path: Path, platform: Platform) -> None:
    del everywhere_fmu  # skips where zig is not installed
    (tmp_path / "a.c").write_text(FUNCTION)
    suffix = platform.suffix
    compile_library(tmp_path, tmp_path / "out" / f"M{suffix}", platform)
    assert sorted(str(p.relative_to(tmp_path)) for p in tmp_path.rglob("*")) == ["a.c", "out", f"out/M{suffix}"]
