"""What callers of the API give, as it is needed; HitchError for what is none, before anything is run."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from overrun_hitch.parameters import FIGURES, HitchError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import numpy as np
    import xarray as xr
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

NO_NUMBERS = "bmMc"  # kinds of arrays that NumPy would turn into floats: truths, durations and dates, complex numbers


def numbers(name: str, values: object) -> Floats:
    """(n,), of a number too."""
    import numpy as np

    try:
        if np.asarray(values).dtype.kind in NO_NUMBERS or np.ma.is_masked(values):
            raise TypeError
        return np.atleast_1d(np.asarray(values, dtype=np.float64))
    except (TypeError, ValueError):
        raise HitchError(f"{name} = {values!r:.40} is not allowed: a number is, or several") from None


def names_in(name: str, values: str | int | Sequence[str | int]) -> list[str]:
    """Of one name, too."""
    if isinstance(values, str | int):
        return [str(values)]
    check_kind(name, values, list | tuple, "a name is, or several in a list")
    return [str(value) for value in values]


def check_kind(name: str, value: object, kind: Any, allowed: str) -> None:
    """`kind`: a type, or several; True is of none, though Python takes it for a number."""
    if isinstance(value, bool) or not isinstance(value, kind):
        raise HitchError(f"{name} = {value!r:.40} is not allowed: {allowed}")


def check_one_torque(profile: object, brake_torque: object) -> None:
    """A profile is the torque; one that is given beside it would count for nothing."""
    if profile is not None and brake_torque is not None:
        raise HitchError("profile and brake_torque exclude each other: a profile is the brake torque over time")


def check_files(files: object, maps: Mapping[str, object], figures: Sequence[str]) -> None:
    """What is to be compared, and in what; a mapping for none of the files would count for nothing."""
    check_kind("files", files, list | tuple, "two files or more are, in a list")
    given = files if isinstance(files, list | tuple) else ()
    for file in given:
        check_kind("file", file, str | Path, "a path is")
    if not figures:
        raise HitchError(f"no figure is to be compared; allowed: {', '.join(FIGURES)}")
    strange = sorted({str(name) for name in maps} - {str(file) for file in given})
    if strange:
        raise HitchError(f"maps: {strange[0]!r:.80} is none of the files; allowed: {', '.join(map(str, given))}")


def check_result(result: xr.Dataset) -> None:
    """The whole of what `run` returns."""
    import xarray as xr

    from overrun_hitch.results import VARIABLES, scenario_of  # which brings numpy, and commands use this module

    check_kind("result", result, xr.Dataset, "what hitch.run returns is")
    scenario_of(result)
    missing = [name for name in VARIABLES if name not in result]
    if missing:
        raise HitchError(f"the result has no {missing[0]}; needed: all that hitch.run returns")
