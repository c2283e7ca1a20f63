"""Modelica to FMU: every stage in order, and nothing else."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

from .codegen.elimination import print_elimination
from .codegen.model import print_c
from .equations.derive import derive
from .equations.elimination import eliminate
from .equations.initialize import initialize
from .equations.jacobian import differentiate
from .equations.lower import lower
from .equations.sort import sort
from .fmu.archive import content_token, write_fmu
from .fmu.compile import compile_library, named_platforms
from .fmu.contents import SOURCES, contents
from .fmu.fat_mach_o import universal
from .fmu.interface import expose
from .fmu.ports import declare
from .frontend.flatten import flatten
from .frontend.simulate import simulate
from .ir.models import TOKEN_PLACEHOLDER, CSources


def build(
    modelica: Path,
    class_name: str,
    output: Path,
    fmi: int = 2,
    platforms: Sequence[str] = ("host",),
    progress: Callable[[str], object] = lambda _: None,
    references: bool = True,
) -> None:
    """Build the FMU ``output`` of ``class_name`` in the file or library folder ``modelica``, for FMI version 2 or 3.

    ``platforms`` are names that ``named_platforms`` takes; ``progress`` is told the name of each stage that begins.
    Without ``references`` the results that another tool computed are left out.
    Raises BuildError; then nothing is written.
    """
    chosen = named_platforms(platforms)
    identifier = class_name.rpartition(".")[2]
    progress("reading Modelica")
    flat = flatten(modelica, class_name)  # FlatModel: one class, flattened
    progress("sorting equations")
    plain = lower(flat)  # FlatModel: when-clauses and algorithms have become assignments
    system = derive(plain)  # EquationSystem: equations, states, relations, parameters
    system = initialize(system)  # EquationSystem: with as many equations at the start as unknowns
    model = sort(system)  # SortedModel: assignments in the order of computation
    progress("differentiating")
    jacobian = differentiate(model)  # JacobianModel: exact partial derivatives
    elimination = eliminate(jacobian.entries, len(model.states))  # Elimination: pivots, pattern of the factors
    progress("printing C")
    ports = declare(flat, model)  # Ports: coupling and terminals, if the class declares some
    equations = print_c(model, jacobian, identifier, ports.coupling)  # CSources: variables.h, model.c
    algebra = print_elimination(elimination)  # CSources: elimination.h, elimination.c
    generated = CSources(equations.files | algebra.files)
    interface = expose(model, identifier, ports.terminals)  # Interface: variables in their roles, dependencies

    progress("describing")
    examples = flat.examples if references else ()
    simulations = [simulate(modelica, example) for example in examples]  # Simulation: another tool's results
    files = contents(flat, interface, generated, simulations, fmi)  # everything but the binaries
    token = content_token(files).encode()
    files = {name: content.replace(TOKEN_PLACEHOLDER.encode(), token) for name, content in files.items()}

    libraries: dict[str, list[bytes]] = {}  # by place in the FMU; those for macOS may share one
    with tempfile.TemporaryDirectory(prefix="fmu_build-") as work:
        for name, content in files.items():
            if name.startswith(SOURCES):
                (Path(work) / name.removeprefix(SOURCES)).write_bytes(content)
        for platform in chosen:
            progress(f"compiling for {platform.name}")
            library = Path(work) / f"{identifier}{platform.suffix}"
            compile_library(Path(work), library, platform)
            folder = platform.fmi2_folder if fmi == 2 else platform.fmi3_folder
            libraries.setdefault(f"binaries/{folder}/{library.name}", []).append(library.read_bytes())
    progress("packing")
    files |= {place: universal(same) for place, same in libraries.items()}
    write_fmu(output, files)
