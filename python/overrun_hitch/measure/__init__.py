"""Traces to numbers."""

__all__ = ["envelope", "funnel", "judged", "metrics", "noise", "oscillation", "passages", "resampling", "sampled"]
