"""Linear stability for the user"s numbers."""

__all__ = ["figure", "locus", "study", "table"]
