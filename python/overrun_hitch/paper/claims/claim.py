"""What a claim of the paper is made of, and how its verdict comes about: computed, never typed in."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Criterion:
    """What a value must satisfy, in words and as a test."""

    words: str
    is_met: Callable[[float], bool]


def rounds_to(printed: float, digits: int) -> Criterion:
    """The value that the paper prints, with as many decimals as it prints."""
    return Criterion(f"rounds to {printed:.{digits}f}", lambda value: abs(value - printed) <= 0.5 * 10.0**-digits)


def near(expected: float, allowed: float) -> Criterion:
    """`expected`, give or take `allowed`."""
    return Criterion(f"{expected:g} ± {allowed:.2g}", lambda value: abs(value - expected) <= allowed)


def above(limit: float) -> Criterion:
    """Greater than `limit`."""
    return Criterion(f"greater than {limit:.3g}", lambda value: value > limit)


def below(limit: float) -> Criterion:
    """Less than `limit`."""
    return Criterion(f"less than {limit:.3g}", lambda value: value < limit)


@dataclass(frozen=True)
class Part:
    """One number of a claim from both sides; NaN where a side has nothing to say."""

    what: str
    unit: str
    printed: str  # what the paper prints or says
    criterion: Criterion
    theory: float
    fmu: float

    def holds(self, side: str) -> bool | None:
        """Whether the number of `side` ("theory" or "fmu") meets the criterion; None where there is none."""
        value = getattr(self, side)
        return None if math.isnan(value) else self.criterion.is_met(value)


@dataclass(frozen=True)
class Claim:
    """A claim of the paper with the numbers that it stands or falls by."""

    number: int
    text: str
    where: str  # in the paper
    parts: tuple[Part, ...]
    remark: str = ""

    def holds(self, side: str) -> bool | None:
        """Whether every part holds on `side`; None where the side says nothing."""
        said = [part.holds(side) for part in self.parts if part.holds(side) is not None]
        return all(said) if said else None

    @property
    def verdict(self) -> str:
        """ "holds", or on which side it does not."""
        sides = {"theory": self.holds("theory"), "fmu": self.holds("fmu")}
        failing = {"theory": "in theory", "fmu": "on the FMU"}
        wrong = [failing[side] for side, holds in sides.items() if holds is False]
        return f"does not hold {' and '.join(wrong)}" if wrong else "holds"
