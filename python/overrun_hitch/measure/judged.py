"""A quantity from two sides, what may differ, and the verdict."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Judged:
    """One quantity as expected (by theory, by the reference) and as found; NaN where a side has none."""

    quantity: str
    unit: str
    expected: float
    found: float
    allowed: float  # of the difference
    not_judged: str = ""  # the reason, if there is one

    @property
    def difference(self) -> float:
        """Found less expected."""
        return self.found - self.expected

    @property
    def differs(self) -> bool:
        """True where the two were judged and are too far apart."""
        return not self.not_judged and not abs(self.difference) <= self.allowed

    @property
    def verdict(self) -> str:
        """ "agrees", "differs" or "not judged"."""
        return "not judged" if self.not_judged else "differs" if self.differs else "agrees"
