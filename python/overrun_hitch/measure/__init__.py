"""Traces to numbers."""

__all__ = ["envelope", "funnel", "judged", "metrics", "oscillation", "passages"]
