"""Modelica to FMU: every stage in order, and nothing else."""

from __future__ import annotations

import tempfile
from pathlib import Path

from .archive import content_token, write_fmu
from .c_model import TOKEN_PLACEHOLDER, print_c
from .compile import RUNTIME, compile_library, host_platform
from .equations import derive
from .frontend import flatten
from .jacobian import differentiate
from .model_description import describe
from .sort import sort


def build(modelica: Path, class_name: str, output: Path) -> None:
    """Build the FMI 2.0 Co-Simulation FMU ``output`` of ``class_name`` in the file or library folder ``modelica``.

    Raises BuildError; then nothing is written.
    """
    identifier = class_name.rpartition(".")[2]
    flat = flatten(modelica, class_name)  # FlatModel: one class, flattened
    system = derive(flat)  # EquationSystem: equations, states, relations, parameters
    model = sort(system)  # SortedModel: assignments in the order of computation
    jacobian = differentiate(model)  # JacobianModel: exact partial derivatives
    generated = print_c(model, jacobian, identifier)  # CSources: variables.h, model.c

    sources = {file.name: file.read_bytes() for file in sorted(RUNTIME.glob("*.[ch]"))}
    sources |= {name: text.encode() for name, text in generated.files.items()}
    token = content_token({**sources, "modelDescription.xml": describe(model, identifier, TOKEN_PLACEHOLDER)})
    sources = {name: text.replace(TOKEN_PLACEHOLDER.encode(), token.encode()) for name, text in sources.items()}

    folder, suffix = host_platform()
    with tempfile.TemporaryDirectory(prefix="fmu_build-") as work:
        for name, text in sources.items():
            (Path(work) / name).write_bytes(text)
        library = Path(work) / f"{identifier}{suffix}"
        compile_library(Path(work), library)
        files = {
            "modelDescription.xml": describe(model, identifier, token),
            f"binaries/{folder}/{library.name}": library.read_bytes(),
        }
    write_fmu(output, files)
