"""Longitudinal oscillations of a car and its overrun-braked trailer (Sharp 1982), run as an FMU and judged."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from overrun_hitch.fitting.fit import fit
    from overrun_hitch.fitting.trace import Trace
    from overrun_hitch.sweeps.engine import sweep

__all__ = ["Trace", "fit", "sweep"]


def __getattr__(name: str) -> Any:
    # Only when it is asked for: Dask would slow down every start, and the independent check needs numpy alone.
    if name == "sweep":
        from overrun_hitch.sweeps.engine import sweep

        return sweep
    if name == "fit":
        from overrun_hitch.fitting.fit import fit

        return fit
    if name == "Trace":
        from overrun_hitch.fitting.trace import Trace

        return Trace
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
