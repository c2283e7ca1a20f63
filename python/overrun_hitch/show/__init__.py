"""Terminal and traces: how tables, files and progress are told."""

__all__ = ["files", "page_server", "table", "terminal", "traces", "words"]
