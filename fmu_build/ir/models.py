"""The values that pass between the stages. All are frozen; expressions are SymPy's, with the names of ir/symbols.py."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import sympy

from .equations import Assignment, Block, Equation, Loop, Relation, Variable
from .events import Algorithm, Alternatives, Check, DiscreteEquations, Sample, Schedule, When
from .symbols import INITIAL, TERMINAL, TIME, der, relation_of

TOKEN_PLACEHOLDER = "{00000000-0000-0000-0000-000000000000}"  # stands where the content's hash will stand
DEFAULT_TOLERANCE = 1e-6  # relative tolerance where the experiment annotation gives none (OpenModelica's default too)


@dataclass(frozen=True)
class Experiment:
    """The experiment annotation of a class; None where it says nothing."""

    start_time: float | None = None
    stop_time: float | None = None
    tolerance: float | None = None
    interval: float | None = None


@dataclass(frozen=True)
class Claims:
    """Who made a model and on what terms, as it says itself; "" where it claims nothing."""

    author: str = ""
    copyright: str = ""
    license: str = ""


@dataclass(frozen=True)
class Across:
    """Names of the variables of what a master holds, and the sign with which the first through acts there."""

    input: str
    derivative: str
    inertia: str | None
    sign: float


@dataclass(frozen=True)
class Through:
    """Names of the variables of what is given back."""

    output: str
    impulse: str
    mean: str
    hold: str


@dataclass(frozen=True)
class Coupling:
    """Names of the variables of a coupling; what each is for stands in runtime/model.h."""

    across: tuple[Across, ...]
    through: tuple[Through, ...]
    extrapolate: str
    work: str
    applied: str
    energy: str

    @property
    def replaced(self) -> tuple[str, ...]:
        """The outputs that get other values in Co-Simulation, so that nothing may be calculated from them."""
        return (*(name for through in self.through for name in (through.mean, through.hold)), self.energy)


@dataclass(frozen=True)
class Member:
    """A variable of a terminal. ``kind`` is FMI's: signal, inflow or outflow."""

    name: str
    variable: str
    kind: str


@dataclass(frozen=True)
class Terminal:
    """Variables that are to be connected together."""

    name: str
    members: tuple[Member, ...]


@dataclass(frozen=True)
class Ports:
    """How a class says that it is to be connected."""

    coupling: Coupling | None = None
    terminals: tuple[Terminal, ...] = ()


@dataclass(frozen=True)
class FlatModel:
    """What the front end delivers: one class, flattened."""

    name: str
    description: str
    variables: tuple[Variable, ...]
    equations: tuple[Equation, ...]
    relations: tuple[Relation, ...]
    experiment: Experiment
    discrete: tuple[Alternatives, ...] = ()  # equations between discrete variables
    whens: tuple[When, ...] = ()
    algorithms: tuple[Algorithm, ...] = ()
    samples: tuple[Sample, ...] = ()
    rounded: tuple[Assignment, ...] = ()  # Integer variables that round continuous expressions
    checks: tuple[Check, ...] = ()
    initial_equations: tuple[Equation, ...] = ()
    initial_algorithms: tuple[Algorithm, ...] = ()
    events: DiscreteEquations = field(default_factory=DiscreteEquations)
    documentation: str = ""  # HTML of the Documentation annotation
    icon: str = ""  # Modelica text of the Icon annotation
    couplings: tuple[str, ...] = ()  # arguments of coupling annotations, Modelica text
    terminals: tuple[str, ...] = ()  # and of terminal annotations
    claims: Claims = Claims()
    examples: tuple[str, ...] = ()  # classes with one component of this class, for reference results


@dataclass(frozen=True)
class Simulation:
    """What the front end's own simulation of a class delivers: an independent result to compare with."""

    class_name: str
    tool: str
    tolerances: tuple[float, float]  # relative; the columns are those at the tighter one
    times: tuple[float, ...]
    columns: dict[str, tuple[float, ...]] = field(hash=False)  # by the name of the variable
    accuracy: dict[str, float] = field(hash=False)  # largest distance between the results at the two tolerances
    parameters: dict[str, float] = field(hash=False)  # those that are plain numbers


@dataclass(frozen=True)
class EquationSystem:
    """As many equations as unknowns, aliases gone, states chosen.

    ``unknowns`` are names: algebraic variables and derivatives of states. ``aliases`` maps each eliminated name to the
    name that stands for it.
    """

    model: FlatModel
    states: tuple[str, ...]
    inputs: tuple[str, ...]
    unknowns: tuple[str, ...]
    equations: tuple[Equation, ...]
    relations: tuple[Relation, ...]
    parameters: tuple[str, ...]
    bound_parameters: dict[str, Equation] = field(hash=False)  # residual: parameter - expression
    starts: dict[str, sympy.Expr] = field(hash=False)  # start values of the states, in parameters
    aliases: dict[str, str] = field(hash=False)
    events: DiscreteEquations = field(default_factory=DiscreteEquations)
    initial_equations: tuple[Equation, ...] = ()
    initial_unknowns: tuple[str, ...] = ()  # with as many initial_equations, once they are complete
    starts_before: tuple[Assignment, ...] = ()  # of discrete variables: their values before the start
    free_parameters: tuple[str, ...] = ()  # which initial equations determine
    invariants: tuple[Equation, ...] = ()  # of the states, true for all times if at the start


@dataclass(frozen=True)
class SortedModel:
    """The intermediate representation behind every printer: assignments in the order in which they can be computed."""

    name: str
    description: str
    experiment: Experiment
    variables: dict[str, Variable] = field(hash=False)  # by name: those of the flat model, derivatives, residuals
    states: tuple[str, ...]
    inputs: tuple[str, ...]
    parameters: tuple[str, ...]
    parameter_assignments: tuple[Assignment, ...]
    start_assignments: tuple[Block, ...]  # states whose start follows from parameters
    start_values: dict[str, float] = field(hash=False)  # states whose start is a number, and guesses of loops
    assignments: tuple[Block, ...]
    relations: tuple[Relation, ...]
    residuals: tuple[str, ...]  # of the relations, as variables
    free_parameters: tuple[str, ...] = ()  # start_assignments calculate them
    schedule: Schedule = field(default_factory=Schedule)

    @property
    def calculated_states(self) -> tuple[str, ...]:
        """The states whose start values start_assignments calculate."""
        targets = {name for block in self.start_assignments for name in block.targets}
        return tuple(state for state in self.states if state in targets)

    @property
    def event_variables(self) -> tuple[str, ...]:
        """Variables that change at events alone: discrete ones, their values before, and what schedules them."""
        schedule = self.schedule
        continuous = {*self.states, *self.derivatives, *(name for block in self.assignments for name in block.targets)}
        targets = [name for b in (*schedule.assignments, *schedule.check_assignments) for name in b.targets]
        flags = [sample.flag for sample in schedule.samples]
        before = [memory.before for memory in schedule.memories]
        always = [] if schedule.is_empty else [INITIAL, TERMINAL]
        return tuple(dict.fromkeys(n for n in (*targets, *before, *flags, *always) if n not in continuous))

    @cached_property
    def derivatives(self) -> tuple[str, ...]:
        """Names of the states' derivatives, in the order of the states."""
        return tuple(der(state) for state in self.states)

    @cached_property
    def value_references(self) -> dict[str, int]:
        """The table of variables: name to index in ``Variables.at[]``, in the order that model.h prescribes."""
        leading = (TIME, *self.states, *self.derivatives, *self.inputs, *self.parameters)
        calculated = tuple(a.target for a in self.parameter_assignments)
        known = {*leading, *calculated}
        loops = (b for b in self.start_assignments if isinstance(b, Loop))
        blocks = (*(name for b in self.assignments for name in b.targets), *(g for b in loops for g in b.guesses))
        others = tuple(name for name in dict.fromkeys(blocks) if name not in known)
        discrete = (n for n in (*self.free_parameters, *self.event_variables) if n not in {*known, *others})
        return {name: index for index, name in enumerate((*leading, *calculated, *others, *discrete))}

    @cached_property
    def sources(self) -> dict[str, frozenset[str]]:
        """For each computed variable the states, inputs, parameters and time that it depends on at a fixed time.

        A conditional depends on what its condition depends on.
        """
        leaves = (*self.states, *self.inputs, *self.parameters, *self.free_parameters, TIME)
        known = {name: frozenset((name,)) for name in leaves}
        result = dict(known)
        blocks = (
            *self.parameter_assignments,
            *self.schedule.assignments,
            *self.assignments,
            *self.schedule.check_assignments,
        )
        for block in blocks:
            symbols = set(block.arguments)
            symbols.update(*(self._compared(s) for s in block.arguments))
            reached = frozenset[str]().union(*(result.get(s.name, frozenset()) for s in symbols))
            result |= dict.fromkeys(block.targets, reached)
        return {name: sources for name, sources in result.items() if name not in known}

    def _compared(self, truth: sympy.Symbol) -> set[sympy.Symbol]:
        """What the relation is about whose truth value it is; nothing if it is a variable."""
        index = relation_of(truth)
        return set() if index is None else set(self.relations[index].residual.free_symbols)


@dataclass(frozen=True)
class Partials:
    """The partial derivatives of one assignment by each of its arguments."""

    target: str
    by_argument: tuple[tuple[str, sympy.Expr], ...]
    origin: str


@dataclass(frozen=True)
class LoopPartials:
    """The partial derivatives of a loop's residuals by each of its arguments, with which those of its unknowns follow
    from the implicit function theorem."""

    loop: Loop
    by_argument: tuple[tuple[tuple[str, sympy.Expr], ...], ...]  # for each residual


@dataclass(frozen=True)
class LoopGradient:
    """How a loop's unknowns change with one seed: minus the inverse of its slopes, times ``right``."""

    loop: Loop
    targets: tuple[str, ...]  # in the order of its unknowns
    right: tuple[sympy.Expr, ...]  # derivatives of its residuals

    @property
    def arguments(self) -> set[sympy.Symbol]:
        """What it is computed from."""
        slopes = set().union(*(value.free_symbols for value in self.loop.slopes.values()))
        return slopes.union(*(value.free_symbols for value in self.right))


@dataclass(frozen=True)
class JacobianModel:
    """Exact derivatives: those of every assignment by itself, and chained those of the states' derivatives.

    The chained ones are local assignments, then one entry per pair (derivative, state) that can be nonzero. The order
    of ``entries`` is that of the array in which the C code keeps them.
    """

    parameter_partials: tuple[Partials, ...]
    start_partials: tuple[Partials | LoopPartials, ...]
    partials: tuple[Partials | LoopPartials, ...]
    assignments: tuple[Assignment | LoopGradient, ...]
    entries: dict[tuple[int, int], sympy.Expr] = field(hash=False)
    time_entries: dict[int, sympy.Expr] = field(hash=False)


@dataclass(frozen=True)
class Elimination:
    """Gaussian elimination of I/(gamma h) - J: which state is the pivot when, and where L and U are not zero.

    ``jacobian`` has (row, column) of the entries of J. ``pattern`` counts rows and columns in the order of elimination;
    it is sorted by rows, then by columns, and has the whole diagonal.
    """

    jacobian: tuple[tuple[int, int], ...]
    order: tuple[int, ...]
    pattern: tuple[tuple[int, int], ...]


@dataclass(frozen=True)
class CSources:
    """The generated C: file name to text."""

    files: dict[str, str] = field(hash=False)
