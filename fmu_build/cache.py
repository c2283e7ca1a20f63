"""What was made before, in the user's cache folder, under a key of everything that went into it.

What is found there is believed if it bears the checksum of its key and bytes, and nobody else can write to the folder.
Otherwise, and where nothing can be kept, it is made as if there were no cache. The environment variable
FMU_BUILD_CACHE names another folder; empty, it switches all of this off.
"""

from __future__ import annotations

import hashlib
import os
import re
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import cache
from pathlib import Path

from platformdirs import user_cache_path

SETTING = "FMU_BUILD_CACHE"
LARGEST = 2**29  # bytes that stay; what was used longest ago goes first
ABANDONED = 86400.0  # s, after which a file that has got no name yet is that of a build that was killed
SETTLED = 10**9  # ns, after which a file that changes again tells by its times: they go by ticks of milliseconds
CHECKSUM = 32  # bytes, before the content

Part = str | Path  # a text; a file, which counts with its name and bytes


def kept(parts: Callable[[], Iterator[Part]], make: Callable[[], bytes]) -> bytes:
    """What ``make`` makes of ``parts``, which are all that it depends on; from before, if it was made of equal ones.

    Raises what ``make`` raises, and what ``parts`` raises but OSError: what cannot be read is no part.
    """
    folder = _folder()
    name = folder and _key(parts)
    if folder is None or name is None:
        return make()
    found = _found(folder / name)
    if found is not None:
        return found
    made = make()
    if _key(parts) == name:  # else a file has been changed meanwhile, and nobody knows which of the two was read
        _keep(folder / name, made)
    return made


def tools() -> Iterator[str]:
    """This Python, and the packages that it finds with their versions."""
    yield sys.version
    for folder in map(Path, sys.path):
        if folder.is_dir():
            yield from sorted(path.name for path in folder.iterdir() if path.suffix in (".dist-info", ".egg-info"))


def _key(parts: Callable[[], Iterator[Part]]) -> str | None:
    whole = hashlib.sha256()
    try:
        for part in parts():
            whole.update(hashlib.sha256(repr(part).encode("utf-8", "backslashreplace")).digest())
            if isinstance(part, Path):
                whole.update(_digest(part))
    except OSError:
        return None
    return whole.hexdigest()


def _digest(file: Path) -> bytes:
    """Of the content. A build asks several times, so what has not changed since is not read again."""
    status = file.stat()
    changed = max(status.st_mtime_ns, status.st_ctime_ns)
    if time.time_ns() - changed < SETTLED:
        return _content_digest(file)
    return _remembered(file, status.st_ino, status.st_size, changed)


@cache
def _remembered(file: Path, *_: int) -> bytes:
    return _content_digest(file)


def _content_digest(file: Path) -> bytes:
    return hashlib.sha256(file.read_bytes()).digest()


def _folder() -> Path | None:
    """None where nothing is to be kept, or where others could put something."""
    named = os.environ.get(SETTING)
    folder = Path(named) if named else user_cache_path("fmu_build")
    if named == "" or not (named or folder.is_absolute()):  # the latter for a user without a home
        return None
    with suppress(FileNotFoundError):
        status = folder.stat()
        if hasattr(os, "geteuid") and (status.st_uid != os.geteuid() or status.st_mode & 0o022):
            return None
    return folder


def _found(path: Path) -> bytes | None:
    try:
        content = path.read_bytes()
        os.utime(path)
    except OSError:
        return None
    return content[CHECKSUM:] if content[:CHECKSUM] == _checksum(path, content[CHECKSUM:]) else None


def _checksum(path: Path, content: bytes) -> bytes:
    return hashlib.sha256(path.name.encode() + content).digest()


def _keep(path: Path, content: bytes) -> None:
    """A full disk, or a folder that cannot be written to, costs time and nothing else."""
    with suppress(OSError):
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        handle, temporary = tempfile.mkstemp(prefix="new-", dir=path.parent)
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(_checksum(path, content) + content)
            os.replace(temporary, path)
        except BaseException:
            os.unlink(temporary)
            raise
        _prune(path.parent)


def _prune(folder: Path) -> None:
    """Leave what was used last, up to LARGEST bytes, and what is being written. Files of other names are not ours."""
    files = [(path, path.stat()) for path in folder.iterdir() if re.fullmatch(r"[0-9a-f]{64}|new-\w+", path.name)]
    size = 0
    for path, status in sorted(files, key=lambda file: file[1].st_mtime, reverse=True):
        is_new = path.name.startswith("new-")
        size += 0 if is_new else status.st_size
        if size > LARGEST if not is_new else time.time() - status.st_mtime > ABANDONED:
            path.unlink(missing_ok=True)
