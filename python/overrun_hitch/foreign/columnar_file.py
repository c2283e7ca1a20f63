"""Parquet and ASAM MDF, by libraries that are installed only where they are wanted: pip install overrun-hitch[traces].

The one module that touches asammdf and pyarrow.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from overrun_hitch.foreign.table import Floats, Table, table
from overrun_hitch.parameters import HitchError


def read_parquet_file(path: Path) -> Table:
    """The table; units in the names or as `unit` in the fields' metadata. HitchError where it is none."""
    parquet = _library("pyarrow.parquet", path)
    content = _opened(path, lambda: parquet.read_table(path))
    units = [
        ((field.metadata or {}).get(b"unit") or b"").decode("utf-8", "replace") or None for field in content.schema
    ]

    def read(name: str) -> Floats:
        return _finite(path, name, content.column(content.column_names.index(name)).to_numpy())

    return table(path, zip(content.column_names, units, strict=True), read)


def read_mdf_file(path: Path) -> Table:
    """The table, of all channels at the times of any of them, between theirs on straight lines. `time` is in s."""
    asammdf = _library("asammdf", path)
    frame, units = _opened(path, lambda: _channels(asammdf, path))

    def read(name: str) -> Floats:
        return _finite(path, name, frame.index.to_numpy() if name == "time" else frame[name].to_numpy())

    names = ["time", *(str(name) for name in frame.columns if name != "time")]
    return table(path, ((name, units.get(name)) for name in names), read)


def _channels(asammdf: Any, path: Path) -> tuple[Any, dict[str, str | None]]:
    with asammdf.MDF(path) as mdf:
        frame = mdf.to_dataframe()
        units = {str(name): mdf.get(str(name), *mdf.whereis(str(name))[0]).unit or None for name in frame.columns}
    return frame, {**units, "time": "s"}


def _library(name: str, path: Path) -> Any:
    try:
        return __import__(name, fromlist=["_"])
    except ImportError:
        package = name.partition(".")[0]
        raise HitchError(f"{path} needs the package {package}: pip install 'overrun-hitch[traces]'") from None


def _opened(path: Path, read: Callable[[], Any]) -> Any:
    try:
        return read()
    except OSError as error:
        raise HitchError(f"cannot read {path}: {error.strerror or error}") from None
    except Exception as error:  # both raise as it comes, for what is not theirs
        raise HitchError(f"{path} cannot be read: {' '.join(str(error).split())}") from None


def _finite(path: Path, name: str, values: Any) -> Floats:
    try:
        samples = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise HitchError(f"{path}: column {name!r:.40} holds no numbers") from None
    wrong = np.flatnonzero(~np.isfinite(samples))
    if wrong.size:
        raise HitchError(f"{path}: column {name!r:.40}, sample {int(wrong[0]) + 1} is not a finite number")
    return samples
