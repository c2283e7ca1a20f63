"""Car and trailer as two FMUs: the pair, what coupling costs, and its SSP package."""

__all__ = ["figure", "pair", "study", "table"]
