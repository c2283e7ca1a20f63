"""The folder documentation/licenses of an FMU: whose the model is, by its own word alone, and the runtime's licence."""

from __future__ import annotations

from pathlib import Path

from ..ir.models import Claims

PACKAGE = Path(__file__).parents[1]
FOLDER = "documentation/licenses"
RUNTIME = f"{FOLDER}/runtime.txt"
HEADERS = f"{FOLDER}/fmi-headers.txt"


def licence_files(claims: Claims, class_name: str) -> dict[str, bytes]:
    """Path in the archive to content; license.txt is where FMI has readers begin."""
    return {
        f"{FOLDER}/license.txt": _overview(claims, class_name).encode(),
        RUNTIME: (PACKAGE / "runtime" / "LICENSE").read_bytes(),
        HEADERS: (PACKAGE / "headers" / "LICENSE.txt").read_bytes(),
    }


def of_the_model(claims: Claims) -> str:
    """A sentence about the model."""
    said = [claims.copyright, claims.author and f"by {claims.author}", claims.license and f"licence: {claims.license}"]
    return "; ".join(filter(None, said)) or "its author's; no licence is stated"


def _overview(claims: Claims, class_name: str) -> str:
    return f"""The model {class_name}, and what was generated from it
(modelDescription.xml, the documentation, and in sources/ model.c, variables.h, unit.h, elimination.c, elimination.h):
{of_the_model(claims)}.

The runtime, which is all other C in sources/ and in the binaries: MIT License, see runtime.txt.

The headers of the FMI standard in sources/: 2-Clause BSD License, see fmi-headers.txt.
"""
