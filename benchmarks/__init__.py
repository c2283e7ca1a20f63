"""Measurements of the FMU; `make bench` runs them."""
