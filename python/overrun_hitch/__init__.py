"""Longitudinal oscillations of a car and its overrun-braked trailer (Sharp 1982), run as an FMU and judged."""
