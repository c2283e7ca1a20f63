"""Tables of the Modelica Standard Library: what its external functions compute, as expressions.

``ModelicaStandardTables_CombiTable1D_getValue`` and its like are C. An FMU of ours has no foreign code in it, but a
table that is given in the model can be written out: the intervals as a tree of conditions, in each a polynomial. The
values of linear and constant segments remain parameters; points, and tables of splines, are numbers when the unit is
built.

A time table's interval is told by the time of the event that ends it, which is discrete: so nothing jumps inside a
step, and at an event the value before it is there until the event has happened.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy

from ..ir.conditions import compare
from ..ir.functions import no_number, round_down
from .reader import Reader
from .splines import akima, cubics, fritsch_butland, modified_akima, steffen
from .values import ONE, ZERO, Value

Node = Mapping[str, Any]
PREFIX = "ModelicaStandardTables_"
LINEAR, CONSTANT = 1, 3  # Modelica.Blocks.Types.Smoothness
SPLINES = {2: akima, 4: fritsch_butland, 5: steffen, 6: modified_akima}
HOLD, LAST_TWO, PERIODIC, NONE = 1, 2, 3, 4  # Modelica.Blocks.Types.Extrapolation
ALWAYS, AT_DISCONTINUITIES = 1, 2  # Modelica.Blocks.Types.TimeEvents
TIME_TABLE = "TimeTable.getInterpolationCoefficients"
INFINITE = sympy.Float(1e60)  # s: never; a time scale does not make it infinite
SAME = 1e-6  # of the shortest interval between events: as close is at one


def is_table(function: Node | None) -> bool:
    """Whether a function makes a table: the constructor of an external object."""
    makes = (f"{PREFIX}CombiTable1D_init", f"{PREFIX}CombiTimeTable_init")
    return bool(function and function["external"] and function["external"]["function_name"].startswith(makes))


def table(reader: Reader, function: Node, arguments: Sequence[Node]) -> Table:
    """The table that a constructor makes. ValueError where it is no table that is given in the model."""
    given = dict(zip((node["name"] for node in function["inputs"]), arguments, strict=False))
    if _text(reader, given["tableName"]) != "NoName":
        raise ValueError("a table from a file: not supported; give it in the model, table = [...]")

    def number(name: str, otherwise: int) -> int:
        return int(reader.components.structure(reader.read(given[name]))) if name in given else otherwise

    def expression(name: str) -> sympy.Expr:
        return reader.read(given[name]) if name in given else ZERO

    values = reader.read(given["table"])
    if not isinstance(values, np.ndarray) or 0 in values.shape:
        raise ValueError("a table without rows: give it some, table = [...]")
    made = Table(
        reader,
        tuple(_numbers(reader, values[:, 0])),
        values,
        [int(column) for column in _numbers(reader, np.atleast_1d(reader.read(given["columns"])))],
        number("smoothness", LINEAR),
        number("extrapolation", LAST_TWO),
        number("timeEvents", ALWAYS),
        expression("startTime"),
        expression("shiftTime"),
    )
    may_repeat = "startTime" in given and made.smoothness not in SPLINES
    if any(b < a or (b == a and not may_repeat) for a, b in itertools.pairwise(made.points)):
        points = ", ".join(f"{point:g}" for point in made.points)
        raise ValueError(f"the first column of a table has to increase: it is {points}")
    return made


def line_in_time(reader: Reader, arguments: Sequence[Value]) -> tuple[Value, ...]:
    """What TimeTable.getInterpolationCoefficients gives: a, b of a*time + b, the next event, a row that is not used.

    It is no external function, but searches the table by a ``while``, from the row that it found the last time.
    """
    values, offset, start, time, _, _, shift = arguments
    points = tuple(_numbers(reader, values[:, 0]))
    made = Table(reader, points, values, [2], LINEAR, LAST_TWO, ALWAYS, start, shift)
    slope, at_zero = made.line(time)
    return slope, offset + at_zero, made.next_event(time), ONE


def evaluate(function: Node, arguments: Sequence[Value]) -> sympy.Expr | None:
    """What an external function gives; None if it is none of a table's."""
    external = function["external"]
    computed = _FUNCTIONS.get(external["function_name"].removeprefix(PREFIX))
    if computed is None or not any(isinstance(argument, Table) for argument in arguments):
        return None
    given = dict(zip((node["name"] for node in function["inputs"]), arguments, strict=True))
    return computed(*(given[argument["VarRef"]["name"]["name"]] for argument in external["args"]))


@dataclass(frozen=True)
class Table:
    """A table: its points, and its values row by row, the points among them."""

    reader: Reader
    points: tuple[float, ...]
    values: Value
    columns: list[int]
    smoothness: int
    extrapolation: int
    time_events: int
    start: sympy.Expr
    shift: sympy.Expr

    def at(self, column: Value, u: sympy.Expr) -> sympy.Expr:
        """The value at ``u``."""
        pieces = self._pieces(column)
        if len(self.points) == 1:
            return pieces[0](u)
        if self.extrapolation == PERIODIC:
            u = u - self._cycles(u, 0.0) * self._period
        u = self.reader.named("place", u)
        if self.extrapolation == PERIODIC:
            return self._inside(pieces, range(len(pieces)), u)
        first, last = map(sympy.Float, (self.points[0], self.points[-1]))
        left, right = (self._outside(pieces, column, u, at_right=side) for side in (False, True))
        inside = self._inside(pieces, range(len(pieces)), u)
        if self.smoothness == CONSTANT:
            inside = _choose([last], [inside, self._value(-1, column)], u)
        return sympy.Piecewise(
            (left, compare(sympy.Gt, first, u)), (right, compare(sympy.Gt, u, last)), (inside, True), evaluate=False
        )

    def at_time(self, column: Value, time: sympy.Expr, event: sympy.Expr, _: Value) -> sympy.Expr:
        """The value at a time, in the interval that ends with ``event``."""
        pieces = self._pieces(column)
        value = pieces[0](time)
        if len(self.points) > 1:
            value = self._between_events(pieces, column, time - self.shift, event - self.shift)
        return sympy.Piecewise((value, compare(sympy.Gt, event, self.start)), (ZERO, True), evaluate=False)

    def next_event(self, time: sympy.Expr) -> sympy.Expr:
        """The time of the first event after a time, as an expression for events alone."""
        begun = self._next(time - self.shift) if len(self.points) > 1 else INFINITE
        is_before = compare(sympy.Gt, self.start, time + self._margin)
        return sympy.Piecewise((self.start, is_before), (begun, True), evaluate=False)

    def line(self, time: sympy.Expr) -> tuple[sympy.Expr, sympy.Expr]:
        """Slope and value at 0 of the line that holds from a time to the next event, for events alone."""
        place = sympy.Dummy()
        if len(self.points) == 1:
            options = [self._value(0, ONE)]
        else:
            pieces = self._pieces(ONE)
            left, right = (self._outside(pieces, ONE, place, at_right=side) for side in (False, True))
            options = [left, *(piece(place) for piece in pieces), right]
        near = [sympy.Float(event - self._margin) for event in (self._events() if len(self.points) > 1 else ())]
        is_before = compare(sympy.Gt, self.start, time + self._margin)
        slopes = [sympy.diff(option, place) for option in options]
        values = [option.xreplace({place: -self.shift}) for option in options]
        slope, value = (_choose(near, parts, time - self.shift) for parts in (slopes, values))
        return tuple(sympy.Piecewise((ZERO, is_before), (part, True), evaluate=False) for part in (slope, value))

    def _next(self, time: sympy.Expr) -> sympy.Expr:
        events, cycles, after = self._events(), ZERO, INFINITE
        if self.extrapolation == PERIODIC:
            events, cycles = events[1:], self._cycles(time, self._margin)
        ends = [sympy.Float(event) + cycles * self._period + self.shift for event in events]
        if self.extrapolation == PERIODIC:
            after = ends.pop()
            events = events[:-1]
        near = [sympy.Float(event - self._margin) for event in events]
        return _choose(near, [*ends, after], time - cycles * self._period)

    def _between_events(self, pieces: Pieces, column: Value, time: sympy.Expr, event: sympy.Expr) -> sympy.Expr:
        events = self._events()
        intervals = [(self.points[i], self.points[i + 1]) for i in self._rows]
        groups = [
            [i for i, (a, b) in enumerate(intervals) if begin <= a and b <= end]
            for begin, end in itertools.pairwise(events)
        ]
        middles = [sympy.Float((a + b) / 2) for a, b in itertools.pairwise(events)]
        if self.extrapolation == PERIODIC:
            cycles = self._cycles(event, self._margin - min(b - a for a, b in itertools.pairwise(events)) / 2)
            event, time = event - cycles * self._period, time - cycles * self._period
        event, time = self.reader.named("event", event), self.reader.named("place", time)
        if self.extrapolation == PERIODIC:
            return _choose(middles[1:], [self._inside(pieces, group, time) for group in groups], event)
        inside = [self._inside(pieces, group, time) for group in groups]
        left, right = (self._outside(pieces, column, time, at_right=side) for side in (False, True))
        return _choose([*middles, self._period + events[-1]], [left, *inside, right], event)

    def _inside(self, pieces: Pieces, group: Sequence[int], u: sympy.Expr) -> sympy.Expr:
        """One of the pieces of a group, by where it begins."""
        begins = [sympy.Float(self.points[self._rows[i]]) for i in group]
        return _choose(begins[1:], [pieces[i](u) for i in group], u)

    def _outside(self, pieces: Pieces, column: Value, u: sympy.Expr, *, at_right: bool) -> sympy.Expr:
        row = -1 if at_right else 0
        value, end = self._value(row, column), sympy.Float(self.points[row])
        if self.extrapolation == NONE:
            is_end = compare(sympy.Gt, end + self._margin, u) if at_right else sympy.false
            return sympy.Piecewise((value, is_end), (no_number(), True), evaluate=False)
        if self.extrapolation == HOLD:
            return value
        piece = pieces[row]
        if self._is_spline:
            v = sympy.Dummy()
            return value + sympy.diff(piece(v), v).xreplace({v: end}) * (u - end)
        i = len(self.points) - 2 if at_right else 0
        dx = self.points[i + 1] - self.points[i]
        return value + (self._value(i + 1, column) - self._value(i, column)) / dx * (u - end) if dx else value

    def _pieces(self, column: Value) -> Pieces:
        """The values in the intervals, as functions of the place."""
        if not self._rows:
            return [lambda _: self._value(0, column)]
        x = self.points
        if self._is_spline:
            y = _numbers(self.reader, np.array([self._value(i, column) for i in range(len(x))]))
            found = cubics(x, y, SPLINES[self.smoothness](x, y))
            return [_cubic(x[i], y[i], coefficients) for i, coefficients in enumerate(found)]
        if self.smoothness == CONSTANT:
            return [_line(x[i], self._value(i, column), ZERO) for i in self._rows]
        slopes = [(self._value(i + 1, column) - self._value(i, column)) / (x[i + 1] - x[i]) for i in self._rows]
        return [_line(x[i], self._value(i, column), slope) for i, slope in zip(self._rows, slopes, strict=True)]

    def _value(self, row: int, column: Value) -> sympy.Expr:
        number = int(self.reader.components.structure(column))
        return self.values[row, self.columns[number - 1] - 1]

    def _events(self) -> list[float]:
        """The times of events, the first and the last one those of the first and the last point."""
        first, *_, last = self.points
        pairs = list(itertools.pairwise(self.points))
        if self._is_spline or self.time_events not in {ALWAYS, AT_DISCONTINUITIES}:
            pairs = []
        elif self.smoothness != CONSTANT and self.time_events == AT_DISCONTINUITIES:
            pairs = [(a, b) for a, b in pairs if a == b]
        return sorted({first, *(b for _, b in pairs), last})

    def _cycles(self, u: sympy.Expr, margin: float) -> sympy.Expr:
        """How many whole periods there are between the first point and ``u``, which may be less by ``margin``."""
        return round_down((u - sympy.Float(self.points[0] - margin)) / self._period)

    @property
    def _rows(self) -> list[int]:
        """Where the intervals begin that have a length."""
        return [i for i, (a, b) in enumerate(itertools.pairwise(self.points)) if a < b]

    @property
    def _is_spline(self) -> bool:
        return self.smoothness in SPLINES and len(self.points) > 2

    @property
    def _margin(self) -> float:
        return SAME * min((b - a for a, b in itertools.pairwise(self._events())), default=1.0)

    @property
    def _period(self) -> sympy.Float:
        return sympy.Float(self.points[-1] - self.points[0])


Pieces = list[Callable[[sympy.Expr], sympy.Expr]]
_FUNCTIONS: Mapping[str, Callable[..., sympy.Expr]] = {
    "CombiTable1D_getValue": Table.at,
    "CombiTable1D_minimumAbscissa": lambda table: sympy.Float(table.points[0]),
    "CombiTable1D_maximumAbscissa": lambda table: sympy.Float(table.points[-1]),
    "CombiTimeTable_getValue": Table.at_time,
    "CombiTimeTable_nextTimeEvent": Table.next_event,
    "CombiTimeTable_minimumTime": lambda table: sympy.Float(table.points[0]),
    "CombiTimeTable_maximumTime": lambda table: sympy.Float(table.points[-1]),
}


def _choose(limits: Sequence[sympy.Expr], options: Sequence[sympy.Expr], u: sympy.Expr) -> sympy.Expr:
    """The option by the interval of ``u``, the first one below the first limit; a tree, which asks little."""
    if not limits:
        return options[0]
    at = len(limits) // 2
    below, above = _choose(limits[:at], options[: at + 1], u), _choose(limits[at + 1 :], options[at + 1 :], u)
    return sympy.Piecewise((below, compare(sympy.Gt, limits[at], u)), (above, True), evaluate=False)


def _line(x: float, y: sympy.Expr, slope: sympy.Expr) -> Callable[[sympy.Expr], sympy.Expr]:
    return lambda u: y + slope * (u - sympy.Float(x))


def _cubic(x: float, y: float, coefficients: tuple[float, float, float]) -> Callable[[sympy.Expr], sympy.Expr]:
    a, b, c = map(sympy.Float, coefficients)

    def at(u: sympy.Expr) -> sympy.Expr:
        v = u - sympy.Float(x)
        return sympy.Float(y) + ((a * v + b) * v + c) * v

    return at


def _numbers(reader: Reader, values: Value) -> list[float]:
    """The numbers of an array; BuildError or ValueError where these change in time."""
    found = [reader.components.structure(value) for value in values]
    if not all(number.is_number for number in found):
        raise ValueError("points of a table, and values of one with splines, have to be numbers or parameters")
    return [float(number) for number in found]


def _text(reader: Reader, node: Node) -> str | None:
    """A String, by way of conditions that are known when the unit is built; None for others."""
    tag, body = next(iter(node.items()))
    if tag == "If":
        for condition, value in body["branches"]:
            truth = reader.components.structure(reader.condition(condition))
            if truth != sympy.false:
                return _text(reader, value) if truth == sympy.true else None
        return _text(reader, body["else_branch"])
    return body["value"].get("String") if tag == "Literal" else None
