"""Many runs, on all cores or a cluster."""

__all__ = ["engine", "job", "many", "map", "plan", "planner", "remote", "spec", "table"]
