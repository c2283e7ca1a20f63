"""Many runs, on all cores or a cluster."""

__all__ = ["engine", "map", "plan", "planner", "spec", "table"]
