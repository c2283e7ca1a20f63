"""Modelica text to a FlatModel; the only place that knows rumoca."""

__all__ = ["flatten", "loading", "simulate"]
