"""The store in ordinary use, and where its file is."""

import contextlib
import sqlite3
from pathlib import Path

import pytest
from hypothesis import given, settings, strategies as st

from disting.errors import InputError
from disting.store.store import APPLICATION_ID, SCHEMA_VERSION, Store
from tests.store.store_tools import TEN, aside, cache_warnings, keeps_nothing, overwrite, works
from tests.store.store_worker import items, key


def test_values_come_back_and_survive_reopening(path: Path) -> None:
    with Store.open(path) as store:
        assert store.get_many(TEN) == {}
        store.put_many(TEN)
        assert store.get_many([*TEN, *TEN, key(99)]) == TEN
    with Store.open(str(path)) as store:
        assert store.get_many(iter(TEN)) == TEN


def test_a_later_value_replaces_the_earlier(path: Path) -> None:
    with Store.open(path) as store:
        store.put_many({key(1): "1", key(2): "2"})
        store.put_many({key(1): "3"})
        assert store.get_many([key(1), key(2)]) == {key(1): "3", key(2): "2"}


@pytest.mark.full
@settings(max_examples=40, deadline=None)
@given(st.dictionaries(st.text(max_size=70), st.text(), max_size=6))
def test_every_text_comes_back(texts: dict[str, str]) -> None:
    with Store.open(":memory:") as store:
        store.put_many(texts)
        assert store.get_many(texts) == texts
        assert store.info().entries == len(texts)


@pytest.mark.full
def test_large_and_strange_values_come_back_from_disk(path: Path) -> None:
    texts = {
        "empty": "",
        "nul": "a\0b",
        "large": "é" * 3_000_000,
        "\0": "\U0010ffff",
        "": "key of length 0",
    }
    with Store.open(path) as store:
        store.put_many(texts)
    with Store.open(path) as store:
        assert store.get_many(texts) == texts


def test_text_that_is_not_unicode_is_refused_and_nothing_is_written(path: Path) -> None:
    with Store.open(path) as store:
        with pytest.raises(UnicodeEncodeError):
            store.put_many({"a": "sound", "b": "\ud800"})
        assert store.info().entries == 0


def test_info_and_clear(path: Path) -> None:
    with Store.open(path) as store:
        store.put_many(items(range(500)))
        info = store.info()
        assert (info.path, info.entries, info.schema_version) == (str(path), 500, SCHEMA_VERSION)
        assert info.sqlite_version == sqlite3.sqlite_version
        assert sum(map(len, items(range(500)).values())) < info.bytes < 2_000_000
        assert (store.clear(), store.clear()) == (500, 0)
        assert store.get_many(items(range(500))) == {}
        assert store.info().bytes < 20_000
        assert works(store)
    assert path.stat().st_size < 40_000


def test_the_file_is_stamped_as_ours_and_uses_a_write_ahead_log(filled: Path) -> None:
    with contextlib.closing(sqlite3.connect(filled)) as connection:
        assert connection.execute("PRAGMA application_id").fetchone() == (APPLICATION_ID,)
        assert connection.execute("PRAGMA user_version").fetchone() == (SCHEMA_VERSION,)
        assert connection.execute("PRAGMA journal_mode").fetchone() == ("wal",)


def test_a_closed_store_keeps_nothing(path: Path) -> None:
    store = Store.open(path)
    store.put_many(TEN)
    store.close()
    store.close()
    assert keeps_nothing(store)
    assert not path.with_name(path.name + "-wal").exists()


def test_without_variable_the_cache_is_in_the_users_cache_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("DISTING_CACHE", raising=False)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "new" / "folder"))
    monkeypatch.setenv("HOME", str(tmp_path))
    with Store.open() as store:
        store.put_many(TEN)
        place = Path(store.info().path)
    assert place.parts[-2:] == ("disting", "cache.sqlite3")
    assert place.is_file() and place.is_relative_to(tmp_path)


def test_the_variable_names_a_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HOME", str(tmp_path))
    for text, place in ((f"{tmp_path}/a/b?c#%41.db", "a/b?c#%41.db"), ("~/d.db", "d.db")):
        (tmp_path / place).parent.mkdir(exist_ok=True)
        monkeypatch.setenv("DISTING_CACHE", text)
        with Store.open() as store:
            assert works(store)
        assert (tmp_path / place).is_file()
    with Store.open(tmp_path / "e.db") as store:  # an argument has precedence
        assert store.info().path == str(tmp_path / "e.db")


REFUSED = [
    "0",
    "1",
    "no",
    "none",
    "false",
    "cache",
    "0.5",
    "off.",
    "file:x.db?mode=memory",
    "file:x",
]
REFUSED += [
    "sqlite:///x.db",
    "missing/a.db",
    "folder",
    "folder/",
    "./folder",
    "/dev/null",
    "~nobody/x",
]


@pytest.mark.thin(8)
@pytest.mark.parametrize("text", REFUSED)
def test_the_variable_is_refused_where_it_names_no_file(
    text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "folder").mkdir()
    monkeypatch.setenv("DISTING_CACHE", text)
    with pytest.raises(InputError, match="off, :memory:, or a file in an existing folder"):
        Store.open()
    assert [p.name for p in tmp_path.rglob("*")] == ["folder"]


@pytest.mark.parametrize("text", ["cache.sqlite3", "./cache", "folder/cache", " b.db"])
def test_a_file_is_named_by_an_ending_or_a_folder(
    text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "folder").mkdir()
    monkeypatch.setenv("DISTING_CACHE", text)
    with Store.open() as store:
        assert store.info().path == str((tmp_path / text).resolve())


@pytest.mark.parametrize("text", ["", " ", "off", "OFF ", " Off"])
def test_the_variable_can_say_no_cache(
    text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("DISTING_CACHE", text)
    with cache_warnings(0):
        for store in (Store.open(), Store.open(text), Store.none()):
            assert keeps_nothing(store)
            assert store.info().path == ""
    assert list(tmp_path.iterdir()) == []


def test_a_cache_in_memory_is_private_and_leaves_no_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("DISTING_CACHE", " :Memory: ")
    with Store.open() as store, Store.open(":memory:") as other:
        store.put_many(TEN)
        assert (store.get_many(TEN), other.get_many(TEN)) == (TEN, {})
        assert store.info().path == ":memory:"
    assert list(tmp_path.iterdir()) == []


def test_symbolic_links_lead_to_one_cache(filled: Path, tmp_path: Path) -> None:
    (tmp_path / "folder").mkdir()
    link = tmp_path / "folder" / "link"
    link.symlink_to(filled)
    overwrite(filled, 0, b"\0" * 100)
    with cache_warnings(1), Store.open(link) as store:
        assert store.info().path == str(filled)
    assert link.is_symlink() and aside(filled) == [f"{filled.name}.damaged-1"]
