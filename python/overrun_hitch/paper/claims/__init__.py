"""What the paper claims, each with a verdict from theory and one from the FMU."""

__all__ = ["all", "claim", "table"]
