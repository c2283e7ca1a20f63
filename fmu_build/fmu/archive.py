"""Files to an FMU: a zip whose bytes depend on its content alone."""

from __future__ import annotations

import hashlib
import io
import os
import tempfile
import uuid
import zipfile
from collections.abc import Mapping
from pathlib import Path

from ..errors import BuildError

EPOCH = (1980, 1, 1, 0, 0, 0)  # the earliest time that a zip can tell


def content_token(files: Mapping[str, bytes]) -> str:
    """A GUID in braces that changes with the content of ``files`` and only then."""
    digest = hashlib.sha256()
    for name in sorted(files):
        digest.update(f"{name}:{len(files[name])}:".encode() + files[name])
    return f"{{{uuid.UUID(bytes=digest.digest()[:16])}}}"


def check_output(output: Path) -> None:
    """BuildError where no file can be ``output``; folders on the way there need not be there yet."""
    if output.is_dir():
        raise BuildError(f"{output} is a folder; name the FMU to write, such as {output / 'Model.fmu'}")
    if output.exists() and not output.is_file():
        raise BuildError(f"{output} is no file that could be replaced; name the FMU to write")
    there = next(folder for folder in output.absolute().parents if folder.exists())
    if not there.is_dir():
        raise BuildError(f"cannot write {output}: {there} is no folder")


def packed(files: Mapping[str, bytes]) -> bytes:
    """The FMU with these ``files`` (path in the archive to content)."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in sorted(files):
            entry = zipfile.ZipInfo(name, EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, files[name])
    return stream.getvalue()


def write(output: Path, fmu: bytes) -> None:
    """Write an FMU to ``output``: all of it, or nothing and BuildError."""
    try:
        output.parent.mkdir(parents=True, exist_ok=True)
        _replace(output, fmu)
    except OSError as error:
        raise BuildError(f"cannot write {output}: {error.strerror or error}") from None


def _replace(output: Path, fmu: bytes) -> None:
    handle, temporary = tempfile.mkstemp(prefix=".fmu_build-", dir=output.parent)
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(fmu)
        os.chmod(temporary, 0o644)
        os.replace(temporary, output)
    except BaseException:
        os.unlink(temporary)
        raise
