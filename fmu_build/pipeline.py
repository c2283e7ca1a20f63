"""Modelica to FMU: every stage in order, and nothing else.

    flatten            Modelica text -> FlatModel: scalar variables, residuals, relations, when-clauses
    lower              FlatModel -> FlatModel: when-clauses and algorithms have become assignments
    derive             FlatModel -> EquationSystem: aliases gone, states chosen
    initialize         EquationSystem -> EquationSystem: as many equations at the start as unknowns there
    sort               EquationSystem -> SortedModel: assignments and loops in the order of computation
    differentiate      SortedModel -> JacobianModel: exact partial derivatives
    eliminate          places of the Jacobian's entries -> Elimination: order of pivots, pattern of the factors
    declare            FlatModel, SortedModel -> Ports: coupling and terminals, if the class declares some
    print_c            SortedModel, JacobianModel, Coupling -> CSources: variables.h, model.c
    print_elimination  Elimination -> CSources: elimination.h, elimination.c
    expose             SortedModel, Terminals -> Interface: variables in their roles, dependencies
    simulations        Modelica text -> Simulations: another tool's results
    contents           FlatModel, Interface, CSources, Simulations -> files: all of the FMU but its binaries
    binaries           files -> files: a library for each platform
    packed             files -> the FMU

The values in between are those of ``ir``.
"""

from __future__ import annotations

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
from .fmu.archive import check_output, packed, write
from .fmu.binaries import binaries
from .fmu.compile import Platform, named_platforms
from .fmu.contents import contents
from .fmu.interface import expose, model_identifier
from .fmu.ports import declare
from .frontend.flatten import flatten
from .frontend.simulate import simulations
from .ir.models import CSources
from .show import show_flat, show_jacobian, show_sorted


def build(
    modelica: Path,
    class_name: str,
    output: Path,
    fmi: int = 2,
    platforms: Sequence[str] = ("host",),
    progress: Callable[[str], object] = lambda _: None,
    references: bool = True,
    libraries: Sequence[Path] = (),
) -> None:
    """Build the FMU ``output`` of ``class_name`` in the file or library folder ``modelica``, for FMI version 2 or 3.

    ``platforms`` are names that ``named_platforms`` takes; ``progress`` is told the name of each stage that begins.
    Without ``references`` the results that another tool computed are left out. Other libraries are looked for in the
    folders ``libraries``, each a library or a folder with libraries in it.
    Raises BuildError; then nothing is written.
    """
    chosen = named_platforms(platforms)
    check_output(output)
    write(output, made(modelica, class_name, fmi, chosen, progress, references, libraries))


def made(
    modelica: Path,
    class_name: str,
    fmi: int,
    platforms: Sequence[Platform],
    progress: Callable[[str], object],
    references: bool = True,
    libraries: Sequence[Path] = (),
) -> bytes:
    """The FMU that ``build`` writes."""
    identifier = model_identifier(class_name)
    progress("reading Modelica")
    flat = flatten(modelica, class_name, libraries)
    progress("sorting equations")
    model = sort(initialize(derive(lower(flat))))
    progress("differentiating")
    jacobian = differentiate(model)
    elimination = eliminate(jacobian.entries, len(model.states))
    progress("printing C")
    ports = declare(flat, model)
    equations = print_c(model, jacobian, identifier, ports.coupling)
    algebra = print_elimination(elimination)
    generated = CSources(equations.files | algebra.files)
    progress("describing")
    interface = expose(model, jacobian, identifier, ports)
    examples = flat.examples if references else ()
    files = contents(flat, interface, generated, simulations(modelica, examples, libraries), fmi)
    compiled = binaries(files, identifier, platforms, fmi, progress)
    progress("packing")
    return packed(files | compiled)


def show(modelica: Path, class_name: str, stage: str, libraries: Sequence[Path] = ()) -> str:
    """What a stage makes of ``class_name``, as text for a person: ``flat``, ``sorted``, ``jacobian`` or ``c``.

    Raises BuildError where a stage on the way fails.
    """
    flat = flatten(modelica, class_name, libraries)
    if stage == "flat":
        return show_flat(flat)
    model = sort(initialize(derive(lower(flat))))
    if stage == "sorted":
        return show_sorted(model)
    jacobian = differentiate(model)
    if stage == "jacobian":
        return show_jacobian(model, jacobian)
    coupling = declare(flat, model).coupling
    return print_c(model, jacobian, model_identifier(class_name), coupling).files["model.c"]
