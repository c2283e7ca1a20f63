"""The paper, recomputed."""

__all__ = ["claims", "figures", "report", "study"]
