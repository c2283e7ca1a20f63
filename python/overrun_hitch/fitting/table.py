"""What `hitch fit` tells: a table, what the data cannot tell, JSON, CSV, and the parameters as a file."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from overrun_hitch.fitting.estimates import Estimate
from overrun_hitch.fitting.fit import Fit
from overrun_hitch.fitting.trace import UNITS, Floats
from overrun_hitch.show.table import Column, Numbers, console, show_rows, show_written

COLUMNS = (
    Column(), Column("unit"), Numbers("value"), Numbers("standard\nerror"), Numbers("95 %\nfrom"), Numbers("\nto"),
    Column(),
)  # fmt: skip
COHERENT = 0.2  # correlation from sample to sample: noise left in a motion that bends softly makes up to 0.15
MISFIT = 2.0  # rms of a residual over the noise that is expected, from which on it is more than noise


def show(name: str, found: Fit, guesses: Sequence[str], paths: Sequence[Path]) -> None:
    """Print the parameters, what there is to say about them, and the files written."""
    out = console()
    time = found.trace.time
    out.print(f"{name}: {len(time)} samples in {time[-1] - time[0]:.6g} s", markup=False)
    show_rows(out, COLUMNS, map(_cells, found.estimates), map(_sentence, found.estimates))
    for remark in (*guesses, *remarks(found)):
        out.print(remark, soft_wrap=True, markup=False)
    show_written(out, paths)


def remarks(found: Fit) -> list[str]:
    """What a reader must know, a sentence each."""
    said = []
    blind = [estimate.name for estimate in found.estimates if not estimate.told]
    if blind:
        why = "standard error over a quarter of the value, or no effect beyond the noise"
        said.append(f"the data cannot tell {', '.join(blind)}: {why}")
    said += [
        f"{one} and {other} are hardly told apart (correlation {value:.4f}): what is sure is a sum of both"
        for one, other, value in found.alike
    ]
    for name, excess in found.excess.items():
        if excess > MISFIT:
            said.append(
                f"{name} is off by {excess:.2g} times its noise: something moves it that was not fitted, "
                "and the standard errors are too small"
            )
        elif found.coherence[name] > COHERENT:
            said.append(
                f"what is left of {name} hangs together (correlation {found.coherence[name]:.2f} from sample to "
                "sample, noise has 0): the motion bends sharper than its noise lets see, and values may be off by five "
                "standard errors; soften the stops, or measure the travel better"
            )
    return said


def document(name: str, found: Fit, guesses: Sequence[str], paths: Sequence[Path]) -> dict[str, Any]:
    """Everything with units, for JSON; `paths` are the files written beside."""
    return {
        "name": name,
        "samples": len(found.trace.time),
        "parameters": {
            estimate.name: {
                "value": estimate.value,
                "unit": estimate.unit,
                "standard_error": estimate.standard_error,
                "interval_95": list(estimate.interval),
                "told": estimate.told,
            }
            for estimate in found.estimates
        },
        "correlation": found.correlation.tolist(),
        "residual_over_noise": dict(found.excess),
        "residual_correlation": dict(found.coherence),
        "remarks": [*guesses, *remarks(found)],
        "files": [str(path) for path in paths],
    }


def csv_columns(found: Fit) -> dict[str, Floats]:
    """Measured channels, the motion behind them and the model's, each (n,), by names with units."""
    columns = {f"{name} [{UNITS[name]}]": channel for name, channel in found.trace.channels().items()}
    columns["smooth compression [m]"] = found.motion.compression
    columns["smooth v_rel [m/s]"] = found.motion.v_rel
    return columns | {f"fitted {name} [{UNITS[name]}]": channel for name, channel in found.model.items()}


def toml(found: Fit) -> bytes:
    """The parameters that the data tell, for --parameters of other commands."""
    lines = [
        f"{estimate.name} = {estimate.value!r}  # {estimate.unit}\n" for estimate in found.estimates if estimate.told
    ]
    return "".join(lines).encode()


def _cells(estimate: Estimate) -> tuple[str, ...]:
    low, high = estimate.interval
    verdict = "" if estimate.told else "[yellow]not told[/]"
    numbers = (_digits(value, estimate.standard_error) for value in (estimate.value, low, high))
    value, low_text, high_text = numbers
    return estimate.name, estimate.unit, value, _number(estimate.standard_error), low_text, high_text, verdict


def _sentence(estimate: Estimate) -> str:
    name, unit, value, error, low, high, verdict = _cells(estimate)
    return f"{name} = {value} {unit}, standard error {error}, 95 % from {low} to {high} {verdict}"


def _number(value: float) -> str:
    return f"{value:.2g}" if math.isfinite(value) else "-"


def _digits(value: float, error: float) -> str:
    """With two digits of its error."""
    if not math.isfinite(value):
        return "-"
    if not math.isfinite(error) or error <= 0.0:
        return f"{value:.4g}"
    return f"{value:.{max(0, 1 - math.floor(math.log10(error)))}f}"
