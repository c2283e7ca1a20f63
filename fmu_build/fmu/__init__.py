"""Describes, compiles and packs the FMU."""

__all__ = ["archive", "compile", "contents", "fat_mach_o", "interface", "ports"]
