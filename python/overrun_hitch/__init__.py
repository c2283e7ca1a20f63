"""Longitudinal oscillations of a car and its overrun-braked trailer (Sharp 1982), run as an FMU and judged.

import overrun_hitch as hitch

result = hitch.run("8", C=200)                      # a step brake: xarray, with units
hitch.compare(result)                               # against linear theory: pandas
hitch.plot(result).savefig("figure.png")
hitch.run_many({"C": [100, 200], "eps": [0, 0.1]})  # thousands of runs in one table
hitch.stability("ii", V=[10, 40])["C_crit"]         # the damper that is just enough
hitch.fit("bench.csv").estimates                    # a drawbar's parameters from what was measured
hitch.fmu_path("Trailer", fmi=3)                    # the file, for a simulator
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from overrun_hitch.api import compare, crosscheck, fit, fmu_path, plot, run, run_many, stability, sweep
    from overrun_hitch.fitting.trace import Trace
    from overrun_hitch.parameters import CASES, FIGURES, HitchError, Parameters

    __version__: str

# Where each name is at home: loaded only when it is asked for, because the independent check needs numpy alone, and
# nobody should wait for what is not used.
_HOMES = {
    **dict.fromkeys(
        ("compare", "crosscheck", "fit", "fmu_path", "plot", "run", "run_many", "stability", "sweep"), "api"
    ),
    **dict.fromkeys(("CASES", "FIGURES", "HitchError", "Parameters"), "parameters"),
    "Trace": "fitting.trace",
}
__all__ = ["CASES", "FIGURES", "HitchError", "Parameters", "Trace", "__version__", "compare", "crosscheck", "fit",
           "fmu_path", "plot", "run", "run_many", "stability", "sweep"]  # fmt: skip


def __getattr__(name: str) -> Any:
    if name == "__version__":
        from importlib.metadata import version

        return version("overrun_hitch")
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
