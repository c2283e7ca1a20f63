"""Loops of an algorithm whose bounds are no numbers, said without statements.

``for i in 1:n loop s := s + x[i]; end for`` adds a ``sum(x[i] for i in 1:n)``; one that gives the elements of arrays
their values, each once, is the same loop of equations.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence, Set
from dataclasses import dataclass, field

from .references import base_of
from .statements import Assigned, Branches, NotSaidOtherwiseError, Repeated, Statement, Tokens, assigned_in
from .tokens import written

MOST_PASSES = 1000
_NEUTRAL = {"+": "0", "*": "1"}
_NAMES = {"+": "sum", "*": "product"}
Read = Callable[[Tokens, Set[str]], str]  # of an expression, with names that stay
NONE: Set[str] = frozenset()


@dataclass
class LoopWords:
    """What a loop does: a term for each variable that adds up or multiplies, or equations for arrays."""

    terms: dict[str, tuple[str, str]] = field(default_factory=dict)
    equations: str = ""
    arrays: set[str] = field(default_factory=set)


def numbers(bounds: str) -> range | list[int] | None:
    """The values of a range of numbers; None if it is another one."""
    found: range | list[int]
    if parts := re.fullmatch(r"\s*(\d+)\s*:\s*(?:(-?\s*\d+)\s*:\s*)?(-?\s*\d+)\s*", bounds):
        first, step, last = (int((part or "1").replace(" ", "")) for part in parts.groups())
        if step == 0:
            raise NotSaidOtherwiseError
        found = range(first, last + (1 if step > 0 else -1), step)
    elif re.fullmatch(r"\s*\{[\d\s,]+\}\s*", bounds):
        found = [int(number) for number in re.findall(r"\d+", bounds)]
    else:
        return None
    if len(found) > MOST_PASSES:
        raise NotSaidOtherwiseError
    return found


def loop_words(loop: Repeated, bounds: str, read: Read) -> LoopWords:
    """What the loop does; ``read`` gives expressions the values from before it."""
    targets = set(assigned_in([loop]))
    if all(isinstance(s, Assigned) and s.target[-1].text == "]" for s in loop.body):
        return _equations(loop, bounds, read)
    terms = _summed(loop, targets, bounds, read)
    return LoopWords(terms=terms)


def _summed(loop: Repeated, targets: set[str], bounds: str, read: Read) -> dict[str, tuple[str, str]]:
    terms = _terms(loop.body, targets, read)
    return {
        target: (operator, f"{_NAMES[operator]}({term} for {loop.variable} in {bounds})")
        for target, (operator, term) in terms.items()
    }


def _terms(statements: Sequence[Statement], targets: set[str], read: Read) -> dict[str, tuple[str, str]]:
    """The operator and the term with which each variable changes."""
    found: dict[str, tuple[str, str]] = {}
    for statement in statements:
        if isinstance(statement, Assigned):
            new = dict([_term(statement, targets, read)])
        elif isinstance(statement, Branches):
            new = _conditional(statement, targets, read)
        elif isinstance(statement, Repeated):
            if _mentions(statement.range, targets):
                raise NotSaidOtherwiseError
            new = _summed(statement, targets, read(statement.range, NONE), read)
        else:
            raise NotSaidOtherwiseError
        if found.keys() & new.keys():
            raise NotSaidOtherwiseError
        found |= new
    return found


def _term(statement: Assigned, targets: set[str], read: Read) -> tuple[str, tuple[str, str]]:
    """``s := s + e``, ``s := e + s`` or ``s := s*e``."""
    target, value = written(statement.target), statement.value
    count = len(statement.target)
    depths = [value[k].text for k in range(len(value)) if _depth(value, k) == 0]
    if written(value[:count]) == target and value[count : count + 1] and value[count].text in "+-*":
        operator, rest = value[count].text, value[count + 1 :]
        if operator == "*" and {"+", "-"} & set(depths):
            raise NotSaidOtherwiseError
        sign = "-" if operator == "-" else ""
        operator = "*" if operator == "*" else "+"
    elif written(value[-count:]) == target and value[: -count - 1] and value[-count - 1].text == "+":
        operator, sign, rest = "+", "", value[: -count - 1]
    else:
        raise NotSaidOtherwiseError
    if _mentions(rest, targets) or "if" in depths:
        raise NotSaidOtherwiseError
    return target.replace(" ", ""), (operator, f"({sign}{read(rest, NONE)})")


def _depth(tokens: Tokens, index: int) -> int:
    before = [token.text for token in tokens[:index]]
    return sum(before.count(sign) for sign in "([{") - sum(before.count(sign) for sign in ")]}")


def _conditional(statement: Branches, targets: set[str], read: Read) -> dict[str, tuple[str, str]]:
    branches = [*statement.branches, *([] if statement.branches[-1][0] is None else [(None, ())])]
    if any(condition is not None and _mentions(condition, targets) for condition, _ in branches):
        raise NotSaidOtherwiseError
    parts = [_terms(block, targets, read) for _, block in branches]
    found = {}
    for target in dict.fromkeys(target for part in parts for target in part):
        operators = {part[target][0] for part in parts if target in part}
        if len(operators) > 1:
            raise NotSaidOtherwiseError
        (operator,) = operators
        values = [part[target][1] if target in part else _NEUTRAL[operator] for part in parts]
        chosen = " else".join(
            f"if {read(condition, NONE)} then {value}"
            for (condition, _), value in zip(branches, values, strict=True)
            if condition
        )
        found[target] = (operator, f"({chosen} else {values[-1]})")
    return found


def _mentions(tokens: Tokens, targets: set[str]) -> bool:
    """Whether one of the targets, or what may be a part of one, is read."""
    firsts = {target.partition(".")[0].partition("[")[0] for target in targets}
    return any(token.text in firsts for token in tokens)


def _equations(loop: Repeated, bounds: str, read: Read) -> LoopWords:
    """Elements that have the variable of the loop in their subscripts, read only where they have a value already."""
    known: list[str] = []
    lines = []
    names = set(assigned_in([loop]))
    for statement in loop.body:
        assert isinstance(statement, Assigned)
        target = written(statement.target)
        own = base_of(target).rstrip()
        earlier = rf"{re.escape(own)} \[ {re.escape(loop.variable)} - \d+ \]"
        rest = written(statement.value)
        for reference in (*known, *([earlier] if bounds.count(":") == 1 else [])):
            rest = re.sub(reference, "", rest)
        if not re.search(rf"\b{re.escape(loop.variable)}\b", target) or _mentions_text(rest, names):
            raise NotSaidOtherwiseError
        lines.append(f"{target} = {read(statement.value, names)};")
        known.append(re.escape(target))
    return LoopWords(equations=f"for {loop.variable} in {bounds} loop {' '.join(lines)} end for;", arrays=names)


def _mentions_text(text: str, targets: set[str]) -> bool:
    return any(re.search(rf"(?<![\w.]){re.escape(target)}(?!\w)", text) for target in targets)
