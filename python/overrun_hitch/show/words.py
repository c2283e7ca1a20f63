"""Other people's words, fit to be shown."""

from __future__ import annotations


def printable(text: str) -> str:
    """The text with a question mark for each character that would do something to a terminal or is none in XML."""
    return "".join(c if c.isprintable() else "?" for c in text)
