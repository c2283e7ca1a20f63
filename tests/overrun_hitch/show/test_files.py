"""Files are whole or as they were; CSV keeps every digit, in the bytes that Python's own writer would give."""

from __future__ import annotations

import csv
import io
import json
import math
import os
import stat
import tempfile
from pathlib import Path

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from overrun_hitch.parameters import HitchError
from overrun_hitch.show.files import json_text, write, write_atomically, write_csv

MAYBE = st.one_of(st.none(), st.floats(width=32))
NUMBERS = st.lists(st.tuples(st.floats(), MAYBE, st.integers(0, 1), st.sampled_from(["jacobi", "a, b"])))


def by_hand(rows: list[tuple[object, ...]], names: list[str]) -> bytes:
    text = io.StringIO(newline="")
    table = csv.writer(text, lineterminator="\n")
    table.writerow(names)
    words = {None: "nan"}
    table.writerows([repr(cell) if isinstance(cell, float) else words.get(cell, cell) for cell in row] for row in rows)
    return text.getvalue().encode()


@given(rows=NUMBERS)
@example(rows=[(1e16, 1e-5, 1, "jacobi"), (0.1 + 0.2, -0.0, 0, "jacobi"), (5e-324, 1.7976931348623157e308, 1, "a, b")])
@example(rows=[(float("nan"), float("inf"), 0, "jacobi"), (-float("inf"), 123456789012345680.0, 1, "jacobi")])
def test_csv_keeps_every_digit(rows: list[tuple[object, ...]]) -> None:
    names = ["time [s]", "v_car [m/s]", "self_excited [1]", "scheme"]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "new" / "table.csv"
        write_csv(path, {name: [row[place] for row in rows] for place, name in enumerate(names)})
        assert path.read_bytes() == by_hand(rows, names)
        assert list(path.parent.iterdir()) == [path]


def test_json_has_null_for_what_is_not_finite() -> None:
    text = json_text({"a": [math.nan, -math.inf, 0.1], "b": {"c": True, "d": "±"}})
    assert json.loads(text) == {"a": [None, None, 0.1], "b": {"c": True, "d": "±"}}
    assert text.isascii()


def test_files_that_everybody_may_read(tmp_path: Path) -> None:
    paths = write({tmp_path / "a" / "one": b"1", tmp_path / "two": b"2"})
    assert [path.read_bytes() for path in paths] == [b"1", b"2"]
    mask = os.umask(0)
    os.umask(mask)
    assert os.name == "nt" or stat.S_IMODE(paths[0].stat().st_mode) == 0o666 & ~mask


def test_a_folder_that_is_a_file_costs_one_line(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(HitchError, match=r"^cannot write .*run\.csv: "):
        write_csv(tmp_path / "file" / "run.csv", {"time [s]": [0.0]})


def test_a_write_that_fails_leaves_what_was_there(tmp_path: Path) -> None:
    path = tmp_path / "run.csv"
    path.write_text("before")

    def interrupted(temporary: Path) -> None:
        temporary.write_text("half")
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_atomically(path, interrupted)
    assert path.read_text() == "before"
    assert list(tmp_path.iterdir()) == [path]
