"""Our own trajectories for others to check against, at a stated accuracy."""

__all__ = ["cases", "layered_standard", "table", "trajectories"]
