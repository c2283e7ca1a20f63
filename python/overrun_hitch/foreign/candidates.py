"""Which of other people's variables may be ours, by their names, units and descriptions."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from overrun_hitch.foreign.mapping import GRADE, OURS
from overrun_hitch.foreign.units import factor
from overrun_hitch.parameters import HitchError, Parameters, Scenario
from overrun_hitch.results import VARIABLES

LIKELY = 0.5  # of 1: below, a proposal would be a guess
WORDS = {  # what others call the things that our names and descriptions are made of
    "v": "speed velocity vel", "a": "acceleration acc accel", "F": "force", "car": "vehicle tractor truck towing",
    "trailer": "caravan towed", "hitch": "drawbar coupling towball ball", "compression": "travel displacement stroke",
    "slip": "kappa", "torque": "moment", "brake": "braking",
}  # fmt: skip


@dataclass(frozen=True)
class Candidate:
    """A variable elsewhere."""

    name: str
    unit: str | None
    description: str
    kind: str  # "input", "parameter", "output", or "" for a column of a file, which may be "time" and outputs


@dataclass(frozen=True)
class Proposal:
    """One of our variables and who may be it elsewhere, the likeliest first."""

    ours: str
    description: str
    candidates: tuple[Candidate, ...]


def proposals(candidates: Iterable[Candidate]) -> Iterator[Proposal]:
    """For all of our variables of the candidates' kinds; without candidates where none is likely."""
    there = list(candidates)
    columns = any(not one.kind for one in there)
    inputs = [("brake_torque", "input", Scenario.description("brake_torque")), ("grade", "input", GRADE)]
    wanted = [("time", "", "time")] if columns else inputs
    wanted += [(name, "" if columns else "output", text) for name, (_, text) in VARIABLES.items()]
    if not columns:
        wanted += [(name, "parameter", Parameters.description(name)) for name in Parameters.model_fields]
    for ours, kind, text in wanted:
        ranked = sorted(
            ((_likeness(ours, text, one), -place) for place, one in enumerate(there) if one.kind == kind), reverse=True
        )
        likely = [there[-place] for likeness, place in ranked if likeness >= LIKELY]
        yield Proposal(ours, text, tuple(likely[:3]))


def _likeness(ours: str, text: str, theirs: Candidate) -> float:
    """From 0 to 1; 0 where the unit does not fit."""
    if theirs.unit:
        try:
            factor(ours, theirs.unit, OURS[ours])
        except HitchError:
            return 0.0
    plain, other = (re.sub(r"[\W_]", "", name).casefold() for name in (ours, theirs.name.rpartition(".")[2]))
    if ours == theirs.name or plain == other:
        return 1.0
    spelling = difflib.SequenceMatcher(None, plain, re.sub(r"[\W_]", "", theirs.name).casefold()).ratio()
    wanted, found = _words(f"{ours} {text}"), _words(f"{theirs.name} {theirs.description}")
    named = _words(ours)
    shared = len(named & found) / max(len(named), 1)
    meant = len(wanted & found) / max(len(wanted), 1)
    return min(0.99, 0.3 * spelling + 0.5 * shared + 0.2 * meant + (0.1 if theirs.unit else 0.0))


def _words(text: str) -> set[str]:
    """Of names in any spelling, each as the word that we use."""
    parts = re.findall(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+", text)
    ours = {other: word.casefold() for word, others in WORDS.items() for other in (word.casefold(), *others.split())}
    return {ours.get(part.casefold(), part.casefold()) for part in parts if len(part) > 2 or part.casefold() in ours}
