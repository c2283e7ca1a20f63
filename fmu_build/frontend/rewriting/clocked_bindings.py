"""Declarations that are equations with a clock, as equations: in ``Real s = sample(u, c)`` rumoca misses the clock."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from .tokens import Token, arguments, classes_of, closing, declared_clocks, tokens_of, written

_CLOCKED = frozenset(("previous", "subSample", "superSample", "shiftSample", "backSample", "interval", "firstTick"))
_SECTIONS = frozenset(("equation", "algorithm", "initial"))


def with_clocked_equations(text: str) -> str:
    """The Modelica text with those declarations as equations, before the first section of their class."""
    changes: list[tuple[int, int, str]] = []
    for owner in classes_of(tokens_of(text)):
        tokens = owner.tokens
        first = next((k for k, token in enumerate(tokens) if token.text in _SECTIONS), len(tokens))
        found = list(_bindings(tokens[:first], declared_clocks(tokens)))
        changes += [(sign.start, value[-1].end, "") for _, sign, value in found]
        if found:
            place = tokens[first].start if first < len(tokens) else tokens[-1].end
            equations = " ".join(f"{name} = {written(value)};" for name, _, value in found)
            changes.append((place, place, f" equation {equations} "))
    for start, end, replacement in sorted(changes, reverse=True):
        text = text[:start] + replacement + text[end:]
    return text


def _bindings(tokens: Sequence[Token], clocks: set[str]) -> Iterator[tuple[str, Token, Sequence[Token]]]:
    """Name, sign and value of what is declared to be equal to an expression with a clock."""
    start = 0
    for end, token in enumerate(tokens):
        if token.text != ";":
            continue
        statement, start = tokens[start:end], end + 1
        for part in arguments(statement) if not any(t.text == "Clock" for t in statement) else []:
            sign = _sign(part)
            value = [t for t in part[sign + 1 :] if not t.text.startswith('"')]
            if sign > 0 and value and _has_clock(value, clocks):
                yield _name(part[:sign]), part[sign], value


def _sign(tokens: Sequence[Token]) -> int:
    """Where the ``=`` is that no bracket is around; -1 if there is none."""
    k = 0
    while k < len(tokens):
        if tokens[k].text == "=":
            return k
        k = closing(tokens, k) + 1 if tokens[k].text in "([{" else k + 1
    return -1


def _name(tokens: Sequence[Token]) -> str:
    """The last name before modifiers and subscripts."""
    depth, name = 0, ""
    for token in tokens:
        depth += (token.text in "([{") - (token.text in ")]}")
        name = token.text if depth == 0 and token.is_name else name
    return name


def _has_clock(tokens: Sequence[Token], clocks: set[str]) -> bool:
    for k, token in enumerate(tokens[:-1]):
        if tokens[k + 1].text == "(" and token.text in _CLOCKED:
            return True
        if tokens[k + 1].text == "(" and token.text == "sample":
            inside = arguments(tokens[k + 2 : closing(tokens, k + 1)])
            if len(inside) == 2 and written(inside[1]) in clocks:
                return True
    return False
