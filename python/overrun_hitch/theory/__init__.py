"""The independent check, from the paper's equations alone, never the FMU."""

__all__ = ["boundary", "describing_function", "dry_friction", "envelope", "linear", "steady", "working_point"]
