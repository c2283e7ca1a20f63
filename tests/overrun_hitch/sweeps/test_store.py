"""Stores: what is damaged is found and made again, nothing else; what can't be written is told, and goes on later."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from itertools import product
from pathlib import Path

import pytest
import xarray as xr

from overrun_hitch.parameters import HitchError
from overrun_hitch.sweeps.layout import MISSING
from overrun_hitch.sweeps.plan import Plan
from overrun_hitch.sweeps.planner import planned
from overrun_hitch.sweeps.runner import Runner
from overrun_hitch.sweeps.spec import SweepSpec
from overrun_hitch.sweeps.store import opened_store, read_sweep

SPEC = SweepSpec(
    duration=1.0, metrics=["peak_jerk", "stopping_distance"], trajectories=["a_car"], grid={"C": [100.0, 500.0, 900.0]}
)


def flip(path: Path) -> None:
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 0x10
    path.write_bytes(content)


def truncate(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:-1])


def empty(path: Path) -> None:
    path.write_bytes(b"")


DAMAGES: tuple[Callable[[Path], None], ...] = (flip, truncate, empty, Path.unlink)


class Sweep:
    """A plan, and one process that runs it."""

    def __init__(self, fmu: Path) -> None:
        self.plan: Plan = planned(SPEC, [fmu])
        self.runner = Runner(self.plan.job, fmu)
        self.ran: list[int] = []

    def run(self, store: Path, *, repair: bool = False, most: int = 1000) -> xr.Dataset:
        """Run at most `most` batches of what is missing; `ran` then says which."""
        with opened_store(store, self.plan, repair=repair) as opened:
            self.ran = opened.missing()[:most]
            for number in self.ran:
                opened.write(number, self.runner.run(opened.batch(number)))
        return read_sweep(store).load()


@pytest.fixture(scope="module")
def sweep(car_trailer_fmu: Path) -> Iterator[Sweep]:
    made = Sweep(car_trailer_fmu)
    yield made
    made.runner.close()


@pytest.fixture(scope="module")
def finished(sweep: Sweep, tmp_path_factory: pytest.TempPathFactory) -> Path:
    store = tmp_path_factory.mktemp("finished") / "sweep.zarr"
    sweep.run(store)
    return store


def contents(store: Path) -> dict[str, bytes]:
    return {str(path.relative_to(store)): path.read_bytes() for path in sorted(store.rglob("*")) if path.is_file()}


def times(store: Path) -> dict[str, int]:
    return {str(path.relative_to(store)): path.stat().st_mtime_ns for path in store.rglob("*") if path.is_file()}


def batch_of(file: str) -> str | None:
    """The number of the batch that a file of a store belongs to."""
    array, _, chunk = file.rpartition("/")
    stays = array not in {"a_car", "checksums", "message", "peak_jerk", "status", "stopping_distance"}
    return None if stays or not chunk[0].isdigit() else chunk.partition(".")[0]


# One file of each kind, and what happens to it; all of them take a minute.
SOME = {
    ".zattrs": flip, ".zgroup": empty, "C/0": truncate, "C/.zarray": flip, "fmu/.zattrs": Path.unlink,
    "a_car/1.0": flip, "peak_jerk/2": Path.unlink, "status/0": empty, "time/0": truncate, "checksums/0": flip,
    "checksums/1": Path.unlink, "checksums/frame": empty,
}  # fmt: skip


@pytest.mark.full
@pytest.mark.parametrize("cases", ["some", pytest.param("all", marks=pytest.mark.full)])
def test_whatever_is_damaged_is_named_and_made_again_and_nothing_else(
    cases: str, sweep: Sweep, finished: Path, tmp_path: Path
) -> None:
    whole = contents(finished)
    for file, damage in SOME.items() if cases == "some" else product(whole, DAMAGES):
        store, batch = tmp_path / "sweep.zarr", batch_of(file)
        shutil.copytree(finished, store)
        damage(store / file)
        before = times(store)
        if file != f"checksums/{batch}" or damage is not Path.unlink:  # that batch counts as one that was not run
            with pytest.raises(HitchError, match=r"sweep\.zarr is damaged: ") as told:
                sweep.run(store)
            assert f"is damaged: {file}; allowed: the same command with --repair" in str(told.value), file
            assert times(store) == before
        sweep.run(store, repair=True)
        assert contents(store) == whole, file
        assert sweep.ran == ([] if batch is None else [int(batch)]), file
        after = times(store)
        of_batch = {other for other in after if batch is not None and batch_of(other) == batch}
        assert {other for other in after if after[other] != before.get(other)} <= {file, "checksums/frame", *of_batch}
        sweep.run(store)
        assert sweep.ran == []
        shutil.rmtree(store)


def test_many_damages_at_once(sweep: Sweep, finished: Path, tmp_path: Path) -> None:
    store, whole = shutil.copytree(finished, tmp_path / "sweep.zarr"), contents(finished)
    shutil.rmtree(store / "C")
    for file in ("a_car/0.0", "peak_jerk/0", "status/2"):
        empty(store / file)
    with pytest.raises(HitchError, match=r"damaged: C/\.zarray, C/\.zattrs, C/0; allowed"):
        sweep.run(store)
    sweep.run(store, repair=True)
    assert sweep.ran == [0, 2]
    assert contents(store) == whole


def test_a_repair_makes_no_other_sweep_of_a_store(
    sweep: Sweep, finished: Path, tmp_path: Path, car_trailer_fmu: Path
) -> None:
    """Where the attributes that tell which sweep it is are lost, the list of checksums still tells."""
    store = shutil.copytree(finished, tmp_path / "sweep.zarr")
    empty(store / ".zattrs")
    before = contents(store)
    other = planned(SPEC.model_copy(update={"grid": {"C": [100.0, 500.0, 901.0]}}), [car_trailer_fmu])
    with pytest.raises(HitchError, match="can't be repaired"), opened_store(store, other, repair=True):
        pass
    assert contents(store) == before


def test_what_an_interruption_has_torn_is_run_again_without_a_word(
    sweep: Sweep, finished: Path, tmp_path: Path
) -> None:
    """Chunks of batches that have no list yet, as they are after a power cut."""
    store = tmp_path / "sweep.zarr"
    sweep.run(store, most=2)
    for file in ("a_car/2.0", "peak_jerk/2", "status/2", "message/2"):
        (store / file).write_bytes(b"torn")
    sweep.run(store)
    assert sweep.ran == [2]
    assert contents(store) == contents(finished)


@pytest.mark.skipif(os.name != "posix", reason="folders are not put on disk there")
def test_what_counts_is_on_disk_before_it_counts(sweep: Sweep, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Every file and folder that a batch's list speaks of is synced while the list is not there; then the list."""
    store, synced, sync = tmp_path / "sweep.zarr", dict[int, bool](), os.fsync
    sweep.run(store, most=0)

    def watched(descriptor: int) -> None:
        sync(descriptor)
        synced[os.fstat(descriptor).st_ino] = (store / "checksums" / "0").exists()

    monkeypatch.setattr(os, "fsync", watched)
    sweep.run(store, most=1)
    lines = (store / "checksums" / "0").read_text().splitlines()[:-1]
    files = [store / line.split("  ")[1] for line in lines]
    assert len(files) >= 3
    assert [synced[path.stat().st_ino] for path in (*files, *(file.parent for file in files))] == [False] * 2 * len(
        files
    )
    assert synced[(store / "checksums" / "0").stat().st_ino] is False
    assert synced[(store / "checksums").stat().st_ino] is True


def test_others_read_the_store_as_before(finished: Path) -> None:
    """xarray and pandas, without a warning; the checksums by the system's own program."""
    with xr.open_zarr(finished, consolidated=False) as opened:
        assert set(opened.dims) == {"run", "time"}
        assert set(opened.data_vars) == {"a_car", "message", "peak_jerk", "status", "stopping_distance"}
        assert len(opened[["peak_jerk", "status"]].to_dataframe()) == 3
    lists = sorted(path.relative_to(finished) for path in (finished / "checksums").iterdir() if path.suffix == "")
    assert [path.name for path in lists] == [".zgroup", "0", "1", "2", "frame"]
    if shutil.which("sha256sum"):
        subprocess.run(["sha256sum", "--check", "--quiet", *lists[1:]], cwd=finished, check=True)


def test_stores_of_other_versions_are_told_apart_from_folders_that_are_no_stores(
    sweep: Sweep, finished: Path, tmp_path: Path
) -> None:
    store = shutil.copytree(finished, tmp_path / "sweep.zarr")
    attributes = json.loads((store / ".zattrs").read_text())
    for layout in (None, 1000):
        (store / ".zattrs").write_text(json.dumps({**attributes, "layout": layout}))
        for repair in (False, True):
            shutil.rmtree(store / "checksums", ignore_errors=True)
            before = contents(store)
            with pytest.raises(HitchError, match=r"sweep\.zarr was made by another version of hitch"):
                sweep.run(store, repair=repair)
            assert contents(store) == before
    foreign = tmp_path / "foreign.zarr"
    for text in ("[]", "{}", '{"sweep": 1}', "{"):
        foreign.mkdir(exist_ok=True)
        (foreign / ".zattrs").write_text(text)
        with pytest.raises(HitchError, match=r"foreign\.zarr is there and holds no sweep"):
            sweep.run(foreign, repair=True)
    (tmp_path / "file.zarr").write_text("")
    with pytest.raises(HitchError, match=r"file\.zarr is there and holds no sweep"):
        sweep.run(tmp_path / "file.zarr")


@contextmanager
def powerless() -> Iterator[None]:
    """Not as root, whom no permission stops."""
    root = os.geteuid() == 0
    if root:
        os.seteuid(65534)
    try:
        yield
    finally:
        if root:
            os.seteuid(0)


@pytest.mark.skipif(not hasattr(os, "seteuid"), reason="no permissions as POSIX has them")
@pytest.mark.parametrize("place", [".", "peak_jerk", "peak_jerk/1", "checksums", "checksums/1", "C/0", ".zattrs", ".."])
def test_what_may_not_be_read_or_written_is_told(place: str, sweep: Sweep, finished: Path) -> None:
    with tempfile.TemporaryDirectory() as open_to_all:
        folder = Path(open_to_all) / "folder"
        store = shutil.copytree(finished, folder / "sweep.zarr")
        for path in (Path(open_to_all), *Path(open_to_all).rglob("*")):
            path.chmod(0o777)
        target = (store / place).resolve()
        target.chmod(0o555 if place == ".." else 0)
        with powerless(), pytest.raises(HitchError, match=r"cannot read or write .*sweep\.zarr: Permission denied"):
            sweep.run(store)
        target.chmod(0o777)
        sweep.run(store)
        assert sweep.ran == []


def test_a_chunk_that_can_not_be_written_stops_a_sweep_that_then_goes_on(
    sweep: Sweep, finished: Path, tmp_path: Path
) -> None:
    store = tmp_path / "sweep.zarr"
    sweep.run(store, most=0)
    for obstacle in (store / "peak_jerk" / "1", store / "checksums" / "1"):
        obstacle.mkdir(parents=True)
        with pytest.raises(HitchError, match=r"cannot write .*; 1 of 3 runs are in it, and the same command goes on"):
            sweep.run(store)
        obstacle.rmdir()
    sweep.run(store)
    assert sweep.ran == [1, 2]
    assert contents(store) == contents(finished)


@contextmanager
def small_disk(folder: Path, kilobytes: int) -> Iterator[None]:
    """A file system of its own at `folder`. Skips a test where mounting is not allowed."""
    folder.mkdir()
    command = ["mount", "-t", "tmpfs", "-o", f"size={kilobytes}k", "none", str(folder)]
    if not shutil.which("mount") or subprocess.run(command, capture_output=True, check=False).returncode != 0:
        pytest.skip("no file system can be mounted")
    try:
        yield
    finally:
        subprocess.run(["umount", str(folder)], check=True)


def test_a_disk_that_is_full_in_mid_sweep(sweep: Sweep, finished: Path, tmp_path: Path) -> None:
    disk, store, ballast = tmp_path / "disk", tmp_path / "disk" / "sweep.zarr", tmp_path / "disk" / "ballast"
    with small_disk(disk, 1024):
        sweep.run(store, most=1)
        before = contents(store)
        with suppress(OSError), ballast.open("wb", buffering=0) as file:
            while file.write(bytes(4096)):
                pass
        with pytest.raises(HitchError) as told:
            sweep.run(store)
        assert str(told.value).startswith(f"cannot write {store}: No space left on device; 1 of 3 runs are in it, and ")
        assert {name: contents(store)[name] for name in before if batch_of(name) == "0"} == {
            name: before[name] for name in before if batch_of(name) == "0"
        }
        assert (read_sweep(store)["status"].values != MISSING).tolist() == [True, False, False]
        ballast.unlink()
        sweep.run(store)
        assert sweep.ran == [1, 2]
        assert contents(store) == contents(finished)
