"""What an FMU says of itself, and what was made of it: for those who judge it, without fmpy."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Identity:
    """What an FMU is, for those who judge it."""

    guid: str
    interface: str  # "FMI 2.0, Co-Simulation"
    tool: str  # that made it; "" where it does not say
    missing: tuple[str, ...] = ()  # of results.VARIABLES
    notes: tuple[str, ...] = ()  # what had to be guessed, a sentence each
