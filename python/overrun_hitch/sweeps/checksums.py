"""Lists of checksums in a store, such as `sha256sum -c checksums/*` reads; what one names was on disk before it was.

A list ends with the checksum of its own lines, as a comment, so that a damaged list is told from damaged files.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TypeVar

FOLDER = "checksums"
THREADS = 16  # that wait for the disk at once: it then writes for all of them together

One = TypeVar("One")
Other = TypeVar("Other")


def seal(store: Path, name: str, files: Sequence[str]) -> None:
    """Put `files` (paths in `store`) on disk, power cut or not, and then their checksums in the list `name`.

    OSError where that is not possible; the list then is not there, or is the one before.
    """
    paths = [store / file for file in files]
    found = _at_once(_settled, paths)
    _at_once(settle_folder, sorted({path.parent for path in paths}))
    lines = "".join(f"{checksum}  {file}\n" for checksum, file in zip(found, files, strict=True))
    place = store / FOLDER / name
    temporary = place.with_name(f".{name}")
    temporary.write_bytes(f"{lines}# {_checksum(lines.encode())}\n".encode())
    _settled(temporary)
    temporary.replace(place)
    settle_folder(place.parent)


def listed(store: Path, name: str) -> dict[str, str] | None:
    """Checksum by file of the list `name`; empty if it is damaged, None if there is none. PermissionError."""
    content = _content(store / FOLDER / name)
    if content is None:
        return None
    lines, _, own = content.rpartition(b"# ")
    if own != f"{_checksum(lines)}\n".encode():
        return {}
    return {file: checksum for checksum, _, file in (line.partition("  ") for line in lines.decode().splitlines())}


def damaged(store: Path, names: Iterable[str]) -> dict[str, list[str]]:
    """For each of the lists the files that are not what they were, or the list itself; None where there is none.

    PermissionError for what may not be read.
    """
    names = list(names)
    return dict(zip(names, _at_once(lambda name: _damaged(store, name), names), strict=True))


def checksum_of(path: Path) -> str:
    """That of a file, "" if there is none that can be read. PermissionError."""
    content = _content(path)
    return "" if content is None else _checksum(content)


def settle_folder(folder: Path) -> None:
    """Put on disk which files are in it. OSError."""
    if os.name == "posix":  # elsewhere a folder can't be opened
        _sync(folder, os.O_RDONLY)


def _damaged(store: Path, name: str) -> list[str]:
    expected = listed(store, name)
    if expected is None:
        return []
    if not expected:
        return [f"{FOLDER}/{name}"]
    return [file for file, checksum in expected.items() if checksum_of(store / file) != checksum]


def _settled(path: Path) -> str:
    """The checksum of a file, which then is on disk. OSError."""
    _sync(path, os.O_RDWR)
    return _checksum(path.read_bytes())


def _sync(path: Path, flags: int) -> None:
    descriptor = os.open(path, flags)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def _content(path: Path) -> bytes | None:
    try:
        return path.read_bytes()
    except PermissionError:
        raise
    except OSError:
        return None


def _checksum(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


def _at_once(do: Callable[[One], Other], items: Sequence[One]) -> list[Other]:
    with ThreadPoolExecutor(THREADS) as pool:
        return list(pool.map(do, items))
