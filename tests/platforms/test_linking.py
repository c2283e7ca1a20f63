"""Several units in one program: their sources linked into it, and their libraries loaded side by side."""

from __future__ import annotations

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
import lief
import pytest

from fmu_build.fmu.compile import HEADERS, compiler

HERE = Path(__file__).parent
NAMES = {
    "Car": ("brake_torque", "F_hitch", "v_car", "a_car"),
    "Trailer": ("v_car", "a_car", "compression", "F_hitch_hold"),
    "CarTrailer": ("brake_torque", "compression"),
}


@pytest.fixture(scope="module")
def units(car_trailer_fmus: dict[int, Path], pair_fmus: dict[int, dict[str, Path]]) -> dict[tuple[str, int], Path]:
    pairs = {(name, fmi): path for fmi, paths in pair_fmus.items() for name, path in paths.items()}
    return pairs | {("CarTrailer", fmi): path for fmi, path in car_trailer_fmus.items()}


def described(units: dict[tuple[str, int], Path]) -> str:
    """units.h: tokens, and value references by unit and name; these are the same in both versions of FMI."""
    short = {"Car": "CAR", "Trailer": "TRAILER", "CarTrailer": "WHOLE"}
    lines = []
    for (name, fmi), path in units.items():
        description = fmpy.read_model_description(str(path))
        lines.append(f'#define {short[name]}_{fmi} "{description.guid}"')
        references = {v.name: v.valueReference for v in description.modelVariables}
        lines += [f"#define {short[name]}_{variable.upper()} {references[variable]}" for variable in NAMES[name]]
    return "\n".join(sorted(set(lines))) + "\n"


@pytest.mark.full
def test_the_sources_of_six_units_make_one_program(units: dict[tuple[str, int], Path], tmp_path: Path) -> None:
    """Car and trailer, coupled there by the force to hold, move as the whole does."""
    objects = []
    for (name, fmi), path in units.items():
        folder = tmp_path / f"{name}-{fmi}"
        with zipfile.ZipFile(path) as archive:
            archive.extractall(folder)
        sources = folder / "sources"
        files = sorted(file.name for file in sources.glob("*.c"))
        subprocess.run([*compiler(), "-std=c11", "-O0", "-Werror", "-c", *files], cwd=sources, check=True)
        objects.append(str(folder / "unit.a"))
        subprocess.run(["ar", "rc", objects[-1], *(f"{file[:-2]}.o" for file in files)], cwd=sources, check=True)
    (tmp_path / "units.h").write_text(described(units))
    headers = [f"-I{HEADERS / version}" for version in ("fmi2", "fmi3")]
    command = [
        *compiler(),
        "-std=c11",
        "-Wall",
        "-Wextra",
        "-Werror",
        f"-I{tmp_path}",
        *headers,
        str(HERE / "linked.c"),
    ]
    subprocess.run([*command, *objects, "-o", str(tmp_path / "linked"), "-lm"], check=True)
    result = subprocess.run([tmp_path / "linked"], capture_output=True, text=True, check=True)
    distances = [float(line) for line in result.stdout.split()]
    print(f"largest distance between pair and whole: {distances} m")
    assert len(distances) == 2 and distances[0] == distances[1] < 1e-6


LOADED_GLOBALLY = """
import ctypes, sys
from fmpy import read_model_description, extract
from fmpy.fmi2 import FMU2Slave
def load(path, folder):
    d = read_model_description(path)
    i = d.coSimulation.modelIdentifier
    slave = FMU2Slave(guid=d.guid, unzipDirectory=extract(path, folder), modelIdentifier=i)
    return slave
first = ctypes.CDLL(sys.argv[3], mode=ctypes.RTLD_GLOBAL)
unit = load(sys.argv[1], sys.argv[2])
unit.dll = ctypes.CDLL(sys.argv[4], mode=ctypes.RTLD_GLOBAL)
unit.instantiate()
unit.setupExperiment()
unit.enterInitializationMode()
unit.exitInitializationMode()
state = unit.getFMUstate()
data = unit.serializeFMUstate(state)
again = unit.deSerializeFMUstate(data)
assert bytes(unit.serializeFMUstate(again)) == bytes(data)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="RTLD_GLOBAL, as on Linux")
def test_libraries_loaded_globally_do_not_meet(units: dict[tuple[str, int], Path], tmp_path: Path) -> None:
    libraries = []
    for name in ("Car", "CarTrailer"):
        with zipfile.ZipFile(units[name, 2]) as archive:
            (place,) = (n for n in archive.namelist() if n.startswith("binaries/"))
            archive.extract(place, tmp_path / name)
        libraries.append(str(tmp_path / name / place))
    command = [sys.executable, "-c", LOADED_GLOBALLY, str(units["CarTrailer", 2]), str(tmp_path / "unit"), *libraries]
    result = subprocess.run(
        command, capture_output=True, text=True, check=False, env={**os.environ, "MALLOC_CHECK_": "3"}
    )
    assert result.returncode == 0, result.stderr


@pytest.mark.skipif(sys.platform != "linux", reason="reads ELF")
@pytest.mark.parametrize("fmi", [2, 3])
def test_only_the_standards_functions_are_exported_and_none_is_called_from_inside(
    units: dict[tuple[str, int], Path], fmi: int
) -> None:
    for name in NAMES:
        with zipfile.ZipFile(units[name, fmi]) as archive:
            (place,) = (n for n in archive.namelist() if n.startswith("binaries/"))
            library = lief.ELF.parse(list(archive.read(place)))
        assert library is not None
        exported = {symbol.name for symbol in library.exported_symbols}
        relocated = {relocation.symbol.name for relocation in library.relocations if relocation.symbol}
        assert exported and all(symbol.startswith(f"fmi{fmi}") for symbol in exported)
        assert not {symbol for symbol in relocated if symbol.startswith(("fmi2", "fmi3"))}


@pytest.mark.skipif(sys.platform != "linux", reason="reads ELF")
@pytest.mark.parametrize("fmi", [2, 3])
def test_an_old_system_will_do(units: dict[tuple[str, int], Path], fmi: int) -> None:
    """The library that this machine's compiler makes asks for no newer C library than those made for all systems."""
    for name in NAMES:
        with zipfile.ZipFile(units[name, fmi]) as archive:
            (place,) = (n for n in archive.namelist() if n.startswith("binaries/"))
            library = lief.ELF.parse(list(archive.read(place)))
        assert library is not None
        asked = {aux.name for needed in library.symbols_version_requirement for aux in needed.get_auxiliary_symbols()}
        versions = [tuple(map(int, text.removeprefix("GLIBC_").split("."))) for text in asked]
        assert versions and max(versions) <= (2, 17), asked
