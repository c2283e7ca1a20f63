"""The paper"s figures, and what it could not show, drawn."""

__all__ = ["all"]
