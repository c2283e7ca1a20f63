"""What the page needs of an FMI 3 FMU: ``python web/unit.py NAME.fmu FOLDER``.

It writes NAME.wasm, NAME.json and the licences of what is in the former.
"""

from __future__ import annotations

import argparse
import json
import zipfile
from importlib.resources import files
from pathlib import Path
from typing import Any

import fmpy

from fmu_build.fmu.compile import WASM

LICENCES = "documentation/licenses/"
# Of the C library that zig links into a module of WebAssembly, by their places in zig's package.
C_LIBRARY = "lib/libc/wasi"
C_LIBRARY_LICENCES = ("LICENSE", "LICENSE-MIT", "libc-top-half/musl/COPYRIGHT", "libc-bottom-half/cloudlibc/LICENSE")


def describe(fmu: Path) -> dict[str, Any]:
    """Name, token and real variables: what src/unit.ts calls a Description."""
    description = fmpy.read_model_description(str(fmu))
    variables = {
        v.name: {
            "reference": v.valueReference,
            "causality": v.causality,
            "unit": v.unit,
            "start": _number(v.start),
            "min": _number(v.min),
            "max": _number(v.max),
            "description": v.description,
        }
        for v in description.modelVariables
        if v.type == "Float64"
    }
    return {"name": description.modelName, "token": description.instantiationToken, "variables": variables}


def _number(text: str | None) -> float | None:
    return None if text is None else float(text)


def write(fmu: Path, folder: Path) -> None:
    """Write these files. KeyError where the FMU has no library in WebAssembly."""
    with zipfile.ZipFile(fmu) as archive:
        module = archive.read(f"binaries/{WASM.fmi3_folder}/{fmu.stem}.wasm")
        licences = {Path(name).name: archive.read(name) for name in archive.namelist() if name.startswith(LICENCES)}
    for place in C_LIBRARY_LICENCES:
        name = f"{C_LIBRARY}/{place}".replace("/", "-")
        licences[name] = (files("ziglang") / C_LIBRARY / place).read_bytes()
    (folder / "licenses").mkdir(parents=True, exist_ok=True)
    for name, text in licences.items():
        (folder / "licenses" / name).write_bytes(text)
    (folder / f"{fmu.stem}.wasm").write_bytes(module)
    (folder / f"{fmu.stem}.json").write_text(json.dumps(describe(fmu)), encoding="utf-8")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("fmu", type=Path)
    parser.add_argument("folder", type=Path)
    arguments = parser.parse_args()
    write(arguments.fmu, arguments.folder)
