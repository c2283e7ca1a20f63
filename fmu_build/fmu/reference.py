"""Reference results for an FMU: what another tool computed for examples that contain its class.

A class names them in its annotation ``__fmu_build(referenceExamples={"...", "..."})``.

Laid out as the layered standard FMI-LS-REF (1.0.0-alpha.1) has it, the trajectories as FMI Cross-Check names them:
``extra/org.fmi-standard.fmi-ls-ref`` with a manifest and, for each example, NAME_in.csv, NAME_ref.csv, NAME.ssv.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from lxml import etree

from ..errors import BuildError
from ..ir.models import Simulation
from .interface import GENERATION_TOOL, Interface
from .xml_common import to_bytes

FOLDER = "extra/org.fmi-standard.fmi-ls-ref/"
DOCUMENTATION = "documentation/fmi-ls-ref.txt"
MANIFEST = "http://fmi-standard.org/fmi-ls-manifest"
IDENTITY = {
    "fmi-ls-name": "org.fmi-standard.fmi-ls-ref",
    "fmi-ls-version": "1.0.0-alpha.1",
    "fmi-ls-description": "Layered Standard providing information on related files included in an FMU.",
}
SSV = "http://ssp-standard.org/SSP1/SystemStructureParameterValues"
INTRODUCTION = """Reference results
=================

{tool} simulated the Modelica classes below from the same sources as this unit: another compiler's back
end and another integrator. To repeat a run, set the parameters of NAME.ssv and the inputs of NAME_in.csv, and compare
the outputs with NAME_ref.csv. The files are in extra/org.fmi-standard.fmi-ls-ref/; units are those of the variables.

The accuracy is how far the results at its tolerances {coarse:g} and {fine:g} are apart; given is the latter.
"""


def reference_files(interface: Interface, simulations: Sequence[Simulation]) -> dict[str, bytes]:
    """The files by their path in the FMU; none without simulations. BuildError if one has no such unit in it."""
    if not simulations:
        return {}
    attributes = {f"{{{MANIFEST}}}{key}": value for key, value in IDENTITY.items()}
    manifest = etree.Element("fmiReferences", attributes, nsmap={"fmi-ls": MANIFEST})
    files: dict[str, bytes] = {}
    for simulation in simulations:
        for related in _related(interface, simulation):
            files[FOLDER + related.file] = related.content
            description = f"{simulation.class_name}: {related.what}"
            details = {"type": related.mime, "source": related.file, "role": related.role, "description": description}
            etree.SubElement(manifest, "Related", details)
    files[FOLDER + "fmi-ls-manifest.xml"] = to_bytes(manifest)
    files[DOCUMENTATION] = _explanation(interface, simulations).encode()
    return files


class _Related(NamedTuple):
    """A file beside the manifest: the role is one that the layered standard names."""

    file: str
    role: str
    mime: str
    what: str
    content: bytes


def _related(interface: Interface, simulation: Simulation) -> tuple[_Related, ...]:
    name, path = simulation.class_name.rpartition(".")[2], _path_of_unit(interface, simulation)
    values = _parameter_set(interface, simulation, path)
    inputs = _table(simulation, path, _names(interface, "input"))
    outputs = _table(simulation, path, _names(interface, "output"))
    return (
        _Related(f"{name}.ssv", "parameter", "application/x-ssp-parameter-set", "parameters", values),
        _Related(f"{name}_in.csv", "testcase", "text/csv", "inputs", inputs),
        _Related(f"{name}_ref.csv", "result", "text/csv", "outputs", outputs),
    )


def _explanation(interface: Interface, simulations: Sequence[Simulation]) -> str:
    first = simulations[0]
    text = INTRODUCTION.format(tool=first.tool, coarse=max(first.tolerances), fine=min(first.tolerances))
    for simulation in simulations:
        path = _path_of_unit(interface, simulation)
        text += f"\n{simulation.class_name}, accuracy of each output\n"
        for name in _names(interface, "output"):
            text += f"  {name:24} {simulation.accuracy[path + name]:.1e}\n"
    return text


def _names(interface: Interface, causality: str) -> list[str]:
    return [entry.name for entry in interface.entries if entry.causality == causality]


def _path_of_unit(interface: Interface, simulation: Simulation) -> str:
    """What stands before the unit's names in the example's: "component."."""
    needed = {*_names(interface, "input"), *_names(interface, "output")}
    paths = {column.partition(".")[0] + "." for column in simulation.columns}
    found = sorted(path for path in paths if all(path + name in simulation.columns for name in needed))
    if len(found) != 1:
        raise BuildError(
            f"{simulation.class_name} has {len(found)} components with the variables of {interface.name}, not 1"
        )
    return found[0]


def _table(simulation: Simulation, path: str, names: Iterable[str]) -> bytes:
    """Time and the unit's variables ``names`` as CSV, twelve digits: more than the accuracy that the results have."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    columns = {"time": simulation.times} | {name: simulation.columns[path + name] for name in names}
    writer.writerow(columns)
    writer.writerows([f"{value:.12g}" for value in row] for row in zip(*columns.values(), strict=True))
    return stream.getvalue().encode()


def _parameter_set(interface: Interface, simulation: Simulation, path: str) -> bytes:
    """All settable parameters, whether or not they differ from the unit's defaults: defaults may change."""
    root = etree.Element(
        f"{{{SSV}}}ParameterSet",
        nsmap={"ssv": SSV},
        version="1.0",
        name=simulation.class_name,
        generationTool=GENERATION_TOOL,
    )
    listing = etree.SubElement(root, f"{{{SSV}}}Parameters")
    for name in _names(interface, "parameter"):
        if (value := simulation.parameters.get(path + name)) is None:
            raise BuildError(f"{simulation.class_name}: {path}{name} is not a plain number")
        parameter = etree.SubElement(listing, f"{{{SSV}}}Parameter", name=name)
        etree.SubElement(parameter, f"{{{SSV}}}Real", value=repr(value))
    return to_bytes(root)
