"""Measurements of the FMU; `make bench` runs those of a run of figure 8."""
