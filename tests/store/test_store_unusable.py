"""Caches that cannot be used: without permission, on a full disk, where no file can be."""

import contextlib
import os
import sqlite3
import stat
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from disting.store.store import Store
from tests.store.store_tools import TEN, aside, cache_warnings, finish, keeps_nothing, start, works
from tests.store.store_worker import items


def below_a_file(tmp_path: Path) -> Path:
    (tmp_path / "file").write_text("not a folder")
    return tmp_path / "file" / "cache.sqlite3"


def in_proc(tmp_path: Path) -> Path:
    return Path("/proc/no-such-folder/cache.sqlite3")


def a_pipe(tmp_path: Path) -> Path:
    os.mkfifo(tmp_path / "pipe")
    return tmp_path / "pipe"


def a_device(tmp_path: Path) -> Path:
    try:
        os.mknod(tmp_path / "null", 0o666 | stat.S_IFCHR, os.makedev(1, 3))
    except PermissionError:
        pytest.skip("only root can make devices")
    return tmp_path / "null"


def a_folder_in_use(tmp_path: Path) -> Path:
    (tmp_path / "folder").mkdir()
    (tmp_path / "folder" / "thesis.tex").write_text("precious")
    return tmp_path / "folder"


def a_text(tmp_path: Path) -> Path:
    (tmp_path / "thesis.tex").write_text("precious" * 1000)
    return tmp_path / "thesis.tex"


def an_empty_folder(tmp_path: Path) -> Path:
    (tmp_path / "folder").mkdir()
    return tmp_path / "folder"


def another_database(tmp_path: Path) -> Path:
    with contextlib.closing(sqlite3.connect(tmp_path / "bookmarks.sqlite")) as connection:
        connection.execute("PRAGMA application_id = 7")
        connection.execute("CREATE TABLE entry (key, checksum, value)")
        connection.execute("INSERT INTO entry VALUES ('a', 'b', 'c')")
        connection.commit()
    return tmp_path / "bookmarks.sqlite"


def a_name_too_long(tmp_path: Path) -> Path:
    return tmp_path / ("x" * 300)


PLACES = [
    below_a_file, in_proc, a_pipe, a_device, a_folder_in_use, a_name_too_long, a_text, an_empty_folder, another_database,
]  # fmt: skip


@pytest.mark.parametrize("place", PLACES)
def test_a_cache_that_cannot_be_made_is_done_without(
    place: Callable[[Path], Path], tmp_path: Path
) -> None:
    path = place(tmp_path)
    before = contents(tmp_path)
    with cache_warnings(1) as messages, Store.open(path) as store:
        store.put_many(TEN)
        assert store.get_many(TEN) == {}
    assert "going on without cache" in messages[0]
    assert keeps_nothing(store)
    assert contents(tmp_path) == before


def contents(folder: Path) -> dict[Path, bytes]:
    return {p: p.read_bytes() if p.is_file() else b"" for p in folder.rglob("*")}


@pytest.fixture
def public() -> Iterator[Path]:
    """A folder that other users can reach, unlike those of pytest."""
    with tempfile.TemporaryDirectory() as name:
        os.chmod(name, 0o755)
        yield Path(name)


@pytest.mark.full
def test_a_folder_without_permission_is_done_without(public: Path) -> None:
    os.chmod(public, 0o555)
    assert finish(start("nobody", public / "cache.sqlite3")) == ["found 0", "warnings 1"]
    assert list(public.iterdir()) == []


@pytest.mark.full
def test_a_file_without_permission_to_write_is_left_as_it_is(public: Path) -> None:
    path = public / "cache.sqlite3"
    with Store.open(path) as store:
        store.put_many(TEN)
    os.chmod(path, 0o444)
    os.chmod(public, 0o555)
    before = path.read_bytes()
    assert finish(start("nobody", path)) == ["found 0", "warnings 1"]
    assert path.read_bytes() == before


@pytest.mark.full
@pytest.mark.parametrize("size", [0, 5_000, 60_000])
def test_a_full_disk_is_done_without(size: int, path: Path) -> None:
    assert finish(start("limited", path, size)) == ["found 0", "warnings 1"]
    with cache_warnings(0), Store.open(path) as store:
        assert store.info().entries == 0
        assert works(store)


@pytest.mark.full
def test_a_full_disk_costs_nothing_that_was_there(filled: Path) -> None:
    assert finish(start("limited", filled, 60_000)) == ["found 0", "warnings 1"]
    with cache_warnings(0), Store.open(filled) as store:
        assert store.get_many(items(range(300))) == items(range(300))
    assert aside(filled) == []
