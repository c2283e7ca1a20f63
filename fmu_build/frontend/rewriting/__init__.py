"""Modelica that rumoca refuses, in other words that it takes; text to text."""

__all__ = ["function_words", "restated"]
