"""Functions and algorithms, run on symbols: what comes out are expressions.

Loops are unrolled and both branches of a conditional are run; a value then is a conditional expression. So that
expressions don't grow from statement to statement, large ones become variables of their own (see
ExpressionReader.share), which keeps derivatives exact: the chain rule goes through those as through all others.
Conditions in a function are no relations: Modelica makes no events inside functions.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import sympy

from .reader import Reader
from .standard_tables import TIME_TABLE, evaluate, line_in_time
from .subscripts import indices
from .values import Value, combine, each, full

Node = Mapping[str, Any]
Names = dict[str, Value]
MAX_PASSES = 10_000  # of a while


def call(reader: Reader, function: Node, arguments: Sequence[Value]) -> tuple[Value, ...]:
    """The outputs of a function."""
    inputs = function["inputs"]
    if function["name"].endswith(TIME_TABLE):
        return line_in_time(reader, arguments)
    if function["external"] is not None:
        if (value := evaluate(function, arguments)) is not None:
            return (value,)
        raise ValueError(f"{function['name']} is an external function: write its algorithm in Modelica")
    if len(arguments) > len(inputs):
        raise ValueError(f"{function['name']} takes {len(inputs)} arguments")
    if over := _vectors(inputs, arguments):
        vectors = [arguments[i] for i in over]
        return (each(lambda *scalars: call(reader, function, _merged(arguments, over, scalars))[0], *vectors),)
    names: Names = dict(zip((node["name"] for node in inputs), arguments, strict=False))
    with reader.inside_function(names):
        # A default may read others; those that stand in another order than this one rumoca refuses.
        for node in (*inputs[len(arguments) :], *function["outputs"], *function["locals"]):
            names[node["name"]] = _initial(reader, node)
        run(reader, function["body"], names)
    return tuple(names[node["name"]] for node in function["outputs"])


def run(reader: Reader, statements: Sequence[Node], names: Names) -> None:
    """Run statements; they read and write ``names``."""
    for index, statement in enumerate(statements):
        tag, body = next(iter(statement.items()))
        if tag == "Assignment":
            value = reader.read(body["value"])
            _assign(reader, names, body["comp"]["parts"], value)
        elif tag == "FunctionCall":
            _assign_outputs(reader, names, body)
        elif tag == "If" and _returns(body):  # what follows belongs to the branches that do not return
            _branch(reader, body, names, statements[index + 1 :])
            return
        elif tag == "If":
            _branch(reader, body, names, ())
        elif tag == "For" and not _returns(body):
            _loop(reader, body["indices"], body["equations"], names)
        elif tag == "While" and not _returns(body):
            _repeat(reader, body, names)
        elif tag == "Assert":
            reader.assertion(body)
        elif tag == "Return":
            return
        elif tag != "Empty":
            raise ValueError(f"{tag} in an algorithm: not supported; write an assignment, if, or for without return")


def _returns(node: Any) -> bool:
    """Whether there is a return or a break inside."""
    if isinstance(node, Mapping):
        return "Return" in node or "Break" in node or any(_returns(part) for part in node.values())
    return isinstance(node, list) and any(map(_returns, node))


def _repeat(reader: Reader, body: Node, names: Names) -> None:
    """A while, of which it must be known here how often it is passed through."""
    for _ in range(MAX_PASSES):
        truth = reader.condition(body["block"]["cond"])
        if truth == sympy.false:
            return
        if truth != sympy.true:
            break
        run(reader, body["block"]["stmts"], names)
    raise ValueError("a while whose number of passes is not known when the unit is built: write a for")


def _loop(reader: Reader, indices: Sequence[Node], statements: Sequence[Node], names: Names) -> None:
    if not indices:
        run(reader, statements, names)
        return
    name = indices[0]["ident"]
    outside = names.get(name)
    for value in reader.read(indices[0]["range"]):
        names[name] = value
        _loop(reader, indices[1:], statements, names)
    names.pop(name, None)
    if outside is not None:
        names[name] = outside


def _branch(reader: Reader, body: Node, names: Names, rest: Sequence[Node]) -> None:
    """Every branch, and the ``rest`` behind it, starts from the same values; where they differ afterwards, the value
    is a conditional."""
    before = dict(names)
    results: list[tuple[Names, Any]] = []
    otherwise = [(True, body["else_block"] or [])]
    for condition, statements in [(b["cond"], b["stmts"]) for b in body["cond_blocks"]] + otherwise:
        truth = sympy.true if condition is True else reader.condition(condition)
        if truth == sympy.false:
            continue
        names.clear()
        names.update(before)
        if truth == sympy.true:
            run(reader, [*statements, *rest], names)
        else:
            with reader.inside_branch():
                run(reader, [*statements, *rest], names)
        results.append((dict(names), truth))
        if truth == sympy.true:
            break
    for name in dict.fromkeys(name for result, _ in results for name in result):
        given = [(result[name], truth) for result, truth in results if result.get(name) is not None]
        names[name] = _choose(reader, name, given)


def _choose(reader: Reader, name: str, pairs: list[tuple[Value, Any]]) -> Value:
    values = [value for value, _ in pairs]
    if not values:
        return None
    if all(value is values[0] for value in values):
        return values[0]
    conditions = [truth for _, truth in pairs[:-1]]
    return reader.share(name, combine(lambda *scalars: _conditional(scalars, conditions), *values))


def _conditional(values: Sequence[Any], conditions: Sequence[Any]) -> Any:
    """The values are scalars; an element that no statement has given a value yet is None."""
    given = [value for value in values if value is not None]
    if not given or all(value == given[0] for value in given):
        return given[0] if given else None
    pairs = [
        (value, truth) for value, truth in zip(values, [*conditions, sympy.true], strict=True) if value is not None
    ]
    return sympy.Piecewise(*pairs[:-1], (pairs[-1][0], True), evaluate=False)


def _assign_outputs(reader: Reader, names: Names, body: Node) -> None:
    """``(a, b) := f(x)``"""
    values = reader.outputs({**body, "name": body["comp"], "is_constructor": False})
    for target, value in zip(body["outputs"], values, strict=False):
        if target is not None:
            _assign(reader, names, target["parts"], value)


def _assign(reader: Reader, names: Names, parts: Sequence[Node], value: Value) -> None:
    first = parts[0]["ident"]
    names[first] = _replaced(reader, names.get(first), parts, reader.share(first, value))


def _replaced(reader: Reader, whole: Value, parts: Sequence[Node], value: Value) -> Value:
    """A copy of ``whole`` with ``value`` in the place that the parts (fields and subscripts) lead to."""
    part, rest = parts[0], parts[1:]
    if part["subs"]:
        if not isinstance(whole, np.ndarray):
            raise ValueError(f"{part['ident']}[...] := in an algorithm: give the whole array a value first")
        result = whole.copy()
        index = indices(reader, part["subs"], whole.shape)
        if rest:
            value = _inside(reader, whole[index], rest, value)
        if isinstance(result[index], np.ndarray) and not isinstance(value, np.ndarray):
            value = full(result[index].shape, value)
        result[index] = value
        return result
    return _inside(reader, whole, rest, value) if rest else value


def _inside(reader: Reader, record: Value, parts: Sequence[Node], value: Value) -> Value:
    name = parts[0]["ident"]
    record = {} if record is None else record
    return {**record, name: _replaced(reader, record.get(name), parts, value)}


def _initial(reader: Reader, node: Node) -> Value:
    """What a variable starts with: its default; elements without a value are None."""
    shape = reader.shape(node["shape_expr"])
    if node["default"] is not None:
        value = reader.read(node["default"])
        return full(shape, value) if shape and not isinstance(value, np.ndarray) else value
    empty = reader.empty_record(node["type_def_id"]) if node["type_class"] == "Record" else None
    return full(shape, empty) if shape else empty


def _vectors(inputs: Sequence[Node], arguments: Sequence[Value]) -> list[int]:
    """The arguments that are arrays where the function takes scalars: it then goes over their elements."""
    return [
        i
        for i, (node, argument) in enumerate(zip(inputs, arguments, strict=False))
        if isinstance(argument, np.ndarray) and not node["shape_expr"]
    ]


def _merged(arguments: Sequence[Value], over: Sequence[int], scalars: Sequence[Value]) -> list[Value]:
    replaced = dict(zip(over, scalars, strict=True))
    return [replaced.get(i, argument) for i, argument in enumerate(arguments)]
