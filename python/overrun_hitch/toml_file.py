"""TOML files that the user writes."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

from overrun_hitch.parameters import HitchError

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

LONGEST_FILE = 1_000_000  # bytes; all parameters together need 300


def read_toml(file: Path) -> dict[str, Any]:
    """The table in the file. HitchError, naming the file, where it can't be read, is too long or no TOML."""
    try:
        with file.open("rb") as stream:
            content = stream.read(LONGEST_FILE + 1)
    except OSError as error:
        raise HitchError(f"cannot read {file}: {error.strerror or error}") from None
    if len(content) > LONGEST_FILE:
        raise HitchError(f"{file} is longer than {LONGEST_FILE} bytes: no file to give parameters in")
    try:
        table: dict[str, Any] = tomllib.loads(content.decode("utf-8"))
    except (ValueError, RecursionError) as error:
        raise HitchError(f"{file} is not TOML, such as k = 5480.0: {error}") from None
    return table
