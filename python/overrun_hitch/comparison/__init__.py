"""Theory against simulation, and files of other people against each other."""

__all__ = [
    "crosscheck",
    "crosscheck_figures",
    "crosscheck_table",
    "distances",
    "proposal",
    "record",
    "sources",
    "theory",
    "theory_table",
]
