"""What is kept from build to build: believed only if whole, ours and made of the same; no build fails for it."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from fmu_build import cache
from fmu_build.cache import Part, kept


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv(cache.SETTING, str(tmp_path / "kept" / "here"))
    return tmp_path / "kept" / "here"


def of(*parts: Part) -> Callable[[], Iterator[Part]]:
    return lambda: iter(parts)


def is_kept(*parts: Part) -> bool:
    """Whether something made of the parts is there; else it is now."""
    made: list[bytes] = []
    kept(of(*parts), lambda: made.append(b"") or b"new")  # type: ignore[func-returns-value]
    return not made


def entries(folder: Path) -> list[Path]:
    return sorted(folder.iterdir()) if folder.is_dir() else []


def test_equal_parts_have_one_content(folder: Path, tmp_path: Path) -> None:
    file, other = tmp_path / "a", tmp_path / "b"
    for path in (file, other):
        path.write_text("a")
    different: list[tuple[Part, ...]] = [
        (), ("a",), ("a", ""), ("", "a"), ("a", "b"), ("ab",), ("b", "a"), (str(file),), (file,), (other,),
        (str(file), "a"), (file, other), ("\udcff",),
    ]  # fmt: skip
    assert not any(is_kept(*parts) for parts in different)
    assert all(is_kept(*parts) for parts in different)
    file.write_text("b")
    assert not is_kept(file) and is_kept(other)
    assert len(entries(folder)) == len(different) + 1 and folder.stat().st_mode & 0o077 == 0


@pytest.mark.parametrize("content", [b"", b"four"])
def test_what_is_damaged_is_made_again(folder: Path, content: bytes) -> None:
    assert kept(of("a"), lambda: content) == content
    (entry,) = entries(folder)
    whole = entry.read_bytes()
    wrong = [whole[:n] + bytes([whole[n] ^ 1]) + whole[n + 1 :] for n in range(len(whole))]
    wrong += [whole[:n] for n in range(len(whole))] + [whole + b"\0"]
    for bad in wrong:
        entry.write_bytes(bad)
        assert kept(of("a"), lambda: content) == content
        assert entry.read_bytes() == whole
    kept(of("b"), lambda: b"another")
    (other,) = set(entries(folder)) - {entry}
    entry.write_bytes(other.read_bytes())  # whole, but made of other parts
    assert kept(of("a"), lambda: content) == content


@pytest.mark.skipif(not hasattr(os, "geteuid"), reason="whose a folder is, is told otherwise on Windows")
def test_a_folder_that_others_can_write_to_is_not_used(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert not is_kept("a") and is_kept("a")
    for mode in (0o777, 0o720):
        folder.chmod(mode)
        assert not is_kept("a") and not is_kept("b")
    folder.chmod(0o755)
    assert is_kept("a") and len(entries(folder)) == 1
    monkeypatch.setattr(os, "geteuid", lambda: folder.stat().st_uid + 1)
    assert not is_kept("a") and not is_kept("b")


def test_it_can_be_switched_off(folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(cache.SETTING, "")
    monkeypatch.chdir(tmp_path)
    assert not is_kept("a") and not is_kept("a")
    monkeypatch.delenv(cache.SETTING)
    monkeypatch.setattr(cache, "user_cache_path", lambda _: Path("~/cache"))  # of a user who has no home
    assert not is_kept("a") and not is_kept("a") and list(tmp_path.iterdir()) == []


def test_no_build_fails_for_it(folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Parts that cannot be read, a folder that is a file, a disk that is full."""
    assert not is_kept(tmp_path / "gone") and not is_kept(tmp_path / "gone") and entries(folder) == []
    folder.parent.mkdir(exist_ok=True)
    folder.touch()
    assert not is_kept("a") and not is_kept("a")
    folder.unlink()

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(os, "replace", full)
        assert not is_kept("a") and entries(folder) == []
    assert not is_kept("a") and is_kept("a")


def test_what_changes_meanwhile_is_not_kept(folder: Path, tmp_path: Path) -> None:
    file = tmp_path / "a"
    file.write_text("old")

    def make() -> bytes:
        file.write_text("new")
        return b"of one or the other"

    assert kept(of(file), make) == b"of one or the other"
    assert entries(folder) == []


def test_what_has_been_read_is_read_again_when_it_changes(folder: Path, tmp_path: Path) -> None:
    """Old or new, of the same size and with the same time of modification, in its place or moved there."""
    file, other = tmp_path / "a", tmp_path / "b"
    for text in ("1", "2", "3"):
        file.write_text(text)
        os.utime(file, (1e9, 1e9))
        assert not is_kept(file) and is_kept(file)
    other.write_text("4")
    os.utime(other, (1e9, 1e9))
    other.replace(file)
    assert not is_kept(file) and is_kept(file)


def test_what_has_not_changed_is_read_once(folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file, read = tmp_path / "a", []
    file.write_text("1")
    digest = cache._content_digest
    monkeypatch.setattr(cache, "_content_digest", lambda path: read.append(path) or digest(path))
    monkeypatch.setattr(cache, "SETTLED", 0)  # as if it had been written a while ago
    assert not is_kept(file) and is_kept(file) and is_kept(file, "with another") is False
    assert read == [file]
    file.write_text("12")
    assert not is_kept(file) and len(read) == 2


def test_what_ends_early_leaves_nothing(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(*_: object) -> bytes:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        kept(of("a"), interrupted)
    assert entries(folder) == []
    monkeypatch.setattr(os, "replace", interrupted)
    with pytest.raises(KeyboardInterrupt):
        kept(of("a"), lambda: b"a")
    assert entries(folder) == []


def test_what_was_used_last_stays(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    kept(of("a"), lambda: bytes(1000))
    for name, age in (("new-killed", 90000.0), ("new-busy", 10.0), ("somebody's.txt", 90000.0)):
        (folder / name).touch()
        os.utime(folder / name, (time.time() - age,) * 2)
    monkeypatch.setattr(cache, "LARGEST", 3000)
    for text in "bcde":
        for age, path in enumerate(sorted(entries(folder), key=lambda path: path.stat().st_mtime, reverse=True)):
            if len(path.name) == 64:
                os.utime(path, (time.time() - 1.0 - age,) * 2)
        assert is_kept("a")  # and used
        kept(of(text), lambda: bytes(1000))
    assert [is_kept(text) for text in "aedcb"] == [True, True, False, False, False]
    assert {path.name for path in entries(folder) if len(path.name) < 64} == {"new-busy", "somebody's.txt"}


def test_many_at_once_get_one_whole_content(folder: Path) -> None:
    def build(number: int) -> bytes:
        return kept(of("a"), lambda: bytes([number]) * 100_000)

    with ThreadPoolExecutor(8) as pool:
        found = list(pool.map(build, range(32)))
    assert all(content == content[:1] * 100_000 for content in found)
    assert len(entries(folder)) == 1 and is_kept("a")
