"""Car and trailer as several FMUs: the pair, the hitch between two bodies, what coupling costs, and its SSP package."""

__all__ = ["figure", "pair", "study", "table", "trio"]
