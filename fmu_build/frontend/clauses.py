"""When-clauses, algorithm sections and assertions of rumoca's flat form."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import sympy

from ..errors import BuildError
from ..ir.equations import Assignment
from ..ir.events import Algorithm, Check, Choice, Reinit, Statement, Together, When, WhenBranch
from .components import elements_for
from .event_expressions import EventReader
from .expressions import unwrap
from .values import Value, elements

Node = Mapping[str, Any]
KEYS = {"condition": ("condition", "cond"), "statements": ("equations", "stmts")}  # of equations, of algorithms


def assigned_names(flat: Node) -> frozenset[str]:
    """The variables that when-clauses assign: they are discrete, whatever their declarations say."""
    chains = (chain for chain in flat["when_chains"])
    names = {
        n for chain in chains for block in (chain["first"], *chain["else_when"]) for n in _targets(block["equations"])
    }
    for section in flat["algorithms"]:
        names |= {n for node in section["statements"] if "When" in node for n in _targets([node])}
    return frozenset(names)


def read_whens(flat: Node, reader: EventReader) -> tuple[When, ...]:
    """The when-clauses among the equations."""
    return tuple(
        When(tuple(_branch(block, reader) for block in (chain["first"], *chain["else_when"])))
        for chain in flat["when_chains"]
    )


def read_algorithms(sections: Sequence[Node], reader: EventReader) -> tuple[Algorithm, ...]:
    """Algorithm sections."""
    return tuple(
        Algorithm(
            _statements(section["statements"], reader, event_free=False),
            tuple(s.name for output in section["outputs"] for s in elements(reader.component(output["name"]))),
            reader.sources.find_place(section["statements"]),
        )
        for section in sections
    )


def read_checks(flat: Node, reader: EventReader) -> tuple[Check, ...]:
    """Assertions among the equations: looked at after each step, no events of their own."""
    return tuple(reader.check(node) for node in (*flat["assert_equations"], *flat["initial_assert_equations"]))


def _targets(nodes: Sequence[Node]) -> Iterator[str]:
    for node in nodes:
        tag, body = next(iter(node.items()))
        if tag in {"Assign", "Assignment"}:
            yield _target(body)
        elif tag == "FunctionCall":
            yield from (_target({"comp": output}) for output in body["outputs"] if output is not None)
        elif tag == "For":
            yield from _targets(body["equations"])
        elif tag in {"Conditional", "If", "When"}:
            for _, statements in _conditional_parts(tag, body):
                yield from _targets(statements)


def _target(body: Node) -> str:
    """The variable that is assigned, without the last subscripts."""
    if "target" in body:
        return _name(body["target"])
    return ".".join(part["ident"] for part in body["comp"]["parts"])


def _scalars(body: Node, reader: EventReader) -> Value:
    """The scalars that are assigned, as symbols: a variable, an element or a part of it, a record."""
    if "target" in body:
        return reader.component(_target(body))
    *parents, last = body["comp"]["parts"]
    if any(part["subs"] for part in parents):
        raise ValueError("an array of components with a part assigned in an algorithm section: not supported")
    found = reader.component(_target(body), last["subs"])
    if not all(scalar.is_Symbol for scalar in elements(found)):
        raise ValueError("an assignment to a subscript that changes in time: not supported; choose by if")
    return found


def _name(node: Any) -> str:
    if isinstance(node, str):
        return node
    return str(node["name"]) if "name" in node else _name(unwrap(node))


def _conditional_parts(tag: str, body: Node) -> list[tuple[Any, Sequence[Node]]]:
    """Condition (None: otherwise) and statements of each branch."""
    if tag == "Conditional":
        parts = [(condition, statements) for condition, statements in body["branches"]]
        last = body["else_branch"]
    else:
        blocks = body["blocks"] if tag == "When" else body["cond_blocks"]
        parts = [(block["cond"], block["stmts"]) for block in blocks]
        last = body.get("else_block")
    return parts if last is None else [*parts, (None, last)]


def _branch(block: Node, reader: EventReader) -> WhenBranch:
    condition = next(block[key] for key in KEYS["condition"] if key in block)
    statements = next(block[key] for key in KEYS["statements"] if key in block)
    return WhenBranch(
        tuple(reader.conditions(condition)),
        _statements(statements, reader, event_free=True),
        reader.sources.find_place(condition),
    )


def _statements(nodes: Sequence[Node], reader: EventReader, *, event_free: bool) -> tuple[Statement, ...]:
    return tuple(s for node in nodes for s in _statement(node, reader, event_free=event_free))


def _statement(node: Node, reader: EventReader, *, event_free: bool) -> Sequence[Statement]:
    """The statement; a loop is unrolled."""
    tag, body = next(iter(node.items()))
    origin = reader.sources.find_place(node)
    try:
        if tag in {"Assign", "Assignment"}:
            return [_assignment(body, reader, origin, event_free=event_free)]
        if tag == "FunctionCall":
            return [_outputs(body, reader, origin)]
        if tag == "For":
            return list(_loop(body["indices"], body["equations"], reader, event_free=event_free))
    except ValueError as error:
        raise BuildError(f"{origin}: {error}") from None
    if tag == "Reinit":
        states = reader.component(_name(body["state"]))
        values = elements_for(states, reader.read_event_free(body["value"]))
        return [Reinit(s.name, sympy.true, value, origin) for s, value in zip(elements(states), values, strict=True)]
    if tag == "Assert":
        return [reader.check(body)]
    if tag == "Terminate":
        return [Check(sympy.true, reader.message(body["message"]), "END", origin)]
    if tag in {"Conditional", "If"}:
        condition = reader.condition_event_free if event_free else reader.condition
        return [
            Choice(
                tuple(
                    (
                        sympy.true if part is None else condition(part),
                        _statements(statements, reader, event_free=event_free),
                    )
                    for part, statements in _conditional_parts(tag, body)
                )
            )
        ]
    if tag == "When":
        return [When(tuple(_branch(block, reader) for block in body["blocks"]))]
    raise BuildError(
        f"{origin}: {tag} in a when-clause or an algorithm section: supported are assignments, if, for, when, reinit,"
        " assert and terminate"
    )


def _assignment(body: Node, reader: EventReader, origin: str, *, event_free: bool) -> Statement:
    target = _scalars(body, reader)
    value = (reader.read_event_free if event_free else reader.read)(body["value"])
    pairs = zip(elements(target), elements_for(target, value), strict=True)
    one, *others = (Assignment(scalar.name, part, origin) for scalar, part in pairs)
    return Together((one, *others)) if others else one


def _outputs(body: Node, reader: EventReader, origin: str) -> Statement:
    """``(a, b) := f(x)``; a place may be empty. Inside functions there are no events."""
    values = reader.outputs({**body, "name": body["comp"], "is_constructor": False})
    targets = [
        (_scalars({"comp": o}, reader), v) for o, v in zip(body["outputs"], values, strict=False) if o is not None
    ]
    pairs = [p for t, v in targets for p in zip(elements(t), elements_for(t, v), strict=True)]
    return Together(tuple(Assignment(scalar.name, part, origin) for scalar, part in pairs))


def _loop(
    indices: Sequence[Node], statements: Sequence[Node], reader: EventReader, *, event_free: bool
) -> Iterator[Statement]:
    if not indices:
        yield from _statements(statements, reader, event_free=event_free)
        return
    for value in reader.read(indices[0]["range"]):
        with reader.bound(indices[0]["ident"], value):
            yield from _loop(indices[1:], statements, reader, event_free=event_free)
