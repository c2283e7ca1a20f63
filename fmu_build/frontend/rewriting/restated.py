"""A Modelica text in the words that rumoca takes. No line of it moves, so places stay what they are."""

from __future__ import annotations

from .algorithms import as_equations, first_section
from .clocked_bindings import with_clocked_equations
from .function_words import with_equals_signs
from .lifted import with_parts_lifted
from .ranges import with_ranges
from .when_equations import with_whens_restated


def restated(text: str) -> str:
    """The text with sections as equations, simpler when-clauses, parts of expressions lifted, ranges written out."""
    sections = as_equations(with_ranges(with_equals_signs(text)))
    return with_clocked_equations(with_parts_lifted(with_whens_restated(sections)))


def algorithm_left(text: str) -> int | None:
    """Where the first algorithm section of a model begins that has no other words; None if there is none."""
    return first_section(as_equations(text))
