"""Functions as textbooks write them, in words that rumoca takes.

An output that is assigned in some branches only (a table's value, in the one interval that has x) has no value where
none of them is taken: NaN, which ends a run with the name of the variable that needs it.
"""

from __future__ import annotations

from .tokens import Token, arguments, classes_of, closing, tokens_of

_UNDEFINED = "0/0"
_SECTIONS = frozenset(("algorithm", "equation", "external"))


def with_undefined_outputs(text: str) -> str:
    """The text with NaN as the first value of each output of a function that is a Real number without a value."""
    inserted: dict[int, str] = {}
    for body in classes_of(tokens_of(text)):
        algorithm = next((token for token in body.tokens if token.text == "algorithm"), None)
        if body.kind == "function" and algorithm is not None:
            inserted[algorithm.end] = "".join(f" {name} := {_UNDEFINED};" for name in _outputs(body.tokens))
    for place in sorted(inserted, reverse=True):
        text = text[:place] + inserted[place] + text[place:]
    return text


def with_equals_signs(text: str) -> str:
    """The text with ``=`` in declarations of functions that have ``:=``, as Modelica 1 had it and 3 still allows."""
    signs = [
        token.start
        for body in classes_of(tokens_of(text))
        if body.kind == "function"
        for token in _assigned(body.tokens)
    ]
    for place in signs:
        text = f"{text[:place]} ={text[place + 2 :]}"
    return text


def _outputs(tokens: list[Token]) -> list[str]:
    """Names of scalar outputs of type Real without a value."""
    names = []
    for i, token in enumerate(tokens[:-1]):
        if token.text == "output" and tokens[i + 1].text == "Real" and tokens[i + 2].text != "[":
            end = next(k for k in range(i, len(tokens)) if tokens[k].text == ";")
            for declared in arguments(tokens[i + 2 : end]):
                behind = closing(declared, 1) + 1 if len(declared) > 1 and declared[1].text == "(" else 1
                if not behind < len(declared) or declared[behind].text.startswith('"'):
                    names.append(declared[0].text)
    return names


def _assigned(tokens: list[Token]) -> list[Token]:
    """The signs ``:=`` before the first section."""
    section = next((i for i, token in enumerate(tokens) if token.text in _SECTIONS), len(tokens))
    return [token for token in tokens[:section] if token.text == ":="]
