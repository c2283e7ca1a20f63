"""Trace files of any form, by the ends of their names."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

from overrun_hitch.foreign.table import Table
from overrun_hitch.parameters import HitchError

FORMS: Mapping[str, str] = {
    ".csv": "csv", ".txt": "csv", ".tsv": "csv", ".dat": "csv", ".asc": "csv",
    ".mat": "mat", ".parquet": "parquet", ".pq": "parquet", ".mf4": "mdf", ".mdf": "mdf",
}  # fmt: skip


def read_table(path: Path) -> Table:
    """The columns of a file. HitchError, naming it, where it is of no known form or cannot be read."""
    form = FORMS.get(path.suffix.lower())
    if form is None:
        raise HitchError(f"{path} is no trace that can be read; allowed: {', '.join(FORMS)}")
    return _reader(form)(path)


def _reader(form: str) -> Callable[[Path], Table]:
    # Imported here, because pandas and SciPy's reader take their time, and one form is needed.
    if form == "csv":
        from overrun_hitch.foreign.csv_file import read_csv_file

        return read_csv_file
    if form == "mat":
        from overrun_hitch.foreign.mat_file import read_mat_file

        return read_mat_file
    from overrun_hitch.foreign import columnar_file

    return columnar_file.read_parquet_file if form == "parquet" else columnar_file.read_mdf_file
