"""A FlatModel to a SortedModel, its exact derivatives and the order of its elimination."""

__all__ = ["derive", "elimination", "initialize", "jacobian", "lower", "sort"]
