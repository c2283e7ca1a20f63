"""One manoeuvre a module, run on the FMU."""

__all__ = ["drive", "free_vibration", "limit_cycle", "linearisation", "step_brake", "stop", "torque"]
