"""Ranges of iterators that are left to be told by what they are subscripts of, written out: rumoca wants them written.

``for i loop x[i] = i; end for`` says ``for i in 1:size(x, 1) loop`` (Modelica 3.6, section 11.2.2.1), and so in
``sum(x[i] for i)``. No line moves.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from ..syntax import CLOSING, OPENING, TOKEN

Tokens = Sequence[tuple[str, int]]  # with the place of their ends, in bytes


def with_ranges(text: str) -> str:
    """The Modelica text with these ranges. An iterator that is no subscript by itself stays as it is."""
    data = text.encode()
    found = [match for match in TOKEN.finditer(data) if match.lastgroup != "skip"]
    tokens = [(match.group().decode(), match.end()) for match in found]
    for end, bounds in sorted(_missing(tokens), reverse=True):
        data = data[:end] + f" in {bounds}".encode() + data[end:]
    return data.decode()


def _missing(tokens: Tokens) -> Iterator[tuple[int, str]]:
    """Behind which place which range is to be put."""
    for at, (word, _) in enumerate(tokens):
        if word == "for" and tokens[at - 1][0] != "end":
            names, end = _iterators(tokens, at + 1)
            is_loop = end < len(tokens) and tokens[end][0] == "loop"
            body = tokens[end : _end_of_loop(tokens, end)] if is_loop else tokens[_opening(tokens, at) : at]
            for name, place in names:
                if (bounds := _bounds(name, body)) is not None:
                    yield place, bounds


def _iterators(tokens: Tokens, at: int) -> tuple[list[tuple[str, int]], int]:
    """The iterators without a range, with the places of their ends, and where the list of all ends."""
    names = []
    while at + 1 < len(tokens):
        if tokens[at + 1][0] != "in":
            names.append(tokens[at])
        depth = 0
        while at < len(tokens) and (depth > 0 or tokens[at][0] not in {",", "loop", *CLOSING}):
            depth += (tokens[at][0] in OPENING) - (tokens[at][0] in CLOSING)
            at += 1
        if at == len(tokens) or tokens[at][0] != ",":
            break
        at += 1
    return names, at


def _end_of_loop(tokens: Tokens, at: int) -> int:
    depth = 1
    while depth > 0 and at < len(tokens):
        at += 1
        if at < len(tokens) and tokens[at][0] == "loop":
            depth += 1
        elif [word for word, _ in tokens[at : at + 2]] in (["end", "for"], ["end", "while"]):
            depth -= 1
    return at


def _opening(tokens: Tokens, at: int) -> int:
    """Where the bracket opens that a comprehension stands in."""
    depth = 1
    while depth > 0 and at > 0:
        at -= 1
        depth += (tokens[at][0] in CLOSING) - (tokens[at][0] in OPENING)
    return at


def _bounds(name: str, body: Tokens) -> str | None:
    """The range that the first subscript gives which is the iterator alone; None without one."""
    words = [word for word, _ in body]
    for at, word in enumerate(words):
        if word == name and words[at - 1] in {"[", ","} and words[at + 1 : at + 2] in (["]"], [","]):
            opening = _opening(body, at)
            if variable := _variable(words[:opening]):
                return f"1:size({variable}, {_commas(words[opening + 1 : at]) + 1})"
    return None


def _variable(words: Sequence[str]) -> str:
    """The variable that the words end with; "" if it is part of an element of an array."""
    first = len(words) - 1
    while first > 1 and words[first - 1] == "." and words[first - 2] != "]":
        first -= 2
    is_name = first >= 0 and re.match(r"[A-Za-z_']", words[first]) and words[first - 1] != "."
    return "".join(words[first:]) if is_name else ""


def _commas(words: Sequence[str]) -> int:
    """How many commas are in no bracket."""
    depth = count = 0
    for word in words:
        depth += (word in OPENING) - (word in CLOSING)
        count += word == "," and depth == 0
    return count
