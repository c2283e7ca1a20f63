"""Terminal and traces: how tables, files and progress are told."""

__all__ = ["terminal", "traces"]
