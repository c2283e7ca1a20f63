"""What the outside sees of a SortedModel: its variables in their roles, and what depends on what.

The same for every version of FMI; the xml_fmi*.py modules only print it.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

from ..ir.dependencies import start_value, tunable_parameters
from ..ir.equations import EnumerationType, Variable
from ..ir.models import DEFAULT_TOLERANCE, JacobianModel, Ports, SortedModel, Terminal
from ..ir.symbols import TIME
from ..ir.units import conversion
from .dependency_kinds import DEPENDENT, dependency_kinds

GENERATION_TOOL = "OverrunHitch fmu_build"
NO_PORTS = Ports()
Dependencies = dict[str, tuple[tuple[str, str], ...]]  # names of unknowns to knowns with their kinds, both listed


@dataclass(frozen=True)
class Entry:
    """One variable as users see it."""

    variable: Variable
    reference: int
    causality: str
    variability: str
    initial: str | None
    start: float | None
    derivative_of: str | None

    @property
    def start_text(self) -> str | None:
        """The start value as XML has it, for the type of the variable."""
        if self.start is None:
            return None
        if self.variable.type == "Boolean":
            return "true" if self.start else "false"
        return repr(self.start) if self.variable.type == "Real" else str(int(self.start))

    @property
    def name(self) -> str:
        """The name that users see."""
        return self.variable.name

    @property
    def attributes(self) -> dict[str, str]:
        """Unit, quantity and limits, as both versions of FMI write them."""
        v = self.variable
        numbers = {"min": v.min, "max": v.max, "nominal": v.nominal or None}
        texts = (
            {} if v.type == "Boolean" else {"unit": v.unit, "displayUnit": displayed_in(v), "quantity": v.quantity}
        )  # FMI has none of a Boolean
        if v.type != "Real":
            texts["unit"] = texts["displayUnit"] = ""
            numbers = {} if v.type == "Boolean" else numbers | {"nominal": None}
        number = repr if v.type == "Real" else lambda value: str(int(value))
        return {key: text for key, text in texts.items() if text} | {
            key: number(value) for key, value in numbers.items() if value is not None
        }


@dataclass(frozen=True)
class Interface:
    """Everything that a modelDescription.xml tells."""

    identifier: str
    name: str
    description: str
    entries: tuple[Entry, ...]
    event_indicators: tuple[Entry, ...]
    experiment: dict[str, str] = field(hash=False)  # startTime, stopTime, tolerance, stepSize: those that are given
    outputs: Dependencies = field(hash=False)
    derivatives: Dependencies = field(hash=False)
    initial_unknowns: Dependencies = field(hash=False)
    indicator_sources: Dependencies = field(hash=False)
    terminals: tuple[Terminal, ...] = ()
    has_checks: bool = False  # at any time, so that it has to be told of every step

    @property
    def enumerations(self) -> tuple[EnumerationType, ...]:
        """The enumerations of its variables."""
        return tuple(dict.fromkeys(e.variable.enumeration for e in self.entries if e.variable.enumeration))

    @property
    def units(self) -> dict[str, tuple[str, ...]]:
        """All units in alphabetical order, each with the units that its values are displayed in."""
        variables = [e.variable for e in (*self.entries, *self.event_indicators)]
        return {
            unit: tuple(sorted({displayed_in(v) for v in variables if v.unit == unit} - {""}))
            for unit in sorted({v.unit for v in variables if v.unit})
        }


def model_identifier(class_name: str) -> str:
    """The name of the unit's library and prefix of its functions, which FMI wants to be one of C: the class's own, with
    an underscore for what C does not know. ``Systems.Car`` gives ``Car``, ``P.'my car'`` gives ``my_car``."""
    *_, last = re.findall(r"'(?:\\.|[^'\\])*'|[^.']+", class_name)
    name = re.sub(r"\W+", "_", last, flags=re.ASCII).strip("_")
    return name if name[:1].isalpha() else f"M_{name}"


def displayed_in(variable: Variable) -> str:
    """The unit to show its values in; "" where the model names none, or none that its unit converts to."""
    known = variable.display_unit and conversion(variable.unit, variable.display_unit)
    return variable.display_unit if known else ""


def expose(model: SortedModel, jacobian: JacobianModel, identifier: str, ports: Ports = NO_PORTS) -> Interface:
    """The interface of ``model``: everything public, states in any case; of parameters no mere copies."""
    roles = _Roles(model)
    candidates = (Variable(TIME, "Time", unit="s"), *model.variables.values())
    entries = tuple(roles.entry(v) for v in candidates if roles.listed(v))
    return Interface(
        identifier=identifier,
        name=model.name,
        description=model.description,
        entries=entries,
        event_indicators=tuple(roles.entry(model.variables[name]) for name in model.residuals),
        experiment=_experiment(model),
        terminals=ports.terminals,
        has_checks=bool(model.schedule.check_assignments),
        **_structure(model, entries, _known_kinds(model, jacobian, ports)),
    )


class _Roles:
    def __init__(self, model: SortedModel) -> None:
        self._model = model
        self._references = model.value_references
        self._tunable = tunable_parameters(model)

    def listed(self, variable: Variable) -> bool:
        name, model = variable.name, self._model
        return name in self._references and (not variable.hidden or name in {*model.states, *model.derivatives})

    def entry(self, variable: Variable) -> Entry:
        name, model = variable.name, self._model
        causality, variability, initial = self._role(variable)
        has_start = initial == "exact" or causality == "input"
        return Entry(
            variable=variable,
            reference=self._references[name],
            causality=causality,
            variability=variability,
            initial=initial,
            start=start_value(name, model) if has_start else None,
            derivative_of=model.states[model.derivatives.index(name)] if name in model.derivatives else None,
        )

    def _role(self, variable: Variable) -> tuple[str, str, str | None]:
        name, model = variable.name, self._model
        if name == TIME:
            return "independent", "continuous", None
        if name in model.inputs:
            return "input", variable.variability, None
        if variable.variability == "parameter":
            variability = "tunable" if name in self._tunable and name not in model.free_parameters else "fixed"
            is_settable = name in model.parameters
            return ("parameter" if is_settable else "calculatedParameter"), variability, _initial(is_settable)
        return variable.causality, variable.variability, _initial(name in model.start_values)


def _initial(is_exact: bool) -> str:
    return "exact" if is_exact else "calculated"


def _experiment(model: SortedModel) -> dict[str, str]:
    experiment = model.experiment
    values = {
        "startTime": experiment.start_time,
        "stopTime": experiment.stop_time,
        "tolerance": experiment.tolerance or DEFAULT_TOLERANCE,
        "stepSize": experiment.interval,
    }
    return {name: repr(value) for name, value in values.items() if value is not None}


def _known_kinds(model: SortedModel, jacobian: JacobianModel, ports: Ports) -> dict[str, dict[str, str]]:
    """Kinds of dependencies, of what they are known. In Co-Simulation a coupling puts values of its own in place of
    some outputs: of those nothing is said."""
    replaced = () if ports.coupling is None else ports.coupling.replaced
    kinds = dependency_kinds(model, jacobian)
    return {name: ways for name, ways in kinds.items() if name not in replaced}


def _structure(
    model: SortedModel, entries: tuple[Entry, ...], kinds: Mapping[str, Mapping[str, str]]
) -> dict[str, Dependencies]:
    sources = model.sources
    order = {entry.name: position for position, entry in enumerate(entries)}
    during = {*model.states, *model.inputs, TIME}
    starts = _sources_of_starts(model, sources)

    def now(name: str) -> frozenset[str]:
        return sources.get(name, frozenset((name,)))

    def at_start(name: str) -> frozenset[str]:
        return frozenset().union(*(starts.get(source, {source}) for source in now(name)))

    def sort(names: frozenset[str]) -> tuple[str, ...]:
        return tuple(sorted(names & order.keys(), key=order.__getitem__))

    def during_with_kinds(name: str) -> tuple[tuple[str, str], ...]:
        return tuple((known, kinds.get(name, {}).get(known, DEPENDENT)) for known in sort(now(name) & during))

    outputs = [e.name for e in entries if e.causality == "output"]
    unknown_roles = {("output", "calculated"), ("calculatedParameter", "calculated")}
    initial = {e.name for e in entries if (e.causality, e.initial) in unknown_roles}
    initial |= {*starts, *model.derivatives}
    return {
        "outputs": {name: during_with_kinds(name) for name in outputs},
        "derivatives": {name: during_with_kinds(name) for name in model.derivatives},
        "initial_unknowns": {
            name: tuple((known, DEPENDENT) for known in sort(at_start(name))) for name in sort(frozenset(initial))
        },
        "indicator_sources": {name: during_with_kinds(name) for name in model.residuals},
    }


def _sources_of_starts(model: SortedModel, sources: Mapping[str, frozenset[str]]) -> dict[str, frozenset[str]]:
    """What the calculated start values of states depend on."""
    found: dict[str, frozenset[str]] = {}
    for block in model.start_assignments:
        names = [str(s) for s in block.arguments]
        parts = [found.get(name, sources.get(name, frozenset((name,)))) for name in names]
        found |= dict.fromkeys(block.targets, frozenset().union(*parts))
    return {name: found[name] for name in (*model.calculated_states, *model.free_parameters)}
