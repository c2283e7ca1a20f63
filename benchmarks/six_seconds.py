"""Figure 8's six seconds in C: CPU time, its ratio to the arithmetic alone, steps, size and error."""

from __future__ import annotations

import subprocess
import zipfile
from collections import defaultdict
from pathlib import Path
from statistics import median

import fmpy
import numpy as np

from fmu_build.fmu.compile import OPTIONS, compiler
from overrun_hitch.parameters import FIGURES
from tests.oracles import radau

HERE = Path(__file__).parent
PROCESSES = 9  # each has its own layout of memory, which moves the times by some per cent
RUNS = 201
TOLERANCE = 1e-6  # the FMU's own
HEAD = """## What it takes in C

A C program drives the FMU's own sources through the FMI 2 functions in 600 steps of 10 ms and reads the compression
after each; medians of {runs} runs. The other side of the ratio, the arithmetic that a run takes (without the outputs at
the communication points), is measured between the runs.

"""


def linked(fmu: Path, folder: Path, source: str) -> Path:
    """A C program with the FMU's sources, which are one unit as they are in its library; all in the folder."""
    with zipfile.ZipFile(fmu) as archive:
        archive.extractall(folder)
    sources = folder / "sources"
    unit = folder / "unit.c"
    unit.write_text("".join(f'#include "{file.name}"\n' for file in sorted(sources.glob("*.c"))), encoding="utf-8")
    program = folder / Path(source).stem
    command = [*compiler(), *OPTIONS, "-fPIC", f"-I{sources}", str(HERE / source), str(unit), "-o", str(program), "-lm"]
    subprocess.run(command, check=True)
    return program


def compiled(fmu: Path, folder: Path) -> list[str]:
    """The C program's command but for tolerance and runs; it is made in the folder."""
    program = linked(fmu, folder, "six_seconds.c")
    description = fmpy.read_model_description(str(fmu))
    references = {v.name: str(v.valueReference) for v in description.modelVariables}
    return [str(program), description.guid, references["brake_torque"], references["compression"]]


def printed(command: list[str], tolerance: float, runs: int) -> dict[str, list[float]]:
    """What six_seconds.c prints: values by name."""
    output = subprocess.run([*command, f"{tolerance!r}", str(runs)], check=True, capture_output=True, text=True).stdout
    values = defaultdict(list)
    for line in output.splitlines():
        name, _, value = line.rpartition(" ")
        values[name].append(float(value))
    return values


def measure(command: list[str]) -> dict[str, list[float]]:
    """What PROCESSES of them print."""
    values = defaultdict(list)
    for _ in range(PROCESSES):
        for name, found in printed(command, TOLERANCE, RUNS).items():
            values[name] += found
    return values


def table(values: dict[str, list[float]]) -> tuple[list[str], bool]:
    """The report, and whether every requirement is met; what a machine's speed decides is told, not judged."""
    total, ratio = median(values["total"]), median(values["ratio"])
    size, steps, rejected, events, repeated = (
        int(values[name][0]) for name in ("bytes", "steps", "rejected", "events", "repeated")
    )
    oracle = radau.trajectory(FIGURES["8"].parameters).compression[::10]
    error = float(np.abs(np.reshape(values["compression"], (PROCESSES, -1)) - oracle).max())
    requirements = [
        ("CPU time over the arithmetic alone", f"{ratio:.2f}", "3", ratio <= 3.0),
        ("error of the compression", f"{error:.1e} m", "2e-6 m", error <= 2e-6),
        ("size of an instance", f"{size} bytes", "65536 bytes", size < 65536),
        ("rejected steps / steps", f"{rejected} / {steps}", "1 / 10", 10 * rejected < steps),
    ]
    lines = ["| | measured | at most | |", "|---|---|---|---|"]
    lines += [f"| {n} | {m} | {limit} | {'met' if met else 'NOT MET'} |" for n, m, limit, met in requirements]
    lines += ["", f"CPU time: {1e3 * total:.3f} ms. Events: {events}; steps repeated to end at one: {repeated}.", ""]
    lines += ["| arithmetic | times | each | together |", "|---|---|---|---|"]
    for name in (name for name in values if ":" in name):
        kind, _, times = name.partition(":")
        together = median(values[name])
        lines.append(f"| {kind} | {times} | {1e9 * together / int(times):.1f} ns | {1e3 * together:.3f} ms |")
    return lines, all(met for *_, met in requirements)


def section(fmu: Path, folder: Path) -> tuple[str, bool]:
    """The report's section, and whether every requirement is met; the FMU is unpacked in the folder."""
    lines, met = table(measure(compiled(fmu, folder)))
    return HEAD.format(runs=PROCESSES * RUNS) + "\n".join([*lines, ""]), met
