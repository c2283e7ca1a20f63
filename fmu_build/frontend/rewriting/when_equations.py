"""When-clauses among equations that rumoca refuses, said in other words.

``when c then b[1] = u; for i in 2:n loop b[i] = pre(b[i-1]); end for; end when;`` assigns elements, so each becomes an
equation, ``b[1] = if edge(c) then u else pre(b[1])``; b is declared discrete then. ``(a, b) = f(x)`` becomes a
statement. A clock is called ``sample(0, 1) or false``, lest rumoca assigns the variables to that clock alone.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from .gathered import gathered
from .statements import (
    Assigned,
    Branches,
    NotSaidOtherwiseError,
    Outputs,
    Repeated,
    Statement,
    Whens,
    assigned_in,
    statements_of,
)
from .tokens import (
    ClassBody,
    Token,
    arguments,
    classes_of,
    closing,
    declared_clocks,
    declared_names,
    discrete_types,
    placed,
    sections_of,
    tokens_of,
    written,
)
from .when_words import named_condition, vector_parts

Change = tuple[int, int, str]


def with_whens_restated(text: str) -> str:
    """The Modelica text with those when-clauses in other words; no line moves."""
    changes: set[Change] = set()
    for owner in classes_of(tokens_of(text)):
        whens = list(_whens(owner))
        targets = {name for when in whens for name in assigned_in([when])}
        for when in whens:
            try:
                changes |= set(_changes(text, owner, when, targets))
            except NotSaidOtherwiseError:
                continue
    for start, end, replacement in sorted(changes, reverse=True):
        text = text[:start] + replacement + text[end:]
    return text


def _whens(owner: ClassBody) -> Iterator[Whens]:
    """The when-clauses among the equations of a class that can be read; in loops conditions could be no variables."""
    for word, tokens in sections_of(owner):
        at = depth = 0
        while word.text == "equation" and at < len(tokens):
            if tokens[at].text == "for":
                depth += 1 if tokens[at - 1].text != "end" else -1
            if tokens[at].text != "when" or depth:
                at += 1
                continue
            last = next(
                (k for k in range(at, len(tokens) - 1) if (tokens[k].text, tokens[k + 1].text) == ("end", "when")), at
            )
            try:
                (when,) = statements_of(tokens[at : last + 3], "=")
            except NotSaidOtherwiseError:
                at = last + 3
                continue
            assert isinstance(when, Whens)
            yield when
            at = last + 3


def _changes(text: str, owner: ClassBody, when: Whens, targets: set[str]) -> Iterator[Change]:
    statements = [statement for _, block in when.branches for statement in block]
    if not any(_is_refused(statement) for statement in statements):
        yield from _without_clocks(when)
        return
    if len(when.branches) > 1:
        raise NotSaidOtherwiseError
    first, last = (text.count("\n", 0, token.start) for token in (when.tokens[0], when.tokens[-1]))
    condition = when.branches[0][0] or ()
    if {"Clock", *declared_clocks(owner.tokens)} & {token.text for token in condition}:
        whole = [(text.count("\n", 0, start), words) for start, words in gathered(statements)]
        inside = placed([(first, f"when {written(condition)} then"), *whole, (last, "end when;")], first, last)
        yield when.tokens[0].start, when.tokens[-1].end, inside
        return
    conditions: dict[str, str] = {}
    for part in vector_parts(condition):
        named_condition(part, owner, conditions)
    pieces = [(text.count("\n", 0, start), words) for start, words in _words(statements, conditions)]
    yield when.tokens[0].start, when.tokens[-1].end, placed(pieces, first, last)
    declared = "".join(f" Boolean {name} = {value};" for name, value in conditions.items() if value)
    if declared:
        yield owner.start, owner.start, f"protected{declared} public "
    for name in set(assigned_in([*filter(_has_elements, statements)])) - discrete_types(owner).keys():
        yield _discrete(name, owner, targets)


def _is_refused(statement: Statement) -> bool:
    return isinstance(statement, Outputs) or _has_elements(statement)


def _has_elements(statement: Statement) -> bool:
    """Whether it assigns elements of arrays."""
    if isinstance(statement, Assigned):
        return statement.target[-1].text == "]"
    if isinstance(statement, Repeated):
        return any(map(_has_elements, statement.body))
    if isinstance(statement, Branches) and any(_has_elements(s) for _, block in statement.branches for s in block):
        raise NotSaidOtherwiseError
    return False


def _words(statements: Sequence[Statement], conditions: dict[str, str]) -> Iterator[tuple[int, str]]:
    """Equations and clauses in place of the statements, with places."""
    edge = " or ".join(f"edge({name})" for name in conditions)
    vector = f"{{{', '.join(conditions)}}}"
    for statement in statements:
        if _has_elements(statement):
            yield _first(statement).start, _elementwise(statement, edge)
        elif isinstance(statement, Outputs):
            call = f"{written(statement.whole)} := {written(statement.value)};"
            yield _first(statement).start, f"algorithm when {vector} then {call} end when; equation"
        elif isinstance(statement, Assigned):
            equation = f"{written(statement.target)} = {written(statement.value)};"
            yield _first(statement).start, f"when {vector} then {equation} end when;"
        else:
            raise NotSaidOtherwiseError


def _elementwise(statement: Statement, edge: str) -> str:
    if isinstance(statement, Repeated) and all(map(_has_elements, statement.body)):
        inside = " ".join(_elementwise(part, edge) for part in statement.body)
        return f"for {statement.variable} in {written(statement.range)} loop {inside} end for;"
    if not isinstance(statement, Assigned):
        raise NotSaidOtherwiseError
    target = written(statement.target)
    return f"{target} = if {edge} then {written(statement.value)} else pre({target});"


def _first(statement: Statement) -> Token:
    if isinstance(statement, Repeated):
        return statement.range[0]
    assert isinstance(statement, Assigned | Outputs)
    return (statement.target if isinstance(statement, Assigned) else statement.whole)[0]


def _without_clocks(when: Whens) -> Iterator[Change]:
    for condition, _ in when.branches:
        tokens = condition or ()
        for k, token in enumerate(tokens):
            last = closing(tokens, k + 1) if token.text == "sample" else k
            if len(arguments(tokens[k + 2 : last])) == 2:
                yield token.start, token.start, "("
                yield tokens[last].end, tokens[last].end, " or false)"


def _discrete(name: str, owner: ClassBody, targets: set[str]) -> Change:
    """``discrete`` before the declaration of a variable, which may declare no other ones than those of when-clauses."""
    declaration: list[Token] = []
    for token in owner.tokens:
        if token.text == ";":
            k = next((k for k, t in enumerate(declaration) if t.text == "Real"), -1)
            names = declared_names(declaration[k + 1 :]) if k >= 0 else []
            if name in names and set(names) <= targets:
                k -= declaration[k - 1].text in {"input", "output"}
                return declaration[k].start, declaration[k].start, "discrete "
            declaration = []
        else:
            declaration.append(token)
    raise NotSaidOtherwiseError
