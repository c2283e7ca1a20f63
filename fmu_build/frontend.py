"""Modelica text to a FlatModel. Every touch of rumoca is in this module.

rumoca (pinned exactly, see docs/dependencies.md) parses, resolves, checks and flattens. We read its flat form, a JSON
tree. Two of its habits are handled here: many of its errors carry no place, so we look the offending name up in the
sources; and it reads every .mo file beside the one it is given, as Modelica's directory rules allow.
"""

from __future__ import annotations

import re
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
import rumoca
import sympy
from numpy.typing import NDArray

from .annotations import (
    class_text,
    read_couplings,
    read_documentation,
    read_examples,
    read_experiment,
    read_icon,
    read_terminals,
)
from .errors import BuildError
from .expressions import ExpressionReader, Sources, unwrap
from .ir import Equation, FlatModel, Simulation, Variable

UNSUPPORTED_SECTIONS = {
    "initial_equations": "initial equations",
    "algorithms": "algorithm sections",
    "initial_algorithms": "initial algorithm sections",
    "when_chains": "when equations",
    "assert_equations": "assert",
    "initial_assert_equations": "assert",
    "functions": "functions",
}
REFERENCE_TOLERANCES = (1e-9, 1e-11)  # relative; the difference between the two tells the accuracy
STATE_SELECT = {"Never": -2, "Avoid": -1, "Default": 0, "Prefer": 1, "Always": 2}


def flatten(path: Path, class_name: str) -> FlatModel:
    """The class ``class_name`` of the Modelica file or library folder ``path``, flattened.

    Raises BuildError, with file and line, where the Modelica does not compile or uses what is not supported.
    """
    model, sources = _load(path, class_name)
    flat = model.to_dict("flat")
    _refuse_unsupported_sections(flat, sources)
    reader = ExpressionReader(sources)
    constants = _constants(flat["variables"], reader)
    variables = tuple(_variable(node, flat, reader, constants) for node in flat["variables"].values())
    equations = tuple(
        Equation(reader.read(node["residual"]).xreplace(constants), _equation_origin(node, sources))
        for node in flat["equations"]
    )
    text = class_text(class_name, sources.texts())
    return FlatModel(
        name=class_name,
        description=flat["model_description"] or "",
        variables=tuple(v for v in variables if v.variability != "constant"),
        equations=equations,
        relations=tuple(reader.relations),
        experiment=read_experiment(text),
        documentation=read_documentation(text),
        icon=read_icon(text),
        couplings=read_couplings(text),
        terminals=read_terminals(text),
        examples=read_examples(text),
    )


def simulate(path: Path, class_name: str) -> Simulation:
    """rumoca's own simulation of the class ``class_name`` over the time of its experiment annotation.

    Raises BuildError where it does not compile, does not run, or has no experiment annotation.
    """
    model, sources = _load(path, class_name)
    experiment = read_experiment(class_text(class_name, sources.texts()))
    if experiment.stop_time is None or experiment.interval is None:
        raise BuildError(
            f"{class_name}: a reference needs StopTime and Interval in an experiment annotation of its own"
        )
    start = experiment.start_time or 0.0
    count = round((experiment.stop_time - start) / experiment.interval)
    times = np.linspace(start, experiment.stop_time, count + 1)
    coarse, fine = (_columns(model, times, tolerance) for tolerance in REFERENCE_TOLERANCES)
    return Simulation(
        class_name=class_name,
        tool=f"rumoca {version('rumoca')}",
        tolerances=REFERENCE_TOLERANCES,
        times=tuple(times.tolist()),
        columns={name: tuple(values.tolist()) for name, values in fine.items()},
        accuracy={name: float(np.abs(fine[name] - coarse[name]).max()) for name in fine},
        parameters={p.name: float(p.value) for p in model.parameters if p.value is not None},
    )


def _columns(model: rumoca.Model, times: NDArray[np.float64], tolerance: float) -> dict[str, NDArray[np.float64]]:
    """Every variable at ``times``. rumoca adds rows at its events, so rows are chosen by their time."""
    config = rumoca.SimConfig(solver="rk-like", rtol=tolerance, atol=tolerance, max_wall_seconds=60)
    try:
        result = model.simulate(t=(times[0], times[-1]), dt=times[1] - times[0], config=config)
    except rumoca.RumocaError as error:
        raise BuildError(f"{model.name}: its simulation failed: {str(error).splitlines()[0]}") from None
    rows = np.abs(np.asarray(result.time)[:, None] - times).argmin(axis=0)
    if np.abs(np.asarray(result.time)[rows] - times).max() > 1e-9 * (times[-1] - times[0]):
        raise BuildError(f"{model.name}: its simulation ended early, at {result.time[-1]:g} s")
    return {name: np.asarray(result[name])[rows] for name in result.names}


def _load(path: Path, class_name: str) -> tuple[rumoca.Model, Sources]:
    """The compiled class and its Modelica text."""
    entry = path / "package.mo" if path.is_dir() else path
    if not entry.is_file():
        raise BuildError(f"{entry}: no such Modelica file; give a .mo file or a library's folder with its package.mo")
    try:
        model = rumoca.Session().load(str(entry), model=class_name)
        files = model.to_dict("dae")["source_map"]["files"]
    except rumoca.RumocaError as error:
        raise BuildError(_located_message(error, entry, class_name)) from None
    return model, Sources({file_id: (name, text) for file_id, name, text in files}, root=entry.parent)


def _refuse_unsupported_sections(flat: dict[str, Any], sources: Sources) -> None:
    for key, what in UNSUPPORTED_SECTIONS.items():
        if content := flat.get(key):
            first = next(iter(content.values())) if isinstance(content, dict) else content[0]
            raise BuildError(f"{sources.find_place(first)}: {what}: not supported")


def _constants(nodes: dict[str, Any], reader: ExpressionReader) -> dict[sympy.Symbol, sympy.Expr]:
    """Values of Modelica constants: they are put in wherever their names stand."""
    constants: dict[sympy.Symbol, sympy.Expr] = {}
    for name, node in nodes.items():
        if unwrap(node["variability"]) == "Constant" and node["binding"] is not None:
            constants[sympy.Symbol(name, real=True)] = reader.read(node["binding"]).xreplace(constants)
    return constants


def _variable(
    node: dict[str, Any], flat: dict[str, Any], reader: ExpressionReader, constants: dict[sympy.Symbol, sympy.Expr]
) -> Variable:
    name, origin = node["name"], reader.sources.place(node["source_span"])
    if node["dims"]:
        raise BuildError(f"{origin}: array {name}: not supported, write scalar variables instead")
    type_name = flat["variable_type_names"].get(name, "Real")
    if type_name != "Real":
        raise BuildError(f"{origin}: {name} is of type {type_name}: only Real is supported")

    def expression(key: str) -> sympy.Expr | None:
        return None if node[key] is None else reader.read(node[key]).xreplace(constants)

    def number(key: str) -> float | None:
        value = expression(key)
        if value is not None and not value.is_number:
            raise BuildError(f"{origin}: {key} of {name} is {value}: only a number is supported")
        return None if value is None else float(value)

    is_top_level = "." not in name
    causality = unwrap(node["causality"]).lower()
    fixed = node["fixed"]
    return Variable(
        name=name,
        description=node["description"] or "",
        unit=node["unit"] or "",
        quantity=node["quantity"] or "",
        causality=causality if is_top_level and causality in {"input", "output"} else "local",
        variability={"Parameter": "parameter", "Constant": "constant"}.get(unwrap(node["variability"]), "continuous"),
        start=expression("start"),
        fixed=bool(fixed[0] if isinstance(fixed, list) else fixed),
        binding=expression("binding"),
        min=number("min"),
        max=number("max"),
        nominal=number("nominal"),
        hidden=bool(node["is_protected"]),
        final=bool(flat["variable_final_flags"].get(name, False)),
        state_select=STATE_SELECT[unwrap(node["state_select"])],
        origin=origin,
    )


def _equation_origin(node: dict[str, Any], sources: Sources) -> str:
    kind, detail = next(iter(node["origin"].items())) if isinstance(node["origin"], dict) else (node["origin"], {})
    if kind == "Connection":
        return f"connect({detail['lhs']}, {detail['rhs']})"
    if kind == "FlowSum":
        return str(detail["description"])
    return sources.place(node["span"])


def _located_message(error: Exception, entry: Path, class_name: str) -> str:
    """One line with file and line for a rumoca error."""
    first_line = str(error).splitlines()[0]
    message = re.sub(r"^\S+ could not be compiled: |^\w+ failed: \S+ failed in \w+: ", "", first_line)
    if place := re.search(r" \[(\S+:\d+):\d+\]", message):
        return f"{place.group(1)}: {message.replace(place.group(0), '')}"
    files = sorted(entry.parent.rglob("*.mo")) if entry.name == "package.mo" else [entry]
    for file in files:
        for diagnostic in rumoca.validate(str(file)):
            if place := re.search(r"\[(.+?:\d+):\d+\]", diagnostic.message):
                return f"{place.group(1)}: {message}"
    if name := re.search(r"'([^']+)'", message):
        word = re.compile(rf"(?<![\w.]){re.escape(name.group(1))}\b")
        for file in files:
            for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), start=1):
                if word.search(line.partition("//")[0]):
                    return f"{file}:{number}: {message}"
    if "resolve/parse failed" in message:
        return f"{entry}: no class {class_name} in it"
    return f"{entry}: {class_name}: {message}"
