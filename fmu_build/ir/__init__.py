"""The values that pass between stages, and the algebra on them."""

__all__ = [
    "conditions",
    "dependencies",
    "equations",
    "events",
    "functions",
    "linear",
    "models",
    "substitution",
    "symbols",
    "units",
]
