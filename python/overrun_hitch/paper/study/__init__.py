"""What figures, claims and page are made from, computed once."""

__all__ = ["beyond", "curves", "device", "jacobian", "study"]
