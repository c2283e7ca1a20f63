"""Files: each is written whole, or what was there stays. CSV and JSON."""

from __future__ import annotations

import csv
import io
import json
import math
import os
import tempfile
from collections.abc import Callable, Iterable, Mapping
from functools import partial
from pathlib import Path
from typing import Any

from overrun_hitch.parameters import HitchError


def write(contents: Mapping[Path, bytes]) -> list[Path]:
    """Write every file; returns their paths. HitchError if one cannot be written."""
    for path, content in contents.items():
        write_atomically(path, partial(_fill, content))
    return list(contents)


def write_csv(path: Path, columns: Mapping[str, Iterable[object]]) -> None:
    """Write columns of equal length under their names ("time [s]"), every digit kept, None as nan.

    HitchError if that cannot be.
    """
    text = io.StringIO(newline="")
    table = csv.writer(text, lineterminator="\n")
    table.writerow(columns)
    for row in zip(*columns.values(), strict=True):
        table.writerow([math.nan if cell is None else cell for cell in row])
    write({path: text.getvalue().encode()})


def json_text(document: Any) -> str:
    """A document of dictionaries, lists, text and numbers as JSON, null for what is not finite."""
    return json.dumps(_finite(document), indent=2, allow_nan=False)


def write_atomically(path: Path, fill: Callable[[Path], object]) -> None:
    """Let `fill` fill a temporary file and give it its name only when it is whole. HitchError if that cannot be."""
    temporary: Path | None = None
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.stem}-", suffix=path.suffix)
        os.close(handle)
        temporary = Path(name)
        fill(temporary)
        temporary.chmod(0o666 & ~_umask())  # mkstemp makes files that only their owner may read
        temporary.replace(path)
    except OSError as error:
        raise HitchError(f"cannot write {path}: {error.strerror or error}") from None
    finally:
        if temporary is not None:
            temporary.unlink(missing_ok=True)


def _finite(content: Any) -> Any:
    """JSON knows neither NaN nor infinity."""
    if isinstance(content, dict):
        return {name: _finite(value) for name, value in content.items()}
    if isinstance(content, list):
        return [_finite(value) for value in content]
    return None if isinstance(content, float) and not math.isfinite(content) else content


def _fill(content: bytes, path: Path) -> None:
    path.write_bytes(content)


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
