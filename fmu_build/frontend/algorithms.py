"""Algorithm sections that are equations in all but name, written so: rumoca refuses sections with several outputs.

``s := time; p := 2*s;`` says the same as ``s = time; p = 2*s;`` if every variable is assigned once, whatever happens,
and read only after that. The text keeps its length, so that all places in it stay what they are.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

_TOKEN = re.compile(
    r"""(?P<skipped>\s+|//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\])*")|(?P<name>[A-Za-z_]\w*|'(?:\\.|[^'\\])*')"""
    r"""|(?P<number>\d+(?:\.\d*)?(?:[eE][-+]?\d+)?)|(?P<sign>:=|.)""",
    re.DOTALL,
)
_CLASSES = frozenset(("model", "block", "class", "function", "record", "connector", "package", "type", "operator"))
_STATEMENTS = frozenset(("if", "for", "while", "when"))
_SECTIONS = frozenset(("algorithm", "equation", "initial", "public", "protected", "annotation", "external", "end"))


@dataclass(frozen=True)
class _Token:
    text: str
    start: int


class _NoEquationsError(Exception):
    """The statements say something that equations do not."""


def as_equations(text: str) -> str:
    """The Modelica text with those algorithm sections of models and blocks as equations that say the same so."""
    characters = list(text)
    for section, tokens in _sections(_tokens(text)):
        body = _Body(tokens)
        try:
            body.statements(set())
        except _NoEquationsError:
            continue
        characters[section.start : section.start + len("algorithm")] = "equation "
        for sign in (token for token in tokens if token.text == ":="):
            characters[sign.start : sign.start + 2] = " ="
    return "".join(characters)


def first_section(text: str) -> int | None:
    """Where the first algorithm section begins that is in no function."""
    return next((section.start for section, _ in _sections(_tokens(text))), None)


def _tokens(text: str) -> list[_Token]:
    return [_Token(m.group(), m.start()) for m in _TOKEN.finditer(text) if m.lastgroup != "skipped"]


def _sections(tokens: Sequence[_Token]) -> Iterator[tuple[_Token, Sequence[_Token]]]:
    """The word ``algorithm`` of each section that is in no function, and what stands in it."""
    classes: list[str] = []
    for i, token in enumerate(tokens):
        before, after, last = (tokens[k].text if 0 <= k < len(tokens) else "" for k in (i - 1, i + 1, i + 2))
        if token.text in _CLASSES and before != "end" and re.match(r"[\w']", after) and last not in {"=", "("}:
            classes += [] if after in _CLASSES else [token.text]
        elif token.text == "end" and after not in _STATEMENTS and classes:
            classes.pop()
        elif token.text == "algorithm" and before != "initial" and classes and classes[-1] != "function":
            yield token, tokens[i + 1 : _end(tokens, i + 1)]


def _end(tokens: Sequence[_Token], i: int) -> int:
    """Where the section ends that begins at ``i``."""
    while i < len(tokens) and (
        tokens[i].text not in _SECTIONS or (tokens[i].text == "end" and tokens[i + 1].text in _STATEMENTS)
    ):
        i += 1
    return i


class _Body:
    """The statements of a section, read one after another."""

    def __init__(self, tokens: Sequence[_Token]) -> None:
        self._texts = [token.text for token in tokens]
        self._at = 0
        self._targets = {name for name, sign in zip(self._texts, self._texts[1:], strict=False) if sign == ":="}

    def statements(self, known: set[str]) -> set[str]:
        """What the statements up to the end of the section, or of a branch, assign; they may read ``known`` targets."""
        assigned: set[str] = set()
        while self._at < len(self._texts) and self._texts[self._at] not in {"elseif", "else", "end"}:
            names = (self._choice if self._texts[self._at] == "if" else self._assignment)(known | assigned)
            if names & assigned:
                raise _NoEquationsError
            assigned |= names
        return assigned

    def _assignment(self, known: set[str]) -> set[str]:
        target = self._texts[self._at]
        self._at += 1
        self._expect(":=")
        self._expression(";", known)
        return {target}

    def _choice(self, known: set[str]) -> set[str]:
        """One branch follows in any case, and all assign the same."""
        branches = []
        word = ""
        while word != "else":
            word = self._texts[self._at]
            self._at += 1
            if word in {"if", "elseif"}:
                self._expression("then", known)
            elif word != "else":
                raise _NoEquationsError
            branches.append(self.statements(known))
        for word in ("end", "if", ";"):
            self._expect(word)
        if any(names != branches[0] for names in branches):
            raise _NoEquationsError
        return branches[0]

    def _expression(self, end: str, known: set[str]) -> None:
        """Go behind the word at which an expression ends."""
        try:
            last = self._texts.index(end, self._at)
        except ValueError:
            raise _NoEquationsError from None
        read = {
            text
            for text, before in zip(self._texts[self._at : last], self._texts[self._at - 1 :], strict=False)
            if before != "."
        }
        if read & self._targets - known:
            raise _NoEquationsError
        self._at = last + 1

    def _expect(self, word: str) -> None:
        if self._at >= len(self._texts) or self._texts[self._at] != word:
            raise _NoEquationsError
        self._at += 1
