"""When-clauses of an algorithm section in the form that rumoca takes.

Those that assign the same variables become one: ``when a then n := n+1; end when; when b then n := 0; end when;`` says
the same as ``when {a, b} then if edge(a) then n := n+1; end if; if edge(b) then n := 0; end if; end when;``, with
variables for conditions that are none. Loops are unrolled, or become sums, which are variables too.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from .loop_words import loop_words, numbers
from .references import replaced
from .statements import (
    Assigned,
    Branches,
    Called,
    NotSaidOtherwiseError,
    Outputs,
    Repeated,
    Statement,
    Tokens,
    Whens,
    assigned_in,
)
from .tokens import ClassBody, arguments, discrete_types, is_reference, written


def when_words(whens: Sequence[Whens], text: str, owner: ClassBody, targets: set[str]) -> tuple[str, str]:
    """The when-clauses, and declarations that they need; ``targets`` are what the whole section assigns."""
    assigned = [name for when in whens for name in dict.fromkeys(assigned_in([when]))]
    if len(set(assigned)) == len(assigned) and not any(token.text == "for" for when in whens for token in when.tokens):
        first, last = whens[0].tokens[0], whens[-1].tokens[-1]
        return text[first.start : last.end], ""
    body = _Body(owner, targets)
    blocks = [body.clause(when) for when in whens]
    declared = "".join(f" {kind} {name} = {value};" for name, (kind, value) in body.declared.items())
    return (
        f"when {{{', '.join(body.conditions)}}} then {' '.join(blocks)} end when;",
        f"protected{declared} public " if declared else "",
    )


def vector_parts(condition: Tokens) -> list[Tokens]:
    """The elements of a vector of conditions."""
    is_vector = condition[0].text == "{" and condition[-1].text == "}"
    return [*arguments(condition[1:-1])] if is_vector else [condition]


def named_condition(condition: Tokens, owner: ClassBody, conditions: dict[str, str]) -> str:
    """The variable that a condition is, or the one that it gets; ``conditions`` collects names and what is behind."""
    text = written(condition)
    if is_reference(condition):
        conditions[text] = ""
        return text
    name = name_of(text, owner)
    conditions[name] = f"{text} or false" if condition[0].text == "sample" else text
    return name


def name_of(text: str, owner: ClassBody) -> str:
    """The name of the variable that an expression of a class gets."""
    plain = text.replace("'", "`").replace("\\", "")
    return f"'{owner.name}: {plain}'"


class _Body:
    """Statements of when-clauses, written down again. ``declared``: name to type and value."""

    def __init__(self, owner: ClassBody, targets: set[str]) -> None:
        self._owner, self._targets = owner, targets
        self._numbers: dict[str, str] = {}
        self.conditions: dict[str, str] = {}
        self.declared: dict[str, tuple[str, str]] = {}

    def clause(self, when: Whens) -> str:
        """``if edge(a) then ... elseif ... end if;``"""
        words = []
        for condition, block in when.branches:
            names = [named_condition(part, self._owner, self.conditions) for part in vector_parts(condition or ())]
            words.append(f"if {' or '.join(f'edge({name})' for name in names)} then {self._block(block)}")
        self.declared |= {name: ("Boolean", value) for name, value in self.conditions.items() if value}
        return f"{' else'.join(words)} end if;"

    def _block(self, statements: Sequence[Statement]) -> str:
        return " ".join(words for statement in statements for words in self._words(statement))

    def _text(self, tokens: Tokens, kept: object = None) -> str:
        return replaced(tokens, lambda reference, _: self._numbers.get(reference, reference))

    def _words(self, statement: Statement) -> Iterator[str]:
        if isinstance(statement, Assigned):
            yield f"{self._text(statement.target)} := {self._text(statement.value)};"
        elif isinstance(statement, Outputs):
            yield f"{self._text(statement.whole)} := {self._text(statement.value)};"
        elif isinstance(statement, Called):
            yield f"{self._text(statement.call)};"
        elif isinstance(statement, Repeated):
            yield from self._loop(statement)
        elif isinstance(statement, Branches):
            parts = [
                (f"if {self._text(condition)} then " if condition else " ") + self._block(block)
                for condition, block in statement.branches
            ]
            yield f"{' else'.join(parts)} end if;"
        else:
            raise NotSaidOtherwiseError

    def _loop(self, loop: Repeated) -> Iterator[str]:
        bounds = self._text(loop.range)
        if (found := numbers(bounds)) is not None:
            for number in found:
                self._numbers[loop.variable] = str(number)
                yield self._block(loop.body)
            del self._numbers[loop.variable]
            return
        words = loop_words(loop, bounds, self._text)
        types = discrete_types(self._owner)
        for target, (operator, term) in words.terms.items():
            if words.equations or any(f" {other} " in term for other in self._targets) or "pre (" in term:
                raise NotSaidOtherwiseError
            name = name_of(term, self._owner)
            self.declared[name] = (types.get(target, "Real"), term)
            yield f"{target} := {target} {operator} {name};"
        if words.equations:
            raise NotSaidOtherwiseError
