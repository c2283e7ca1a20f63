"""Expressions that rumoca takes in a variable alone, with a variable of their own: ``der(a - b)``, ``hold(2*s)``.

``c*der(x - y)`` becomes ``c*der('M: x - y')``, with ``protected Real 'M: x - y' = x - y;`` where the class M begins: on
the same line, so that places stay what they are. In loops nothing is: a variable cannot depend on theirs.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from .tokens import ClassBody, Token, arguments, classes_of, closing, declared_clocks, is_reference, tokens_of, written
from .when_words import name_of

_RELATIONS = frozenset(("<", ">", "<=", ">=", "==", "<>"))
NO_STATE = "(stateSelect = StateSelect.never)"


@dataclass(frozen=True)
class _Part:
    """An expression of a type."""

    kind: str
    tokens: Sequence[Token]
    modifier: str = ""

    @property
    def span(self) -> tuple[int, int]:
        return self.tokens[0].start, self.tokens[-1].end


def with_parts_lifted(text: str) -> str:
    """The Modelica text with those expressions as variables."""
    while changes := list(_changes(text)):
        for start, end, replacement in sorted(changes, reverse=True):
            text = text[:start] + replacement + text[end:]
    return text


def _changes(text: str) -> Iterator[tuple[int, int, str]]:
    """Places and what to put there: the innermost expressions of each class."""
    for owner in classes_of(tokens_of(text)):
        if owner.kind not in {"model", "block", "class"} or not owner.tokens:
            continue
        parts = {part.span: part for part in _parts(owner)}
        inner = [part for span, part in parts.items() if not any(_is_in(other, span) for other in parts)]
        declared = {name_of(written(p.tokens), owner): p for p in inner}
        for part in inner:
            yield *part.span, name_of(written(part.tokens), owner)
        if declared:
            lines = "".join(f" {p.kind} {name}{p.modifier} = {written(p.tokens)};" for name, p in declared.items())
            yield owner.start, owner.start, f"protected{lines} public "


def _is_in(inner: tuple[int, int], outer: tuple[int, int]) -> bool:
    return inner != outer and outer[0] <= inner[0] and inner[1] <= outer[1]


def _parts(owner: ClassBody) -> Iterator[_Part]:
    tokens = owner.tokens
    clocks = declared_clocks(tokens)
    depth = 0  # of loops
    for i, token in enumerate(tokens):
        before = tokens[i - 1].text if i else ""
        depth += (token.text == "for" and before != "end") - (token.text == "for" and before == "end")
        if not (i + 1 < len(tokens) and tokens[i + 1].text == "(") or before == "." or _is_in_loop(tokens, i, depth):
            continue
        last = closing(tokens, i + 1)
        call, inside = tokens[i : last + 1], arguments(tokens[i + 2 : last])
        is_whole = before == "=" and tokens[last + 1 : last + 2] and tokens[last + 1].text in {";", ","}
        if token.text in {"der", "hold"} and len(inside) == 1 and inside[0] and not is_reference(inside[0]):
            yield _Part("Real", inside[0], NO_STATE if token.text == "der" else "")
        elif token.text == "Clock" and len(inside) == 1 and _RELATIONS & {t.text for t in inside[0]}:
            yield _Part("Boolean", inside[0])
        elif token.text == "Clock" and before != "=":
            yield _Part("Clock", call)
        elif token.text == "sample" and len(inside) == 2 and written(inside[1]) in clocks and not is_whole:
            yield _Part("Real", call)


def _is_in_loop(tokens: Sequence[Token], i: int, depth: int) -> bool:
    """Whether there is a loop around, or in the same statement, as in ``{der(x[i] - y) for i in 1:3}``."""
    first = next((k for k in range(i, -1, -1) if tokens[k].text == ";"), 0)
    last = next((k for k in range(i, len(tokens)) if tokens[k].text == ";"), len(tokens))
    return (depth > 0 and not any(t.text == "for" for t in tokens[first:last])) or any(
        t.text == "for" and tokens[k - 1].text != "end" for k, t in enumerate(tokens[first:last], start=first)
    )
