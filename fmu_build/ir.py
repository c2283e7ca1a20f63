"""The values that pass between the stages. All are frozen; expressions are SymPy's.

Conventions inside expressions: a variable is ``symbol(name)``, the time derivative of ``x`` is ``symbol(der(x))``, its
value before an event ``symbol(pre(x))`` and the truth value of relation ``i`` is ``holds(i)``. Real literals are SymPy
Floats of double precision. A Boolean variable is 0 or 1, and true as a condition where it is above 0.5 (``is_true``).
An enumeration is the number of its literal, from 1.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import sympy

TIME = "time"
INITIAL = "initial()"  # Boolean variables: true while the model is initialized, and at its end
TERMINAL = "terminal()"
TOKEN_PLACEHOLDER = "{00000000-0000-0000-0000-000000000000}"  # stands where the content's hash will stand
DEFAULT_TOLERANCE = 1e-6  # relative tolerance where the experiment annotation gives none (OpenModelica's default too)


def symbol(name: str) -> sympy.Symbol:
    """The SymPy symbol of the variable ``name``."""
    return sympy.Symbol(name, real=True)


def der(name: str) -> str:
    """Name of the time derivative of ``name``, as FMI's structured naming convention writes it."""
    return f"der({name})"


def pre(name: str) -> str:
    """Name of the value of ``name`` just before an event."""
    return f"pre({name})"


def relation_name(index: int) -> str:
    """Name of the variable that is the residual of relation ``index``."""
    return f"relation[{index + 1}]"


def holds(index: int) -> sympy.Symbol:
    """The truth value of relation ``index``, constant between events."""
    return sympy.Symbol(f"holds[{index}]")


def is_true(name: str) -> sympy.Expr:
    """The condition that the Boolean variable ``name`` is true."""
    return symbol(name) > sympy.Float(0.5)


def truth(condition: sympy.Expr) -> sympy.Expr:
    """1 where ``condition`` is true, else 0: what a Boolean variable is set to."""
    return sympy.Piecewise((sympy.Integer(1), condition), (sympy.Integer(0), True), evaluate=False)


class round_down(sympy.Function):  # type: ignore[misc]
    """The largest integer not above its argument, whose derivative is 0 wherever it has one."""

    nargs = 1
    is_real = True

    @classmethod
    def eval(cls, argument: sympy.Expr) -> sympy.Expr | None:
        """A number, of a number."""
        return sympy.floor(argument) if argument.is_number else None

    def fdiff(self, argindex: int = 1) -> sympy.Expr:
        """0"""
        return sympy.Integer(0)


class reach_time(sympy.Function):  # type: ignore[misc]
    """The time at which ``rest + slope*time`` reaches ``value``: arguments (value, rest, slope).

    It is a function, and not the quotient, because SymPy would write that differently for different values, and so
    round one and the same time differently.
    """

    nargs = 3
    is_real = True


class time_left(sympy.Function):  # type: ignore[misc]
    """From now to an event: arguments (its time, now). Their difference, zero where that is rounding."""

    nargs = 2
    is_real = True

    def fdiff(self, argindex: int = 1) -> sympy.Expr:
        """1 or -1"""
        return sympy.Integer(1 if argindex == 1 else -1)


@dataclass(frozen=True)
class EnumerationType:
    """An enumeration: its literals in order; the first is number 1."""

    name: str
    literals: tuple[str, ...]


@dataclass(frozen=True)
class Variable:
    """A scalar of the flattened model, with the attributes that Modelica gives it."""

    name: str
    description: str = ""
    unit: str = ""
    quantity: str = ""
    causality: str = "local"  # local, input, output
    variability: str = "continuous"  # continuous, discrete, parameter, constant
    type: str = "Real"  # Real, Integer, Boolean, Enumeration
    enumeration: EnumerationType | None = None
    start: sympy.Expr | None = None
    fixed: bool = False
    binding: sympy.Expr | None = None
    min: float | None = None
    max: float | None = None
    nominal: float | None = None
    guess: float = 0.0  # the start value as a number, where a nonlinear loop starts to look for a solution
    hidden: bool = False  # protected
    final: bool = False
    state_select: int = 0  # StateSelect: never -2, avoid -1, default 0, prefer 1, always 2
    origin: str = ""


@dataclass(frozen=True)
class Equation:
    """``residual = 0``, with the place in the Modelica source where it stands."""

    residual: sympy.Expr
    origin: str


@dataclass(frozen=True)
class Relation:
    """True where ``residual > 0``. A time event is true before ``until`` alone, which is constant between events."""

    residual: sympy.Expr
    text: str
    origin: str
    until: sympy.Expr | None = None


@dataclass(frozen=True)
class Assignment:
    """``target := expression``."""

    target: str
    expression: sympy.Expr
    origin: str

    @property
    def targets(self) -> tuple[str, ...]:
        """What is computed."""
        return (self.target,)

    @property
    def arguments(self) -> set[sympy.Symbol]:
        """What it is computed from."""
        return set(self.expression.free_symbols)


@dataclass(frozen=True)
class Alternatives:
    """One equation between discrete variables, as the assignments that it may be: one or, for ``a = b``, two."""

    assignments: tuple[Assignment, ...]


@dataclass(frozen=True)
class Message:
    """A text with a value at each ``%s``; each value has a type (see Variable)."""

    format: str
    values: tuple[tuple[sympy.Expr, str], ...] = ()


@dataclass(frozen=True)
class Check:
    """What must not be: where ``violated``, the message is given, and a warning or an error; or the model ends."""

    violated: sympy.Expr
    message: Message
    kind: str  # WARN, FAIL, END
    origin: str


@dataclass(frozen=True)
class Reinit:
    """``state`` gets a new value where ``active``."""

    state: str
    active: sympy.Expr
    value: sympy.Expr
    origin: str


@dataclass(frozen=True)
class Choice:
    """Statements under conditions; the last condition may be true. With several that hold the first one counts."""

    branches: tuple[tuple[sympy.Expr, tuple[Statement, ...]], ...]


@dataclass(frozen=True)
class WhenBranch:
    """Statements for the moments at which one of the conditions becomes true."""

    conditions: tuple[sympy.Expr, ...]
    statements: tuple[Statement, ...]
    origin: str


@dataclass(frozen=True)
class When:
    """A when-clause: the first branch, then those of elsewhen."""

    branches: tuple[WhenBranch, ...]


@dataclass(frozen=True)
class Algorithm:
    """An algorithm section: statements in their order, and the variables that they assign."""

    statements: tuple[Statement, ...]
    targets: tuple[str, ...]
    origin: str


Statement = Assignment | Reinit | Check | Choice | When


@dataclass(frozen=True)
class Sample:
    """A clock that ticks at ``start + i*interval``."""

    start: sympy.Expr
    interval: sympy.Expr
    origin: str


@dataclass(frozen=True)
class DiscreteEquations:
    """What is computed at events. Each assignment is to a discrete variable; the order is none."""

    assignments: tuple[Assignment, ...] = ()
    reinits: tuple[Reinit, ...] = ()
    checks: tuple[Check, ...] = ()  # first those at events, then those at any time
    n_event_checks: int = 0
    samples: tuple[Sample, ...] = ()


@dataclass(frozen=True)
class Experiment:
    """The experiment annotation of a class; None where it says nothing."""

    start_time: float | None = None
    stop_time: float | None = None
    tolerance: float | None = None
    interval: float | None = None


@dataclass(frozen=True)
class Coupling:
    """Names of the variables of a coupling; what each is for stands in runtime/model.h."""

    across: str
    across_derivative: str
    extrapolate: str
    through: str
    impulse: str
    work: str
    mean: str
    hold: str
    applied: str
    energy: str


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
    events: DiscreteEquations = DiscreteEquations()
    documentation: str = ""  # HTML of the Documentation annotation
    icon: str = ""  # Modelica text of the Icon annotation
    couplings: tuple[str, ...] = ()  # arguments of coupling annotations, Modelica text
    terminals: tuple[str, ...] = ()  # and of terminal annotations
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
    events: DiscreteEquations = DiscreteEquations()
    initial_equations: tuple[Equation, ...] = ()
    initial_unknowns: tuple[str, ...] = ()  # with as many initial_equations, once they are complete
    starts_before: tuple[Assignment, ...] = ()  # of discrete variables: their values before the start
    free_parameters: tuple[str, ...] = ()  # which initial equations determine


@dataclass(frozen=True)
class Loop:
    """Unknowns that residuals, as many, determine together; found at run time.

    A linear loop is solved by one elimination. In another one the ``explicit`` unknowns are computed, in their order,
    from the ``iterated`` ones, and Newton's method looks for these, starting from ``guesses``, a variable for each.
    """

    iterated: tuple[str, ...]
    explicit: tuple[Assignment, ...]
    residuals: tuple[Equation, ...]  # those of the explicit ones last, in their order
    slopes: dict[tuple[int, int], sympy.Expr] = field(hash=False)  # residual by unknown
    is_linear: bool
    guesses: tuple[str, ...] = ()

    @property
    def unknowns(self) -> tuple[str, ...]:
        """All that is found: the iterated ones, then the explicit ones."""
        return (*self.iterated, *(a.target for a in self.explicit))

    @property
    def targets(self) -> tuple[str, ...]:
        """What is computed."""
        return (*self.unknowns, *self.guesses)

    @property
    def arguments(self) -> set[sympy.Symbol]:
        """What it is computed from, guesses left out: they decide only where the search starts."""
        symbols = set().union(*(r.residual.free_symbols for r in self.residuals))
        return symbols - {symbol(name) for name in self.unknowns}

    @property
    def origin(self) -> str:
        """The places of its equations."""
        return ", ".join(dict.fromkeys(r.origin for r in self.residuals))


Block = Assignment | Loop


@dataclass(frozen=True)
class ScheduledReinit:
    """``state`` gets the value of the variable ``value`` where the Boolean variable ``active`` is true."""

    state: str
    active: str
    value: str


@dataclass(frozen=True)
class ScheduledSample:
    """The Boolean variable ``flag`` is true at the ticks; the others are variables with its times."""

    flag: str
    start: str
    interval: str


@dataclass(frozen=True)
class ScheduledCheck:
    """The Boolean variable ``violated``, and what follows where it is true; see Check."""

    violated: str
    message: Message
    kind: str


@dataclass(frozen=True)
class Memory:
    """The variable ``before`` keeps the value of ``name`` before an event. If it is discrete, a change is an event."""

    name: str
    before: str
    is_discrete: bool


@dataclass(frozen=True)
class Schedule:
    """What happens at events, in the order in which it can be computed."""

    assignments: tuple[Block, ...] = ()
    check_assignments: tuple[Block, ...] = ()  # of checks at any time
    memories: tuple[Memory, ...] = ()
    reinits: tuple[ScheduledReinit, ...] = ()
    samples: tuple[ScheduledSample, ...] = ()
    time_events: tuple[str, ...] = ()  # variables: the times
    checks: tuple[ScheduledCheck, ...] = ()
    n_event_checks: int = 0  # of the checks, the first ones

    @property
    def is_empty(self) -> bool:
        """Whether there is nothing but relations."""
        return not (self.assignments or self.check_assignments or self.memories)


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
    relations: tuple[Relation, ...]  # the residual of number i is the variable relation_name(i)
    free_parameters: tuple[str, ...] = ()  # start_assignments calculate them
    schedule: Schedule = Schedule()

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
