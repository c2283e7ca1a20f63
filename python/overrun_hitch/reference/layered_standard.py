"""Reference results inside an FMU, as the layered standard FMI-LS-REF (1.0.0-alpha.1) has it, beside those in there.

For each case NAME.ssv (parameters), NAME_in.csv and NAME_ref.csv, as FMI Cross-Check names them.
"""

from __future__ import annotations

import csv
import io
import zipfile
from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np
from lxml import etree

from overrun_hitch.parameters import HitchError, Parameters
from overrun_hitch.reference.trajectories import Trajectory
from overrun_hitch.results import VARIABLES, values

FOLDER = "extra/org.fmi-standard.fmi-ls-ref/"
MANIFEST = f"{FOLDER}fmi-ls-manifest.xml"
SSV = "http://ssp-standard.org/SSP1/SystemStructureParameterValues"
DATE = (1980, 1, 1, 0, 0, 0)  # so that the same content is the same file


def with_references(fmu: Path, trajectories: Mapping[str, Trajectory]) -> bytes:
    """The FMU's content with these added. HitchError for one that has no manifest to add them to."""
    stream = io.BytesIO()
    with zipfile.ZipFile(fmu) as old, zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as new:
        if MANIFEST not in old.namelist():
            raise HitchError(f"{fmu} has no {MANIFEST}; allowed: an FMU that `make fmu` has built")
        manifest = etree.fromstring(old.read(MANIFEST))
        added = dict(_files(trajectories, manifest))
        for entry in old.infolist():
            if entry.filename not in (MANIFEST, *added):
                new.writestr(entry, old.read(entry), zipfile.ZIP_DEFLATED)
        added[MANIFEST] = etree.tostring(manifest, xml_declaration=True, encoding="UTF-8", pretty_print=True)
        for name, content in added.items():
            new.writestr(zipfile.ZipInfo(name, DATE), content, zipfile.ZIP_DEFLATED)
    return stream.getvalue()


def _files(trajectories: Mapping[str, Trajectory], manifest: etree._Element) -> Iterator[tuple[str, bytes]]:
    """Paths in the FMU and contents; each is entered in the manifest."""
    for name, one in trajectories.items():
        time, torque = values(one.run, "time"), one.scenario.brake_torque
        outputs = {variable: values(one.run, variable) for variable in VARIABLES}
        related = (
            (f"{name}.ssv", "application/x-ssp-parameter-set", "parameter", "parameters", _parameters(one)),
            (f"{name}_in.csv", "text/csv", "testcase", "inputs",
             _table({"time": time, "brake_torque": np.full_like(time, torque), "grade": np.zeros_like(time)})),
            (f"{name}_ref.csv", "text/csv", "result", "outputs", _table({"time": time, **outputs})),
        )  # fmt: skip
        for file, mime, role, what, content in related:
            details = {"type": mime, "source": file, "role": role, "description": f"{one.scenario.name}: {what}"}
            etree.SubElement(manifest, "Related", details)
            yield FOLDER + file, content


def _table(columns: Mapping[str, np.ndarray]) -> bytes:
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows([f"{value:.12g}" for value in row] for row in zip(*columns.values(), strict=True))
    return stream.getvalue().encode()


def _parameters(one: Trajectory) -> bytes:
    root = etree.Element(f"{{{SSV}}}ParameterSet", nsmap={"ssv": SSV}, version="1.0", name=one.scenario.name)
    listing = etree.SubElement(root, f"{{{SSV}}}Parameters")
    for name in Parameters.model_fields:
        parameter = etree.SubElement(listing, f"{{{SSV}}}Parameter", name=name)
        etree.SubElement(parameter, f"{{{SSV}}}Real", value=repr(getattr(one.scenario.parameters, name)))
    return etree.tostring(root, xml_declaration=True, encoding="UTF-8", pretty_print=True)
