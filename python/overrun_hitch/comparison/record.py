"""What a crosscheck leaves for the record: JSON with every number, tolerance, version and digest, and JUnit XML."""

from __future__ import annotations

import platform
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from lxml import etree

from overrun_hitch.comparison.crosscheck import LABELS, Comparison, Crosscheck
from overrun_hitch.comparison.distances import Allowed, Distance
from overrun_hitch.comparison.sources import Manoeuvre, Source
from overrun_hitch.experiments.torque import Torque
from overrun_hitch.measure.judged import Judged
from overrun_hitch.show.words import printable

PACKAGES = ("overrun-hitch", "fmpy", "numpy", "pyfunnel", "scipy", "xarray")
TOLERANCES = {  # as the modules tell them at length
    "variables": "funnel of --funnel of the range in A and --funnel-time to either side: our FMU at tolerances from "
    "1e-3 to 1e-6 stays within 0.02 %, a damper or spring 1 % off leaves it in every figure",
    "shunting growth": "0.001 1/s + 0.1 %: ten times closer than linear theory has to come, both solve the same "
    "equations",
    "shunting frequency": "0.01 %: likewise",
    "damping ratio": "follows from the two before",
    "passages": "--funnel-time: the wheels' time constant at 40 m/s is 40 times as long",
    "end of the run": "0: both are asked for the same duration",
}


@dataclass(frozen=True)
class Compared:
    """One of the files, when all has been run."""

    label: str
    name: str
    notes: tuple[str, ...]  # what had to be guessed
    provenance: dict[str, Any]


def compared(sources: Sequence[Source]) -> list[Compared]:
    """All of them, under their labels."""
    return [Compared(label, one.name, one.notes, one.provenance()) for label, one in zip(LABELS, sources, strict=False)]


def status(checks: Sequence[Crosscheck]) -> int:
    """The exit status: 2 if something could not be compared at all, else 1 if something differs, else 0."""
    comparisons = [comparison for check in checks for comparison in check.comparisons]
    if any(comparison.failure for comparison in comparisons):
        return 2
    return 1 if any(comparison.differing for comparison in comparisons) else 0


def document(
    checks: Sequence[Crosscheck],
    compared: Sequence[Compared],
    manoeuvres: Sequence[Manoeuvre],
    allowed: Allowed,
    paths: Sequence[Path],
) -> dict[str, Any]:
    """Every number and verdict for JSON, SI units. Its keys: docs/crosscheck.md."""
    return {
        "agrees": status(checks) == 0,
        "status": status(checks),
        "sources": [{"label": one.label, **one.provenance} for one in compared],
        "settings": {**manoeuvres[0].settings.model_dump(), **allowed.model_dump()},
        "tolerances": TOLERANCES,
        "versions": _versions(),
        "figures": [
            {
                "name": check.scenario.name,
                "brake_torque": check.scenario.brake_torque if not asked.torque else _knots(asked.torque),
                "duration": check.scenario.duration,
                "parameters": check.scenario.parameters.model_dump(),
                "comparisons": [_comparison(comparison) for comparison in check.comparisons],
            }
            for check, asked in zip(checks, manoeuvres, strict=True)
        ],
        "files": [str(path) for path in paths],
    }


def junit(checks: Sequence[Crosscheck], compared: Sequence[Compared]) -> bytes:
    """The verdicts as JUnit XML: a suite for each file but A, a case for each quantity of each figure."""
    root = etree.Element("testsuites", name="hitch crosscheck")
    for place, one in enumerate(compared[1:]):
        suite = etree.SubElement(root, "testsuite", name=printable(f"{one.label} {one.name}"))
        for check in checks:
            _add_cases(suite, check.scenario.name, check.comparisons[place])
        for key, tag in {"tests": "*", "failures": "*/failure", "errors": "*/error", "skipped": "*/skipped"}.items():
            suite.set(key, str(len(suite.findall(tag))))
    found: bytes = etree.tostring(root, xml_declaration=True, encoding="UTF-8", pretty_print=True)
    return found


def _add_cases(suite: Any, figure: str, comparison: Comparison) -> None:
    if comparison.failure:
        case = etree.SubElement(suite, "testcase", classname=figure, name="run")
        etree.SubElement(case, "error", message=printable(comparison.failure))
    rows: list[Distance | Judged] = [*comparison.distances, *comparison.numbers, *comparison.passages]
    for row in rows:
        name = row.variable if isinstance(row, Distance) else row.quantity
        case = etree.SubElement(suite, "testcase", classname=printable(figure), name=name)
        if row.differs:
            etree.SubElement(case, "failure", message=_words(row))
        elif row.not_judged:
            etree.SubElement(case, "skipped", message=printable(row.not_judged))


def _words(row: Distance | Judged) -> str:
    if isinstance(row, Distance):
        hint = f"; {row.hint}" if row.hint else ""
        return f"{row.largest:.6g} {row.unit} away at {row.at:g} s, allowed {row.allowed:.3g} {row.unit}{hint}"
    return f"{row.expected:.9g} and {row.found:.9g} {row.unit}, allowed {row.allowed:.3g} {row.unit}"


def _knots(torque: Torque) -> dict[str, list[float]]:
    return {"time": torque.time.tolist(), "brake_torque": torque.values.tolist()}


def _versions() -> dict[str, str]:
    found = {"python": platform.python_version(), "platform": platform.platform()}
    for name in PACKAGES:
        try:
            found[name] = version(name)
        except PackageNotFoundError:  # ours, run from its source
            found[name] = "not installed"
    return found


def _comparison(comparison: Comparison) -> dict[str, Any]:
    def row(judged: Distance | Judged) -> dict[str, Any]:
        return {**asdict(judged), "verdict": judged.verdict}

    def pair(judged: Judged) -> dict[str, Any]:
        return {**row(judged), "difference": judged.difference}

    return {
        "source": comparison.label,
        "agrees": not comparison.failure and not comparison.differing,
        "failure": comparison.failure,
        "not_compared": comparison.not_compared,
        "alignment": comparison.alignment and asdict(comparison.alignment),
        "variables": [row(distance) for distance in comparison.distances],
        "numbers": [pair(judged) for judged in comparison.numbers],
        "passages": [pair(judged) for judged in comparison.passages],
    }
