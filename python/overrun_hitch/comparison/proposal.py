"""A mapping to start from, for another's FMU or trace, with what speaks for each line in comments."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from overrun_hitch.comparison.sources import is_trace
from overrun_hitch.fmu.description import variables
from overrun_hitch.foreign.candidates import Candidate, Proposal, proposals
from overrun_hitch.foreign.mapping import OURS
from overrun_hitch.foreign.trace_file import read_table
from overrun_hitch.parameters import Parameters
from overrun_hitch.show.words import printable


def proposal(path: Path) -> str:
    """The text of a TOML file. HitchError where the file is neither an FMU nor a trace."""
    candidates = list(_columns(path) if is_trace(path) else variables(path))
    lines = [
        f"# {printable(path.name)}: whom `hitch crosscheck --map` takes for whom. Guessed by names, units and",
        "# descriptions: check every line. A sign that differs from ours is for you to add: sign = -1.",
    ]
    for one in proposals(candidates):
        lines += ["", *_table(one)]
    return "\n".join(lines) + "\n"


def _columns(path: Path) -> Iterator[Candidate]:
    table = read_table(path)
    for name in table.names:
        yield Candidate(name, table.columns[name][1], "", "")


def _table(one: Proposal) -> Iterator[str]:
    yield f"# {one.description}, {OURS[one.ours]}"
    if not one.candidates:
        neutral = f"; without it counts as {Parameters.model_fields[one.ours].default:g}" if _is_parameter(one) else ""
        yield f"# [{one.ours}]  # nothing there looks like it{neutral}"
        return
    best, *others = one.candidates
    yield f"[{one.ours}]"
    yield f"theirs = {_text(best.name)}"
    yield f"# by its own word in {_text(best.unit)}" if best.unit else f'# no unit is given: unit = "{OURS[one.ours]}"?'
    for other in others:
        yield f"# or: theirs = {_text(other.name)}"


def _is_parameter(one: Proposal) -> bool:
    return one.ours in Parameters.model_fields


def _text(words: str) -> str:
    """A basic string of TOML."""
    return '"' + "".join(c if c.isprintable() and c not in '"\\' else f"\\U{ord(c):08x}" for c in words) + '"'
