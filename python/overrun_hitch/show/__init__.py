"""Terminal and traces: how tables, files and progress are told."""

__all__ = ["files", "table", "terminal", "traces", "words"]
