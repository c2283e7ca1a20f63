"""Find, open and drive an FMU; the only place that knows fmpy."""

__all__ = [
    "description",
    "files",
    "guest",
    "guest_unit",
    "identity",
    "messages",
    "opening",
    "profiles",
    "sampler",
    "settings",
    "unit",
]
