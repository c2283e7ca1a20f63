"""The library in WebAssembly, under Node, beside this machine's: results, messages, memory."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
import zipfile
from collections.abc import Mapping
from importlib.metadata import version
from itertools import pairwise
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
from fmpy.fmi3 import FMU3Slave
from fmpy.validation import validate_fmu
from numpy.typing import NDArray

from fmu_build.fmu.compile import HEADERS, WASM, zig_compiler
from fmu_build.pipeline import build
from overrun_hitch.parameters import FIGURES
from tests.kept import kept
from tests.platforms.conftest import OUTPUTS

HOST = Path(__file__).with_name("wasm_host.mjs")
FOLDER = f"binaries/{WASM.fmi3_folder}"
HOSTS_OWN = {"memory", "__indirect_function_table", "__stack_pointer", "_initialize", "malloc", "free"}
JUMPS = """model Jumps "Time events, state events, and functions that C's library computes"
  output Real h(start = 1, fixed = true) "Height of a ball";
  output Real v(start = 0, fixed = true) "Its speed";
  output Real held(start = 0, fixed = true) "Sampled";
  output Real curve = exp(-h) * sin(5 * time) + tanh(v) + log(2 + h) + atan(v) + (1 + h) ^ 1.3;
equation
  der(h) = v;
  der(v) = -9.81 + 0.1 * cos(3 * time);
  when h < 0 then
    reinit(v, -0.8 * pre(v));
  end when;
  when sample(0.05, 0.1) then
    held = curve;
  end when;
end Jumps;
"""

pytestmark = [
    pytest.mark.platforms,
    pytest.mark.skipif(shutil.which("node") is None, reason="Node (node) is not installed"),
    pytest.mark.skipif(zig_compiler() is None, reason="the package ziglang is not installed"),
]


def built(library: Path, fmi: int) -> Path:
    """CarTrailer.fmu for this machine and WebAssembly."""

    def make(folder: Path) -> None:
        fmu = folder / "CarTrailer.fmu"
        build(library, "OverrunHitch.Systems.CarTrailer", fmu, fmi, ("host", "wasm"), references=False)

    return kept(make, "CarTrailer, host and wasm", str(fmi), version("ziglang")) / "CarTrailer.fmu"


@pytest.fixture(scope="module")
def car_trailer(modelica_library: Path) -> Path:
    return built(modelica_library, 3)


@pytest.fixture(scope="module")
def jumps(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("jumps")
    (folder / "Jumps.mo").write_text(JUMPS)
    build(folder / "Jumps.mo", "Jumps", folder / "Jumps.fmu", 3, ("host", "wasm"))
    return folder / "Jumps.fmu"


def in_wasm(
    fmu: Path, folder: Path, values: Mapping[str, float], outputs: tuple[str, ...], times: list[float], cycles: int = 0
) -> dict[str, Any]:
    """What the host finds, its rows as arrays (times, outputs)."""
    description = fmpy.read_model_description(str(fmu))
    references = {v.name: v.valueReference for v in description.modelVariables}
    with zipfile.ZipFile(fmu) as archive:
        module = Path(archive.extract(f"{FOLDER}/{fmu.stem}.wasm", folder))
    job = folder / "job.json"
    job.write_text(
        json.dumps(
            {
                "token": description.instantiationToken,
                "set": [[references[name], value] for name, value in values.items()],
                "outputs": [references[name] for name in outputs],
                "times": times,
                "cycles": cycles,
            }
        )
    )
    done = subprocess.run(["node", str(HOST), str(module), str(job)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    found: dict[str, Any] = json.loads(done.stdout)
    return found | {name: np.array(found[name], float) for name in ("rows", "again")}


def natively(
    fmu: Path, folder: Path, values: Mapping[str, float], outputs: tuple[str, ...], times: list[float]
) -> NDArray[np.float64]:
    """The same rows from this machine's library."""
    description = fmpy.read_model_description(str(fmu))
    references = {v.name: v.valueReference for v in description.modelVariables}
    unpacked = fmpy.extract(str(fmu), unzipdir=str(folder / "unpacked"))
    unit = FMU3Slave(
        unzipDirectory=unpacked,
        modelIdentifier=fmu.stem,
        instanceName="unit",
        guid=description.instantiationToken,
    )
    unit.instantiate()
    unit.enterInitializationMode(tolerance=1e-6)
    unit.setFloat64([references[name] for name in values], list(values.values()))
    unit.exitInitializationMode()
    wanted = [references[name] for name in outputs]
    rows = [unit.getFloat64(wanted)]
    for time, then in pairwise(times):
        unit.doStep(time, then - time)
        rows.append(unit.getFloat64(wanted))
    unit.freeInstance()
    return np.array(rows)


def differences(ours: NDArray[np.float64], other: NDArray[np.float64]) -> float:
    """The largest difference over the largest value of its column, printed."""
    assert ours.shape == other.shape
    worst = float((np.abs(other - ours) / np.abs(ours).max(axis=0)).max())
    print(f"{int((other == ours).sum())} of {ours.size} values bit-equal, largest difference {worst:.1e}")
    return worst


@pytest.mark.parametrize("figure", ["6a", "8", "10"])
def test_the_figures_are_those_of_this_machine(figure: str, car_trailer: Path, tmp_path: Path) -> None:
    scenario = FIGURES[figure]
    values = {**scenario.parameters.model_dump(), "brake_torque": scenario.brake_torque}
    times = [i / 100 for i in range(601)]
    found = in_wasm(car_trailer, tmp_path, values, OUTPUTS, times)
    assert differences(natively(car_trailer, tmp_path, values, OUTPUTS, times), found["rows"]) <= 1e-12
    assert np.array_equal(found["again"], found["rows"][-len(found["again"]) :])  # from a saved state, to the bit


def test_events_are_those_of_this_machine(jumps: Path, tmp_path: Path) -> None:
    times, names = [i / 50 for i in range(101)], ("h", "v", "held", "curve")
    found = in_wasm(jumps, tmp_path, {}, names, times)
    rows = found["rows"]
    assert (np.diff(rows[:, 1]) > 1).sum() >= 3 and len(np.unique(rows[:, 2])) >= 19  # it bounces, and is sampled
    assert differences(natively(jumps, tmp_path, {}, names, times), rows) <= 1e-12
    assert np.array_equal(found["again"], rows[-len(found["again"]) :])


@pytest.mark.parametrize("fmi", [2, 3])
def test_what_a_host_is_given(fmi: int, modelica_library: Path) -> None:
    """No import at all: nothing has to be provided. FMI's functions, memory, and where callbacks go."""
    script = """const module = new WebAssembly.Module(require("fs").readFileSync(0));
    const names = (list) => list.map((item) => item.name);
    console.log(JSON.stringify([WebAssembly.Module.imports(module), WebAssembly.Module.exports(module)].map(names)));"""
    with zipfile.ZipFile(built(modelica_library, fmi)) as archive:
        module = archive.read(f"{FOLDER}/CarTrailer.wasm")
    imports, exports = json.loads(subprocess.run(["node", "-e", script], input=module, stdout=-1, check=True).stdout)
    header = (HEADERS / f"fmi{fmi}" / f"fmi{fmi}Functions.h").read_text(encoding="utf-8")
    standard = set(re.findall(rf"^#define (fmi{fmi}\w+) +fmi{fmi}FullName\(", header, re.MULTILINE))
    assert len(standard) > 40 and set(exports) == standard | HOSTS_OWN
    assert imports == []


def test_memory_is_freed(car_trailer: Path, tmp_path: Path) -> None:
    found = in_wasm(car_trailer, tmp_path, {}, OUTPUTS, [0.0, 0.1], cycles=200)
    assert found["version"] == "3.0" and found["grown"] == 0


def test_errors_come_through_the_callback(car_trailer: Path, tmp_path: Path) -> None:
    found = in_wasm(car_trailer, tmp_path, {}, OUTPUTS, [0.0, 0.1])
    assert found["refused"] == 3 and found["stranger"] == 0  # fmi3Error; no instance under another's token
    refused, stranger = found["messages"]
    assert refused[:3] == stranger[:3] == [4711, 3, "logStatusError"]  # the environment is the caller's own
    assert "step" in refused[3] and "instantiation token" in stranger[3]


def test_fmi_2_by_its_own_host(modelica_library: Path, car_trailer: Path, tmp_path: Path) -> None:
    """The same end of figure 8 as by FMI 3, and the logger with its variable number of arguments."""
    fmu = built(modelica_library, 2)
    description = fmpy.read_model_description(str(fmu))
    references = {v.name: str(v.valueReference) for v in description.modelVariables}
    with zipfile.ZipFile(fmu) as archive:
        module = archive.extract(f"{FOLDER}/CarTrailer.wasm", tmp_path)
    host = str(HOST.with_name("wasm_host_fmi2.mjs"))
    command = ["node", host, module, description.guid, references["brake_torque"], references["compression"]]
    found = json.loads(subprocess.run(command, stdout=-1, check=True).stdout)
    times = [i / 100 for i in range(601)]
    rows = in_wasm(car_trailer, tmp_path, {"brake_torque": 1000.0}, ("compression",), times)["rows"]
    assert found["value"] == rows[-1, 0] != 0.0 and found["refused"] == 3
    ((*place, message),) = found["messages"]
    assert place == [4711, "unit", 3, "logStatusError", "%s"] and "step" in message


@pytest.mark.parametrize("fmi", [2, 3])
def test_the_checkers_find_nothing(fmi: int, modelica_library: Path) -> None:
    fmu = built(modelica_library, fmi)
    assert validate_fmu(str(fmu)) == []
    command = [str(Path(sys.executable).with_name("fmutool")), "-input", str(fmu), "-check"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    report = done.stdout + done.stderr
    assert f"compliant with FMI-{fmi}.0" in report and "WARNING" not in report and "ERROR" not in report


def test_two_builds_are_the_same_bytes(car_trailer: Path, modelica_library: Path, tmp_path: Path) -> None:
    again = tmp_path / "CarTrailer.fmu"
    build(modelica_library, "OverrunHitch.Systems.CarTrailer", again, 3, ("wasm",), references=False)
    with zipfile.ZipFile(car_trailer) as one, zipfile.ZipFile(again) as other:
        name = f"{FOLDER}/CarTrailer.wasm"
        assert [entry for entry in other.namelist() if entry.startswith("binaries/")] == [name]
        module = other.read(name)
        assert one.read(name) == module
    for place in (tmp_path.parts[1], str(Path.home()), Path(__file__).parts[1]):
        assert f"/{place.lstrip('/')}/".encode() not in module
