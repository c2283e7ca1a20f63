"""Which parameters matter, and which damper to choose."""

__all__ = ["optimise", "optimise_table", "sensitivity", "sensitivity_figure", "sensitivity_table"]
