"""rumoca's expression trees to SymPy."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

import sympy
from sympy.logic.boolalg import Boolean

from ..errors import BuildError
from ..ir.conditions import compare
from ..ir.equations import Assignment, Relation
from ..ir.functions import no_number
from ..ir.symbols import der, holds, shared_name, symbol
from .builtin import ARRAY, BINARY, SCALAR, SIZES, finite
from .choices import CHOICES
from .components import Components
from .functions import call
from .sources import Sources
from .standard_tables import is_table, table
from .subscripts import element
from .values import ONE, ZERO, Value, array, combine, concatenate, each, field, full

RELATIONS = {"Lt": "<", "Le": "<=", "Gt": ">", "Ge": ">="}
INSTEAD = {"Delay": "; write a chain of lags, or sample the value"}
LARGE = 40  # nodes of an expression that gets a variable of its own where it can, see ExpressionReader.share


def unwrap(node: Any) -> str:
    """The tag of one of rumoca's enumerations, which are strings or one-entry objects."""
    return str(next(iter(node)) if isinstance(node, dict) else node)


class ExpressionReader:
    """Reads expressions of one flat model and collects the relations that it meets.

    Within noEvent(), and in functions, a condition is no relation: it is evaluated as it stands, at any time. Elsewhere
    abs(), min() and max() are conditionals with a relation, so that their kinks are located as well.
    """

    def __init__(self, sources: Sources, flat: Mapping[str, Any], fixed: frozenset[str] = frozenset()) -> None:
        self.sources = sources
        self.relations: list[Relation] = []
        self.shared: list[Assignment] = []  # what share() has given a variable
        self.components = Components(flat["variables"], fixed, flat["enum_literal_ordinals"], self._read_declaration)
        self._functions = flat["functions"]
        self._records = flat["record_types"]
        self._event_free = False
        self.names: dict[str, Value] = {}  # variables of the function that is being read, and of loops
        self._shares = False
        self._origin = ""

    @contextmanager
    def equation(self, origin: str, names: Mapping[str, Value] | None = None) -> Iterator[None]:
        """What is read is an equation at ``origin``: its parts may become variables of their own."""
        self._shares, self._origin, self.names = True, origin, dict(names or {})
        try:
            yield
        finally:
            self._shares, self.names = False, {}

    @contextmanager
    def inside_function(self, names: dict[str, Value]) -> Iterator[None]:
        """What is read is the body of a function with these variables."""
        outside = self.names, self._event_free
        self.names, self._event_free = names, True
        try:
            yield
        finally:
            self.names, self._event_free = outside

    @contextmanager
    def bound(self, name: str, value: Value) -> Iterator[None]:
        """What is read is the body of a loop, with its variable at a value."""
        outside, self.names = self.names, {**self.names, name: value}
        try:
            yield
        finally:
            self.names = outside

    @contextmanager
    def inside_branch(self) -> Iterator[None]:
        """What is read counts under a condition only, so it cannot be computed ahead."""
        outside, self._shares = self._shares, False
        try:
            yield
        finally:
            self._shares = outside

    def share(self, name: str, value: Value) -> Value:
        """The value, of which large expressions are replaced by variables, named after ``name``, that equal them."""
        return combine(lambda scalar: self._share(name, scalar), value) if self._shares else value

    def _share(self, name: str, scalar: sympy.Expr | None) -> sympy.Expr | None:
        # A variable is computed in any case, and NaN ends the run, though only a branch may need it that is not taken.
        is_kept = scalar is None or not _is_large(scalar) or scalar.has(no_number)
        return scalar if is_kept else self.named(name, scalar)

    def named(self, name: str, scalar: sympy.Expr) -> sympy.Expr:
        """A variable that equals an expression, named after ``name``; the expression where there can be none."""
        if not self._shares or not scalar.args:
            return scalar
        variable = shared_name(name, len(self.shared))
        self.shared.append(Assignment(variable, scalar, self._origin))
        return symbol(variable)

    def read(self, node: Mapping[str, Any]) -> Value:
        """The value of an expression; BuildError with its place where a construct is not supported."""
        try:
            return self._read(node)
        except (ValueError, IndexError) as error:
            raise BuildError(f"{self.sources.find_place(node)}: {error}") from None

    def _read_declaration(self, node: Mapping[str, Any]) -> Value:
        """The same for the binding of a component, whatever is being read."""
        with self.inside_function({}), self.inside_branch():
            return self.read(node)

    def read_scalar(self, node: Mapping[str, Any]) -> sympy.Expr:
        """The same for what has to be a scalar."""
        value = self.read(node)
        if not isinstance(value, sympy.Basic):
            raise BuildError(f"{self.sources.find_place(node)}: this is an array or a record, needed is a scalar")
        return value

    def _read(self, node: Mapping[str, Any]) -> Value:
        tag, body = next(iter(node.items()))
        if tag in _READERS:
            return _READERS[tag](self, body)
        if tag == "Unary" and body["op"] in {"Minus", "Plus", "MinusElem", "PlusElem"}:
            operand = self.read(body["rhs"])
            return combine(lambda x: -x, operand) if body["op"].startswith("Minus") else operand
        if tag == "Binary" and "Tuple" in body["lhs"]:
            return self._several(body)
        if tag == "Binary" and body["op"] in BINARY:
            return finite(BINARY[body["op"]](self.read(body["lhs"]), self.read(body["rhs"])))
        raise self._unsupported(node)

    def _literal(self, body: Mapping[str, Any]) -> Value:
        kind, value = next(iter(body["value"].items()))
        if kind == "Boolean":
            return sympy.true if value else sympy.false
        if kind not in {"Real", "Integer"}:
            raise self._unsupported({"Literal": body})
        return sympy.Integer(value) if kind == "Integer" else sympy.Float(value)

    def _reference(self, body: Mapping[str, Any]) -> Value:
        value = self._named(body["name"]["name"])
        return element(self, value, body["subscripts"]) if body["subscripts"] else value

    def _named(self, name: str) -> Value:
        if name in self.names:
            return self.names[name]
        record, dot, rest = name.rpartition(".")
        if dot and record.partition(".")[0].partition("[")[0] in self.names:
            return field(self._named(record), rest)
        try:
            return self.components.value(name)
        except KeyError:
            return symbol(name)  # time

    def component(self, name: str, subscripts: Sequence[Mapping[str, Any]] = ()) -> Value:
        """A component of the model as symbols, also where the variable of a loop has its name."""
        value = self.components.value(name)
        return element(self, value, subscripts) if subscripts else value

    def _indexed(self, body: Mapping[str, Any]) -> Value:
        return element(self, self.read(body["base"]), body["subscripts"])

    def _field(self, body: Mapping[str, Any]) -> Value:
        return field(self.read(body["base"]), body["field"])

    def shape(self, sizes: Sequence[Mapping[str, Any]]) -> list[int]:
        """The sizes of a declaration as numbers; ``:`` counts as none."""
        found = []
        for size in sizes:
            tag, body = next(iter(size.items()))
            if tag != "Colon":
                value = sympy.Integer(body["value"]) if tag == "Index" else self.read(body["expr"])
                found.append(int(self.components.structure(value)))
        return found if len(found) == len(sizes) else []

    def empty_record(self, type_id: int) -> dict[str, Value]:
        """A record without values."""
        fields = self._records[str(type_id)]["fields"]
        return {f["name"]: full(f["dims"], None) if f["dims"] else None for f in fields}

    def _array(self, body: Mapping[str, Any]) -> Value:
        parts = [self.read(element) for element in body["elements"]]
        if body["kind"] == "Array":
            return array(parts)
        return concatenate(parts, axis=1 if body["kind"] == "Horizontal" else 0)

    def _range(self, body: Mapping[str, Any]) -> Value:
        first, last = (self.components.structure(self.read(body[key])) for key in ("start", "end"))
        step = ONE if body["step"] is None else self.components.structure(self.read(body["step"]))
        if not (first.is_number and last.is_number and step.is_number):
            raise ValueError("a range that changes in time: only constants and parameters can bound it")
        return array([first + i * step for i in range(int((last - first) / step) + 1)])

    def _comprehension(self, body: Mapping[str, Any]) -> Value:
        if body["filter"] is not None:
            raise ValueError("a comprehension with a filter: not supported; write the elements one by one")
        return self._comprehended(body["expr"], body["indices"])

    def _comprehended(self, expression: Mapping[str, Any], indices: Sequence[Mapping[str, Any]]) -> Value:
        """Several iterators nest: the last one is the outermost dimension."""
        if not indices:
            return self.read(expression)
        *inner, outermost = indices
        found = []
        for value in self.read(outermost["range"]):
            with self.bound(outermost["name"], value):
                found.append(self._comprehended(expression, inner))
        return array(found)

    def _declared_function(self, body: Mapping[str, Any]) -> Value:
        """In an expression a function with several outputs stands for the first one."""
        return self.outputs(body)[0]

    def outputs(self, body: Mapping[str, Any]) -> tuple[Value, ...]:
        """All outputs of a function call; a record's constructor gives a record."""
        name = body["name"]["name"]
        function = self._functions.get(name)
        if function is not None and is_table(function):
            return (table(self, function, body["args"]),)
        arguments = [self.read(argument) for argument in body["args"]]
        if body["is_constructor"] or function is None:
            return (dict(zip(self._constructed(name), arguments, strict=True)),)
        return tuple(self.share(name, value) for value in call(self, function, arguments))

    def _constructed(self, name: str) -> list[str]:
        for record in self._records.values():
            if record["name"] == name or record["name"].endswith(f".{name}"):
                return [str(f["name"]) for f in record["fields"]]
        raise ValueError(f"{name}(): not supported; write a function with an algorithm in Modelica")

    def assertion(self, node: Mapping[str, Any]) -> None:
        """Keep what a function asserts; for EventReader to say how, since it alone knows of events."""
        raise NotImplementedError  # a reader without events has no use for it, and is never asked

    def _several(self, body: Mapping[str, Any]) -> Value:
        """``(a, b) = f(x)``, as the residuals a - y1, b - y2."""
        return tuple(BINARY["Sub"](target, value) for target, value in self.parts(body))

    def parts(self, body: Mapping[str, Any]) -> list[tuple[Value, Value]]:
        """What ``(a, b) = f(x)`` says is equal: a and y1, b and y2; a place may be empty."""
        places = body["lhs"]["Tuple"]["elements"]
        targets = [None if t is None or "Empty" in t else self.read(t) for t in places]
        values = self.outputs(body["rhs"]["FunctionCall"])
        return [(t, v) for t, v in zip(targets, values, strict=False) if t is not None]

    def _call(self, body: Mapping[str, Any]) -> Value:
        function, arguments = body["function"], body["args"]
        if function == "Der":
            return combine(self._derivative, self.read(arguments[0]))
        if function == "NoEvent":
            return self._without_events(arguments[0])
        if function == "Smooth":  # how often it is differentiable is of no use here
            return self.read(arguments[1])
        if function not in SCALAR and function not in ARRAY and function not in CHOICES:
            raise self._unsupported({"BuiltinCall": body})
        values = [self.read(argument) for argument in arguments]
        if (first := SIZES.get(function)) is not None:
            values[first:] = [self.components.structure(size) for size in values[first:]]
        if function in SCALAR:
            return finite(each(SCALAR[function], *values))
        if function in ARRAY:
            return ARRAY[function](*values)
        text, origin = self.sources.text(body["span"]), self.sources.find_place(body)

        def holds(residual: sympy.Expr) -> Boolean:
            return self._holds(residual, text, origin)

        return CHOICES[function](holds, *values)

    def _derivative(self, operand: sympy.Expr) -> sympy.Expr:
        if operand.is_number:
            return ZERO
        if not operand.is_Symbol:
            raise ValueError("der() of an expression: give it a variable instead")
        return symbol(der(operand.name))

    def _without_events(self, node: Mapping[str, Any]) -> Value:
        outside, self._event_free = self._event_free, True
        try:
            return self.read(node)
        finally:
            self._event_free = outside

    def _conditional(self, body: Mapping[str, Any]) -> Value:
        pairs: list[tuple[Value, Boolean]] = []
        for condition, value in body["branches"]:
            truth = self.condition(condition)
            if truth == sympy.false:
                continue
            if truth == sympy.true:
                return self._choose(pairs, self.read(value))
            try:
                with self.inside_branch():
                    pairs.append((self.read(value), truth))
            except BuildError:  # what cannot be computed need not be, if parameters say so
                if self.components.structure(truth) != sympy.false:
                    raise
        if not pairs:
            return self.read(body["else_branch"])
        with self.inside_branch():
            return self._choose(pairs, self.read(body["else_branch"]))

    def _choose(self, pairs: list[tuple[Value, Boolean]], otherwise: Value) -> Value:
        """The first value whose condition is true, element by element."""
        truths = [truth for _, truth in pairs]

        def conditional(*values: sympy.Expr) -> sympy.Expr:
            *chosen, last = values
            if all(value == last for value in chosen):
                return last
            return sympy.Piecewise(*zip(chosen, truths, strict=True), (last, True), evaluate=False)

        return combine(conditional, *(value for value, _ in pairs), otherwise)

    def condition(self, node: Mapping[str, Any]) -> Boolean:
        """The truth of a condition; relations in it are collected."""
        return self._condition(node)

    def _condition(self, node: Mapping[str, Any]) -> Boolean:
        tag, body = next(iter(node.items()))
        if tag == "Binary" and body["op"] in RELATIONS:
            return self._relation(body)
        if tag == "Binary" and body["op"] in {"And", "Or"}:
            combine = sympy.And if body["op"] == "And" else sympy.Or
            return combine(self._condition(body["lhs"]), self._condition(body["rhs"]))
        if tag == "Unary" and body["op"] == "Not":
            return sympy.Not(self._condition(body["rhs"]))
        raise self._unsupported(node)

    def _relation(self, body: Mapping[str, Any]) -> Boolean:
        """``a > b`` is true where a - b > 0; ``a >= b`` is the negation of b > a."""
        left, right = self.read_scalar(body["lhs"]), self.read_scalar(body["rhs"])
        residual = left - right if body["op"] in {"Gt", "Le"} else right - left
        text, origin = self.sources.text(body["span"]), self.sources.place(body["span"])
        truth = self._holds(residual, text, origin)
        return sympy.Not(truth) if body["op"] in {"Le", "Ge"} else truth

    def _holds(self, residual: sympy.Expr, text: str, origin: str) -> Boolean:
        """Whether the residual is positive: what it was at the last event, or, within noEvent(), what it is."""
        if self._event_free or residual.is_number:
            return compare(sympy.Gt, residual, ZERO)
        self.relations.append(Relation(residual, text, origin))
        return holds(len(self.relations) - 1)

    def _unsupported(self, node: Mapping[str, Any]) -> BuildError:
        tag, body = next(iter(node.items()))
        what = body.get("op") or body.get("function") or tag
        text = self.sources.text(body["span"]) if "span" in body else ""
        hint = INSTEAD.get(unwrap(what), "")
        return BuildError(f"{self.sources.find_place(node)}: {unwrap(what)} in {text!r}: not supported{hint}")


_READERS: Mapping[str, Callable[[ExpressionReader, Mapping[str, Any]], Value]] = {
    "Literal": ExpressionReader._literal,
    "VarRef": ExpressionReader._reference,
    "If": ExpressionReader._conditional,
    "BuiltinCall": ExpressionReader._call,
    "FunctionCall": ExpressionReader._declared_function,
    "FieldAccess": ExpressionReader._field,
    "Index": ExpressionReader._indexed,
    "Array": ExpressionReader._array,
    "Range": ExpressionReader._range,
    "ArrayComprehension": ExpressionReader._comprehension,
}


def _is_large(expression: sympy.Expr) -> bool:
    """Whether the expression has many nodes."""
    stack, count = [expression], 0
    while stack:
        count += 1
        if count > LARGE:
            return True
        stack.extend(stack.pop().args)
    return False
