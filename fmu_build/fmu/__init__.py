"""Describes, compiles and packs the FMU."""

__all__ = ["archive", "binaries", "compile", "contents", "interface", "ports"]
