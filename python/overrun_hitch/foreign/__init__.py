"""What others call our variables, in which units and with which signs, and the files that their traces come in."""

__all__ = ["candidates", "mapping", "table", "trace_file", "units"]
