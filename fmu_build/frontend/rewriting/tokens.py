"""Words and signs of Modelica text, for what is said in other words before rumoca reads it; places are characters."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

_TOKEN = re.compile(
    r"""(?P<skipped>\s+|//[^\n]*|/\*.*?\*/)|(?P<text>"(?:\\.|[^"\\])*")|(?P<name>[A-Za-z_]\w*|'(?:\\.|[^'\\])*')"""
    r"""|(?P<number>(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][-+]?\d+)?)|(?P<sign>:=|==|<=|>=|<>|\.[-+*/^]|.)""",
    re.DOTALL,
)
_CLASSES = frozenset(("model", "block", "class", "function", "record", "connector", "package", "type", "operator"))
_STATEMENTS = frozenset(("if", "for", "while", "when"))
_SECTIONS = frozenset(("algorithm", "equation", "initial", "public", "protected", "annotation", "external", "end"))
_OPENING, _CLOSING = "([{", ")]}"


@dataclass(frozen=True)
class Token:
    """A word, a number, a sign or a text in quotes, and where it begins."""

    text: str
    start: int

    @property
    def end(self) -> int:
        """Where the next character is."""
        return self.start + len(self.text)

    @property
    def is_name(self) -> bool:
        """Whether it is an identifier or a keyword."""
        return re.match(r"[A-Za-z_']", self.text) is not None


@dataclass(frozen=True)
class ClassBody:
    """A class: its kind, its name, and the tokens behind its description that are not those of a class in it."""

    kind: str
    name: str
    tokens: list[Token]

    @property
    def start(self) -> int:
        """Where its declarations begin."""
        return next(token.start for token in self.tokens if not token.text.startswith('"'))


def tokens_of(text: str) -> list[Token]:
    """All but spaces and comments."""
    return [Token(m.group(), m.start()) for m in _TOKEN.finditer(text) if m.lastgroup != "skipped"]


def written(tokens: Iterable[Token | str]) -> str:
    """Tokens as text on one line."""
    return " ".join(token if isinstance(token, str) else token.text for token in tokens)


def classes_of(tokens: Sequence[Token]) -> Iterator[ClassBody]:
    """The classes, those inside others first; short ones belong to the class around them."""
    open_classes: list[ClassBody] = []
    for i, token in enumerate(tokens):
        before, after, last = (tokens[k].text if 0 <= k < len(tokens) else "" for k in (i - 1, i + 1, i + 2))
        if token.text in _CLASSES and before != "end" and re.match(r"[\w']", after) and last not in {"=", "("}:
            if after not in _CLASSES:
                open_classes.append(ClassBody(token.text, last if after == "extends" else after, []))
        elif token.text == "end" and after not in _STATEMENTS and open_classes:
            yield open_classes.pop()
        elif open_classes and (before not in _CLASSES or open_classes[-1].tokens):
            open_classes[-1].tokens.append(token)


def sections_of(body: ClassBody, *, initial: bool = False) -> Iterator[tuple[Token, list[Token]]]:
    """The word ``algorithm`` or ``equation`` of each section of a class, and what stands in it: of initial ones, or of
    the others."""
    tokens = body.tokens
    for i, token in enumerate(tokens):
        if token.text in {"algorithm", "equation"} and (i > 0 and tokens[i - 1].text == "initial") == initial:
            last = i + 1
            while last < len(tokens) and (
                tokens[last].text not in _SECTIONS
                or (tokens[last].text == "end" and tokens[last + 1].text in _STATEMENTS)
            ):
                last += 1
            yield token, tokens[i + 1 : last]


def discrete_types(body: ClassBody) -> dict[str, str]:
    """What a class declares to be Integer, Boolean or discrete Real, with its type."""
    found: dict[str, str] = {}
    declaration: list[Token] = []
    for token in body.tokens:
        if token.text in {"equation", "algorithm"}:
            break
        declaration.append(token)
        if token.text == ";":
            words = [t.text for t in declaration]
            kind = next((word for word in words if word in {"Integer", "Boolean", "Real"}), "")
            if kind and (kind != "Real" or "discrete" in words):
                names = declared_names(declaration[words.index(kind) + 1 : -1])
                found.update(dict.fromkeys(names, kind))
            declaration = []
    return found


def declared_names(tokens: Sequence[Token]) -> list[str]:
    """The names in a declaration, from behind its type."""
    if tokens and tokens[0].text == "[":
        tokens = tokens[closing(tokens, 0) + 1 :]
    return [names[0].text for names in arguments(tokens) if names]


def declared_clocks(tokens: Sequence[Token]) -> set[str]:
    """The variables of type Clock that a class declares."""
    found: set[str] = set()
    for i, token in enumerate(tokens[:-1]):
        if token.text == "Clock" and tokens[i + 1].is_name:
            last = next((k for k in range(i, len(tokens)) if tokens[k].text == ";"), len(tokens))
            found |= set(declared_names(tokens[i + 1 : last]))
    return found


def closing(tokens: Sequence[Token], i: int) -> int:
    """Where the bracket closes that opens at ``i``."""
    depth = 0
    for k in range(i, len(tokens)):
        depth += (tokens[k].text in _OPENING) - (tokens[k].text in _CLOSING)
        if depth == 0:
            return k
    return len(tokens) - 1


def arguments(tokens: Sequence[Token]) -> list[list[Token]]:
    """What stands between brackets, split at its commas."""
    found: list[list[Token]] = [[]]
    depth = 0
    for token in tokens:
        depth += (token.text in _OPENING) - (token.text in _CLOSING)
        if token.text == "," and depth == 0:
            found.append([])
        else:
            found[-1].append(token)
    return found


def is_reference(tokens: Sequence[Token]) -> bool:
    """Whether it is a component: names with dots between, and subscripts."""
    k = 0
    while k < len(tokens):
        if not tokens[k].is_name:
            return False
        k += 1
        if k < len(tokens) and tokens[k].text == "[":
            k = closing(tokens, k) + 1
        if k < len(tokens) and (tokens[k].text != "." or k + 1 == len(tokens)):
            return False
        k += 1
    return bool(tokens)


def placed(pieces: Iterable[tuple[int, str]], first: int, last: int) -> str:
    """Texts, each on its line, from one line to another."""
    text, line = "", first
    for at, piece in sorted(pieces, key=lambda pair: pair[0]):
        text += "\n" * (at - line) + f" {piece}"
        line = max(line, at) + piece.count("\n")
    return text + "\n" * (last - line)
