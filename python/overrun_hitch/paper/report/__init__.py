"""All of it on one page."""

__all__ = ["page"]
