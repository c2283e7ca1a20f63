"""Prints C; what is computed when has been decided before."""

__all__ = ["elimination", "model"]
