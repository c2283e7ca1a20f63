"""Statements of an algorithm section, or equations of a when-clause, from tokens. Modelica 3.6, chapters 8 and 11."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from .tokens import Token, arguments, closing, is_reference, written

Tokens = Sequence[Token]


class NotSaidOtherwiseError(Exception):
    """The statements say something that has no other words here."""


@dataclass(frozen=True)
class Assigned:
    """``target := value``"""

    target: Tokens
    value: Tokens


@dataclass(frozen=True)
class Outputs:
    """``(a, b) := f(x)``"""

    targets: tuple[Tokens, ...]
    whole: Tokens
    value: Tokens


@dataclass(frozen=True)
class Called:
    """A call without outputs, such as that of ``assert``."""

    call: Tokens


@dataclass(frozen=True)
class Branches:
    """``if``; the last condition may be None, for else."""

    branches: tuple[tuple[Tokens | None, tuple[Statement, ...]], ...]


@dataclass(frozen=True)
class Whens:
    """``when`` with its ``elsewhen``, and all of its tokens."""

    branches: tuple[tuple[Tokens | None, tuple[Statement, ...]], ...]
    tokens: Tokens


@dataclass(frozen=True)
class Repeated:
    """``for``: its first iterator, and what is done."""

    variable: str
    range: Tokens
    body: tuple[Statement, ...]


Statement = Assigned | Outputs | Called | Branches | Whens | Repeated


def statements_of(tokens: Tokens, sign: str = ":=") -> tuple[Statement, ...]:
    """The statements that the tokens are, those with the sign as assignments; NotSaidOtherwiseError where one is of
    another kind, such as ``while``."""
    reader = _Reader(tokens, sign)
    found = reader.block(())
    if reader.word:
        raise NotSaidOtherwiseError
    return found


def assigned_in(statements: Sequence[Statement]) -> Iterator[str]:
    """The variables that the statements assign, without their last subscripts."""
    for statement in statements:
        if isinstance(statement, Assigned):
            yield _whole(statement.target)
        elif isinstance(statement, Outputs):
            yield from (_whole(target) for target in statement.targets if target)
        elif isinstance(statement, Repeated):
            yield from assigned_in(statement.body)
        elif isinstance(statement, Branches | Whens):
            for _, block in statement.branches:
                yield from assigned_in(block)


def _whole(target: Tokens) -> str:
    """A reference without its last subscripts."""
    if target[-1].text != "]":
        return written(target).replace(" ", "")
    start = next(k for k in range(len(target)) if target[k].text == "[" and closing(target, k) == len(target) - 1)
    return written(target[:start]).replace(" ", "")


class _Reader:
    def __init__(self, tokens: Tokens, sign: str) -> None:
        self._tokens, self._sign = tokens, sign
        self._at = 0

    @property
    def word(self) -> str:
        return self._tokens[self._at].text if self._at < len(self._tokens) else ""

    def _take(self, *words: str) -> None:
        for word in words:
            if self.word != word:
                raise NotSaidOtherwiseError
            self._at += 1

    def _until(self, *words: str) -> Tokens:
        """What stands before the first of these words outside of brackets, which is passed."""
        start = self._at
        while self.word and self.word not in words:
            self._at = closing(self._tokens, self._at) + 1 if self.word in "([{" else self._at + 1
        self._at += 1
        if self._at > len(self._tokens) or self._at - 1 == start:
            raise NotSaidOtherwiseError
        return self._tokens[start : self._at - 1]

    def block(self, ends: Sequence[str]) -> tuple[Statement, ...]:
        """The statements before one of these words."""
        found: list[Statement] = []
        while self.word and self.word not in ends:
            found += self._statement()
        return tuple(found)

    def _statement(self) -> Sequence[Statement]:
        word = self.word
        start = self._at
        if word == "if":
            return [Branches(self._branches(word))]
        if word == "when":
            return [Whens(self._branches(word), self._tokens[start : self._at])]
        if word == "for":
            return [self._loop()]
        if word in {"while", "break", "return"}:
            raise NotSaidOtherwiseError
        body = self._until(";")
        while body and body[-1].text.startswith('"'):  # what the statement is for
            body = body[:-1]
        start = closing(body, 0) + 1 if body[0].text == "(" else 0
        sign = next((k for k in range(start, len(body)) if body[k].text in {self._sign, "("}), None)
        if sign is not None and body[sign].text == "(":
            sign = None
        if sign is None:
            return [Called(body)]
        target, value = body[:sign], body[sign + 1 :]
        if target and target[0].text == "(":
            return [Outputs(tuple(arguments(target[1:-1])), target, value)]
        if not is_reference(target):
            raise NotSaidOtherwiseError
        return [Assigned(target, value)]

    def _branches(self, word: str) -> tuple[tuple[Tokens | None, tuple[Statement, ...]], ...]:
        found: list[tuple[Tokens | None, tuple[Statement, ...]]] = []
        self._take(word)
        while True:
            condition = self._until("then")
            found.append((condition, self.block((f"else{word}", "else", "end"))))
            if self.word != f"else{word}":
                break
            self._at += 1
        if self.word == "else":
            self._at += 1
            found.append((None, self.block(("end",))))
        self._take("end", word, ";")
        return tuple(found)

    def _loop(self) -> Repeated:
        self._take("for")
        iterators = arguments(self._until("loop"))
        body = self.block(("end",))
        self._take("end", "for", ";")
        for iterator in reversed(iterators):
            if len(iterator) < 3 or iterator[1].text != "in":
                raise NotSaidOtherwiseError
            body = (Repeated(iterator[0].text, iterator[2:], body),)
        (loop,) = body
        assert isinstance(loop, Repeated)
        return loop
