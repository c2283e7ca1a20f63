"""The frame of a store, all that is there before the first run: made, checked, and where it is damaged made again.

It follows from the plan, so what is lost of it can be made again, and is put back if it is to the byte what was there.
"""

from __future__ import annotations

import json
import os
import shutil
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from overrun_hitch.parameters import HitchError
from overrun_hitch.sweeps import checksums
from overrun_hitch.sweeps.layout import LAYOUT, WRITTEN, write_empty
from overrun_hitch.sweeps.plan import Plan, differing

FRAME = "frame"  # the list of its checksums
ATTRIBUTES = ".zattrs"  # of the store: which sweep it is
MOST_NAMED = 3


def create(folder: Path, plan: Plan) -> None:
    """An empty store, at its place only when it is whole. OSError."""
    with _fresh(folder, plan) as fresh:
        checksums.seal(fresh, FRAME, _files(fresh))
        os.replace(fresh, folder)
        checksums.settle_folder(folder.parent)


def check(folder: Path, plan: Plan, *, repair: bool) -> None:
    """HitchError if this is no store of `plan`'s sweep, or its frame is damaged and not to be repaired. OSError."""
    listed = checksums.listed(folder, FRAME)
    lost = checksums.damaged(folder, [FRAME])[FRAME] if listed is not None else [f"{checksums.FOLDER}/{FRAME}"]
    if ATTRIBUTES not in lost:
        _check_sweep(folder, plan)
    if lost and not repair:
        raise damage(folder, lost)
    if lost:
        _repair(folder, plan, listed or {}, lost)


def damage(folder: Path, files: list[str]) -> HitchError:
    """What is said of files that are damaged."""
    more = f" and {len(files) - MOST_NAMED} more" if len(files) > MOST_NAMED else ""
    return HitchError(
        f"{folder} is damaged: {', '.join(files[:MOST_NAMED])}{more}; allowed: the same command with --repair, which "
        "makes again exactly what is lost, or a new place"
    )


def _check_sweep(folder: Path, plan: Plan) -> None:
    try:
        attributes: dict[str, Any] = dict(json.loads((folder / ATTRIBUTES).read_bytes()))
        identity: dict[str, Any] = dict(json.loads(attributes["sweep"]))
    except (KeyError, TypeError, ValueError, FileNotFoundError, NotADirectoryError):
        raise HitchError(f"{folder} is there and holds no sweep; allowed: a new place, or the same sweep's") from None
    if attributes.get("layout") != LAYOUT:
        raise HitchError(
            f"{folder} was made by another version of hitch, whose stores this one can't check; allowed: a new place, "
            "or that version (xarray.open_zarr reads what is there)"
        )
    names = differing(plan.identity, identity)
    if names:
        raise HitchError(
            f"{folder} holds another sweep, which differs in {', '.join(names)}; allowed: a new place, or the same spec"
        )


def _repair(folder: Path, plan: Plan, listed: Mapping[str, str], lost: list[str]) -> None:
    """Put back the files of the frame that are lost; all that differ from new ones where its list is lost itself."""
    with _fresh(folder, plan) as fresh:
        files = _files(fresh)
        made = {file: checksums.checksum_of(fresh / file) for file in files}
        if any(listed[file] != made.get(file) for file in lost if listed):
            raise HitchError(
                f"{folder} is damaged ({', '.join(lost[:MOST_NAMED])}), and is of another sweep or was made by other "
                "versions of hitch, zarr or xarray, so it can't be repaired; allowed: a new place, or those versions"
            )
        for file in files:
            if file in lost or (not listed and made[file] != checksums.checksum_of(folder / file)):
                (folder / file).parent.mkdir(parents=True, exist_ok=True)
                os.replace(fresh / file, folder / file)
    checksums.seal(folder, FRAME, files)


@contextmanager
def _fresh(folder: Path, plan: Plan) -> Iterator[Path]:
    """An empty store beside `folder`, for a while."""
    temporary = Path(tempfile.mkdtemp(dir=folder.parent, prefix=f".{folder.name}-"))
    try:
        fresh = temporary / "new"
        write_empty(plan, fresh)
        (fresh / checksums.FOLDER).mkdir()
        # A group of its own, so that whoever lists the store finds nothing that is not Zarr.
        (fresh / checksums.FOLDER / ".zgroup").write_text('{"zarr_format": 2}', encoding="ascii")
        yield fresh
    finally:
        shutil.rmtree(temporary)


def _files(store: Path) -> list[str]:
    """The files of an empty store that stay as they are, as paths in it."""
    paths = sorted(path.relative_to(store) for path in store.rglob("*") if path.is_file())
    return [path.as_posix() for path in paths if path.parent.name not in WRITTEN or path.name.startswith(".")]
