"""The independent check, from the paper's equations alone, never the FMU."""

__all__ = ["boundary", "describing_function", "envelope", "linear", "steady", "working_point"]
