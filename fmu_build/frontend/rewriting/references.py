"""The components that an expression names, as text."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from .tokens import Token, closing, written

_WORDS = frozenset(("if", "then", "elseif", "else", "and", "or", "not", "for", "in", "true", "false", "end", "time"))


def base_of(reference: str) -> str:
    """A reference without its last subscripts."""
    depth = 0
    for k in range(len(reference) - 1, -1, -1) if reference.endswith("]") else ():
        depth += (reference[k] == "]") - (reference[k] == "[")
        if depth == 0:
            return reference[:k].rstrip()
    return reference


def replaced(tokens: Sequence[Token], value: Callable[[str, str], str]) -> str:
    """The expression with ``value(reference, function)`` in place of each reference, ``function`` being the one whose
    only argument it is, or ""."""
    found: list[str] = []
    i = 0
    while i < len(tokens):
        end = _reference_end(tokens, i)
        if end is None:
            found.append(tokens[i].text)
            i += 1
            continue
        alone = i > 1 and tokens[i - 1].text == "(" and tokens[end : end + 1] and tokens[end].text == ")"
        found.append(value(_canonical(tokens[i:end], value), tokens[i - 2].text if alone else ""))
        i = end
    return " ".join(found)


def _reference_end(tokens: Sequence[Token], i: int) -> int | None:
    """Where the reference ends that begins at ``i``; None if there is none."""
    text = tokens[i].text
    if not tokens[i].is_name or text in _WORDS or (i > 0 and tokens[i - 1].text == "."):
        return None
    end = i + 1
    while end < len(tokens) and tokens[end].text in {".", "["}:
        end = end + 2 if tokens[end].text == "." else closing(tokens, end) + 1
    is_argument_name = tokens[end : end + 1] and tokens[end].text in {"=", "("}
    return None if is_argument_name else end


def _canonical(tokens: Sequence[Token], value: Callable[[str, str], str]) -> str:
    """The reference with its subscripts evaluated as far as they are numbers."""
    text, i = "", 0
    while i < len(tokens):
        if tokens[i].text == "[":
            end = closing(tokens, i)
            text += f"[{_number(replaced(tokens[i + 1 : end], value))}]"
            i = end + 1
        else:
            text += tokens[i].text
            i += 1
    return text


def _number(text: str) -> str:
    """Sums of whole numbers as one; what else there is as it stands."""
    parts = re.fullmatch(r"\s*(\d+)((?:\s*[-+]\s*\d+)*)\s*", text)
    if not parts:
        return text
    return str(int(parts[1]) + sum(int(part.replace(" ", "")) for part in re.findall(r"[-+]\s*\d+", parts[2])))


def canonical(tokens: Sequence[Token], value: Callable[[str, str], str]) -> str:
    """A reference that is assigned, in the form that ``replaced`` gives those that are read."""
    return _canonical(tokens, value) if tokens else written(tokens)
