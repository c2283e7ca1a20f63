"""Everything in an FMU but the binaries: path in the archive to content. With the binaries' folders this is what
differs between FMI 2 and 3."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ..ir.models import TOKEN_PLACEHOLDER, CSources, FlatModel, Simulation
from . import xml_fmi2, xml_fmi3
from .archive import content_token
from .compile import HEADERS, RUNTIME
from .documentation import document
from .icon import draw_icon
from .interface import Interface
from .licences import licence_files
from .reference import reference_files
from .unit_header import how_to_build, unit_header

SOURCES = "sources/"


def contents(
    flat: FlatModel, interface: Interface, generated: CSources, references: Sequence[Simulation], fmi: int
) -> dict[str, bytes]:
    """The files of an FMI 2 or FMI 3 unit, with the hash of them all as its token."""
    sources = {file.name: file.read_bytes() for file in _runtime(fmi)}
    sources |= {name: text.encode() for name, text in generated.files.items()}
    shared = [content.decode() for name, content in sources.items() if name.endswith(".h")]
    sources["unit.h"] = unit_header(interface.identifier, fmi, shared).encode()
    sources |= {f"fmi{fmi}/{file.name}": file.read_bytes() for file in (HEADERS / f"fmi{fmi}").glob("*.h")}
    sources["README.txt"] = how_to_build(interface.identifier, fmi).encode()
    compiled = sorted(name for name in sources if name.endswith(".c"))
    icon = draw_icon(flat.icon, interface.identifier)
    if fmi == 2:
        picture = "model.png"
        files = {"modelDescription.xml": xml_fmi2.describe(interface, flat.claims, TOKEN_PLACEHOLDER, compiled)}
    else:
        picture = "terminalsAndIcons/icon.png"
        files = {
            "modelDescription.xml": xml_fmi3.describe(interface, flat.claims, TOKEN_PLACEHOLDER),
            "terminalsAndIcons/terminalsAndIcons.xml": xml_fmi3.describe_ports(interface),
            f"{SOURCES}buildDescription.xml": xml_fmi3.describe_build(interface.identifier, compiled),
        }
    files |= {f"{SOURCES}{name}": content for name, content in sources.items()}
    evidence = reference_files(interface, references)
    page = document(interface, flat.documentation, flat.claims, f"../{picture}", has_references=bool(evidence))
    files["documentation/index.html"] = page
    files |= licence_files(flat.claims, flat.name)
    files[picture] = icon
    files |= evidence
    token = content_token(files).encode()
    return {name: content.replace(TOKEN_PLACEHOLDER.encode(), token) for name, content in files.items()}


def _runtime(fmi: int) -> list[Path]:
    """The runtime with the facade of one version of the standard."""
    other = {2: "fmi3", 3: "fmi2"}[fmi]
    return sorted(file for file in RUNTIME.rglob("*.[ch]") if file.parent.name != other)
