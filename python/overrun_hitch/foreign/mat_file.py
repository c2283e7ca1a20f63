"""MAT files: trajectories as Dymola and OpenModelica write them (class Atrajectory, version 1.1), and plain vectors.

A trajectory has its names and descriptions, with the units in brackets, as rows of characters; `dataInfo` says for each
variable in which of two matrices it is, in which column, and whether with the opposite sign. The matrices may be
transposed ("binTrans"). A variable in the first one, a parameter, has two values, which are the same.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from scipy.io import loadmat

from overrun_hitch.foreign.table import HEADER, Floats, Table, table
from overrun_hitch.parameters import HitchError

TRAJECTORY = {"Aclass", "name", "description", "dataInfo", "data_1", "data_2"}


def read_mat_file(path: Path) -> Table:
    """The table. HitchError, naming the file, where it is none."""
    try:
        content = loadmat(path, chars_as_strings=False)
    except OSError as error:
        raise HitchError(f"cannot read {path}: {error.strerror or error}") from None
    except NotImplementedError:  # SciPy's word for HDF5 inside
        raise HitchError(f"{path} is a MAT file of version 7.3; allowed: 4 to 7.2 (save -v7)") from None
    except Exception as error:  # scipy's reader of what is no MAT file raises as it comes
        raise HitchError(f"{path} is no MAT file: {' '.join(str(error).split())}") from None
    if content.keys() >= TRAJECTORY:
        try:
            return _trajectory(path, content)
        except (IndexError, ValueError, TypeError):
            raise HitchError(f"{path} is broken: what it says of its trajectories is not what it holds") from None
    vectors = {name: array for name, array in content.items() if _is_vector(array)}
    if not vectors:
        raise HitchError(f"{path} has neither trajectories nor vectors of numbers")
    return table(path, ((name, None) for name in vectors), lambda name: vectors[name].astype(np.float64).ravel())


def _is_vector(array: Any) -> bool:
    return isinstance(array, np.ndarray) and array.dtype.kind in "fiu" and array.ndim == 2 and 1 in array.shape


def _trajectory(path: Path, content: Mapping[str, Any]) -> Table:
    form = "".join(content["Aclass"][3]).strip()
    if form not in ("binTrans", "binNormal"):
        raise HitchError(f"{path} has its trajectories as {form!r:.20}; allowed: binTrans and binNormal")
    turned = form == "binTrans"  # each variable a column of what is written
    names, descriptions = (_rows(content[key], turned) for key in ("name", "description"))
    info, *data = (content[key] if turned else content[key].T for key in ("dataInfo", "data_1", "data_2"))
    # 0 is the abscissa's, which is in the second, too.
    places = {name: (int(column[0]) or 2, int(column[1])) for name, column in zip(names, info.T, strict=True)}
    length = data[1].shape[1]

    def read(name: str) -> Floats:
        matrix, row = places[name]
        samples = data[matrix - 1][abs(row) - 1].astype(np.float64)
        samples = samples if len(samples) == length else np.full(length, samples[0])
        if not np.isfinite(samples).all():
            raise HitchError(f"{path}: {name!r:.40} is not finite from the start to the end")
        return np.asarray(np.sign(row) * samples)

    units = [HEADER.fullmatch(text) for text in descriptions]
    return table(path, zip(names, (_unit(found["unit"]) if found else None for found in units), strict=True), read)


def _rows(characters: Any, turned: bool) -> list[str]:
    rows = characters.T if turned else characters
    return ["".join(row).rstrip("\x00 ") for row in rows]


def _unit(text: str) -> str | None:
    """Dymola writes "[m/s|km/h]", the unit and that for display; flags such as "[:#(type=Real)]" are none."""
    unit = text.partition("|")[0].strip()
    return unit if unit and not unit.startswith(":") else None
