"""Elements that equations give their values one by one, as whole arrays: ``b[1] = u; b[2] = v;`` as ``b = {u, v};``."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from .loop_words import numbers
from .references import base_of, replaced
from .statements import Assigned, NotSaidOtherwiseError, Repeated, Statement, Tokens

Numbers = dict[str, str]  # of the variables of loops


def gathered(statements: Sequence[Statement]) -> list[tuple[int, str]]:
    """The equations with whole arrays, each with its place; NotSaidOtherwiseError where not all elements are known."""
    arrays: dict[str, dict[int, str]] = {}
    equations: dict[str, tuple[int, str]] = {}
    for statement, known in _single(statements, {}):
        target, value = (_with_numbers(tokens, known) for tokens in (statement.target, statement.value))
        base = base_of(target)
        if base == target:
            equations[target] = (statement.target[0].start, f"{target} = {value};")
            continue
        index = target[len(base) :].strip("[] ")
        if not index.isdigit() or int(index) in arrays.setdefault(base, {}):
            raise NotSaidOtherwiseError
        arrays[base][int(index)] = value
        equations.setdefault(base, (statement.target[0].start, ""))
    for base, elements in arrays.items():
        if sorted(elements) != list(range(1, len(elements) + 1)):
            raise NotSaidOtherwiseError
        equations[base] = (equations[base][0], f"{base} = {{{', '.join(elements[i] for i in sorted(elements))}}};")
    return list(equations.values())


def _single(statements: Sequence[Statement], known: Numbers) -> Iterator[tuple[Assigned, Numbers]]:
    """Assignments, those of loops again and again."""
    for statement in statements:
        if isinstance(statement, Repeated):
            if (found := numbers(_with_numbers(statement.range, known))) is None:
                raise NotSaidOtherwiseError
            for number in found:
                yield from _single(statement.body, {**known, statement.variable: str(number)})
        elif isinstance(statement, Assigned):
            yield statement, known
        else:
            raise NotSaidOtherwiseError


def _with_numbers(tokens: Tokens, known: Numbers) -> str:
    return replaced(tokens, lambda reference, _: known.get(reference, reference))
