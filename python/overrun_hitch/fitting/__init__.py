"""A device's parameters from what was measured on it."""

__all__ = ["columns", "estimates", "figure", "fit", "table", "trace"]
