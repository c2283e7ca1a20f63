"""Many runs, on all cores or a cluster."""

__all__ = ["engine", "map", "plan", "planner", "remote", "spec", "table"]
