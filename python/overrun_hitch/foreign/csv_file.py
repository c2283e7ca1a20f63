"""CSV files as people write them: any separator, points or commas in numbers, a line of units below that of names."""

from __future__ import annotations

import codecs
import io
import re
import warnings
from pathlib import Path

import numpy as np
import pandas as pd

from overrun_hitch.foreign.table import Floats, Table, table
from overrun_hitch.parameters import HitchError

SEPARATORS = (";", "\t", ",", "|")  # the first that is in the line of names; else any white space
MARKS = {codecs.BOM_UTF16_LE: "utf-16", codecs.BOM_UTF16_BE: "utf-16", codecs.BOM_UTF8: "utf-8-sig"}
COMMA = re.compile(r"\s*[-+]?\d*,\d+(?:[eE][-+]?\d+)?\s*")


def read_csv_file(path: Path) -> Table:
    """The table. HitchError, naming the file, where it is none; a column that holds no numbers is refused when read."""
    frame = _frame(path)
    units: list[str | None] = [None] * len(frame.columns)
    first = 2  # line of the first numbers
    if len(frame) > 1 and _is_words(frame.iloc[0]) and not _is_words(frame.iloc[1]):
        units = [text.strip().strip("[]()") or None for text in frame.iloc[0]]
        frame, first = frame.iloc[1:], 3
    names = [str(name).strip() for name in frame.columns]

    def read(name: str) -> Floats:
        place = names.index(name)
        return _numbers(path, names[place], frame.iloc[:, place], first)

    return table(path, zip(names, units, strict=True), read)


def _frame(path: Path) -> pd.DataFrame:
    try:
        text = io.StringIO(_text(path.read_bytes()), newline=None).read()
        head = text.partition("\n")[0]
        separator = next((mark for mark in SEPARATORS if mark in head), r"\s+")
        try:
            return _parsed(text, separator)
        except pd.errors.ParserWarning:  # which may be no numbers, but separators at the ends of the lines
            return _parsed(re.sub(rf"{re.escape(separator)}[ ]*$", "", text, flags=re.MULTILINE), separator)
    except OSError as error:
        raise HitchError(f"cannot read {path}: {error.strerror or error}") from None
    except pd.errors.ParserWarning:
        raise HitchError(f"{path}: lines have more numbers than there are names; allowed: one for each") from None
    except (ValueError, pd.errors.ParserError) as error:
        raise HitchError(f"{path} is no table under one line of names: {' '.join(str(error).split())}") from None


def _parsed(text: str, separator: str) -> pd.DataFrame:
    """Cells as text. ParserWarning where lines have more of them than names, of which pandas would lose some."""
    with warnings.catch_warnings():
        warnings.simplefilter("error", pd.errors.ParserWarning)
        return pd.read_csv(
            io.StringIO(text),
            sep=separator,
            skipinitialspace=True,
            dtype=str,
            keep_default_na=False,
            index_col=False,  # else the first column is none where all lines have a number too many
        )


def _text(content: bytes) -> str:
    """By its mark, else UTF-8, else what Windows writes in western Europe."""
    encoding = next((name for mark, name in MARKS.items() if content.startswith(mark)), "utf-8")
    try:
        return content.decode(encoding)
    except UnicodeDecodeError:
        return content.decode("cp1252", errors="replace")


def _is_words(row: pd.Series) -> bool:
    return not any(re.match(r"\s*[-+]?[.,]?\d|\s*[-+]?(?:nan|inf)", cell, re.IGNORECASE) for cell in row)


def _numbers(path: Path, name: str, column: pd.Series, first: int) -> Floats:
    if column.map(lambda cell: bool(COMMA.fullmatch(cell))).any():
        column = column.map(lambda cell: cell.replace(",", ".") if "." not in cell and cell.count(",") == 1 else cell)
    numbers = np.asarray(pd.to_numeric(column, errors="coerce"), dtype=np.float64)
    wrong = np.flatnonzero(~np.isfinite(numbers))
    if wrong.size:
        place = int(wrong[0])
        raise HitchError(
            f"{path}: column {name!r:.40}, line {place + first}: {column.iloc[place]!r:.20} is not a finite number"
        )
    return numbers
