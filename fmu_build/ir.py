"""The values that pass between the stages. All are frozen; expressions are SymPy's.

Conventions inside expressions: a variable is ``symbol(name)``, the time derivative of ``x`` is ``symbol(der(x))`` and
the truth value of relation ``i`` is ``holds(i)``. Real literals are SymPy Floats of double precision.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import sympy

TIME = "time"
TOKEN_PLACEHOLDER = "{00000000-0000-0000-0000-000000000000}"  # stands where the content's hash will stand
DEFAULT_TOLERANCE = 1e-6  # relative tolerance where the experiment annotation gives none (OpenModelica's default too)


def symbol(name: str) -> sympy.Symbol:
    """The SymPy symbol of the variable ``name``."""
    return sympy.Symbol(name, real=True)


def der(name: str) -> str:
    """Name of the time derivative of ``name``, as FMI's structured naming convention writes it."""
    return f"der({name})"


def relation_name(index: int) -> str:
    """Name of the variable that is the residual of relation ``index``."""
    return f"relation[{index + 1}]"


def holds(index: int) -> sympy.Symbol:
    """The truth value of relation ``index``, constant between events."""
    return sympy.Symbol(f"holds[{index}]")


@dataclass(frozen=True)
class Variable:
    """A scalar Real of the flattened model, with the attributes that Modelica gives it."""

    name: str
    description: str = ""
    unit: str = ""
    quantity: str = ""
    causality: str = "local"  # local, input, output
    variability: str = "continuous"  # continuous, parameter, constant
    start: sympy.Expr | None = None
    fixed: bool = False
    binding: sympy.Expr | None = None
    min: float | None = None
    max: float | None = None
    nominal: float | None = None
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
    """True where ``residual > 0``."""

    residual: sympy.Expr
    text: str
    origin: str


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


@dataclass(frozen=True)
class Assignment:
    """``target := expression``."""

    target: str
    expression: sympy.Expr
    origin: str


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
    start_assignments: tuple[Assignment, ...]  # states whose start follows from parameters
    start_values: dict[str, float] = field(hash=False)  # states whose start is a number
    assignments: tuple[Assignment, ...]
    relations: tuple[Relation, ...]  # the residual of number i is the variable relation_name(i)

    @property
    def derivatives(self) -> tuple[str, ...]:
        """Names of the states' derivatives, in the order of the states."""
        return tuple(der(state) for state in self.states)

    @property
    def value_references(self) -> dict[str, int]:
        """The table of variables: name to index in ``Variables.at[]``, in the order that model.h prescribes."""
        leading = (TIME, *self.states, *self.derivatives, *self.inputs, *self.parameters)
        calculated = tuple(a.target for a in self.parameter_assignments)
        known = {*leading, *calculated}
        others = tuple(a.target for a in self.assignments if a.target not in known)
        return {name: index for index, name in enumerate((*leading, *calculated, *others))}


@dataclass(frozen=True)
class Partials:
    """The partial derivatives of one assignment by each of its arguments."""

    target: str
    by_argument: tuple[tuple[str, sympy.Expr], ...]
    origin: str


@dataclass(frozen=True)
class JacobianModel:
    """Exact derivatives: those of every assignment by itself, and chained those of the states' derivatives.

    The chained ones are local assignments, then one entry per pair (derivative, state) that can be nonzero. The order
    of ``entries`` is that of the array in which the C code keeps them.
    """

    parameter_partials: tuple[Partials, ...]
    start_partials: tuple[Partials, ...]
    partials: tuple[Partials, ...]
    assignments: tuple[Assignment, ...]
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
