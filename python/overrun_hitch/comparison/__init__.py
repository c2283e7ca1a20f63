"""Theory against simulation, and FMUs against each other."""

__all__ = ["crosscheck", "crosscheck_figures", "crosscheck_table", "theory", "theory_table"]
