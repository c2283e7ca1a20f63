"""The commands of `hitch`: options in, exit status out."""

__all__ = [
    "cases",
    "couple",
    "crosscheck",
    "fit",
    "live",
    "optimise",
    "paper",
    "parameters",
    "reference",
    "report",
    "run",
    "sensitivity",
    "stability",
    "sweep",
]
