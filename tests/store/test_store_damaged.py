"""The store against real damage: nothing false is ever read, and what is sound is kept."""

import random
import shutil
import warnings
from collections.abc import Callable
from pathlib import Path

import pytest

from disting.store.store import SCHEMA, SCHEMA_VERSION, CacheWarning, Store
from tests.store.store_tools import (
    TEN,
    alter,
    aside,
    cache_warnings,
    finish,
    first_line,
    keeps_nothing,
    overwrite,
    start,
    works,
)
from tests.store.store_worker import items, key, value


def random_bytes(path: Path) -> None:
    path.write_bytes(random.Random(1).randbytes(50_000))


def header_only(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:100])


def cut_in_half(path: Path) -> None:
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])


def cut_by_a_page(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:-4096])


def emptied(path: Path) -> None:
    path.write_bytes(b"")


def foreign_database(path: Path) -> None:
    path.unlink()
    alter(
        path,
        "CREATE TABLE entry (key, checksum, value)",
        "INSERT INTO entry VALUES ('a', 'b', 'c')",
    )


def foreign_stamp(path: Path) -> None:
    alter(path, "PRAGMA application_id = 7")


def older_schema(path: Path) -> None:
    alter(path, f"PRAGMA user_version = {SCHEMA_VERSION - 1}")


def newer_schema(path: Path) -> None:
    alter(path, f"PRAGMA user_version = {SCHEMA_VERSION + 1}")


def other_table(path: Path) -> None:
    alter(path, "DROP TABLE entry", SCHEMA.replace("value BLOB", "value TEXT"))


def with_a_trigger(path: Path) -> None:
    alter(path, "CREATE TRIGGER t AFTER INSERT ON entry BEGIN DELETE FROM entry; END")


def broken_definition(path: Path) -> None:
    content = path.read_bytes()
    path.write_bytes(content.replace(b"CREATE TABLE entry", b"CREATE TABLE \xff\xfe\xfdry"))


def undecodable_definition(path: Path) -> None:
    path.write_bytes(path.read_bytes().replace(b"PRIMARY KEY", b"PRIMARY \xa6EY"))


def a_folder(path: Path) -> None:
    path.unlink()
    path.mkdir()


DAMAGES = [
    random_bytes, header_only, cut_in_half, cut_by_a_page, emptied, foreign_database, foreign_stamp,
    older_schema, newer_schema, other_table, with_a_trigger, broken_definition,
    undecodable_definition, a_folder,
]  # fmt: skip


@pytest.mark.thin(1)
@pytest.mark.parametrize("damage", DAMAGES)
def test_a_file_that_cannot_be_trusted_is_set_aside(
    damage: Callable[[Path], None], filled: Path
) -> None:
    damage(filled)
    before = filled.read_bytes() if filled.is_file() else b""
    with cache_warnings(1) as messages:
        store = Store.open(filled)
        assert store.get_many(items(range(300))) == {}
    assert "damaged-1" in messages[0] and str(filled) in messages[0]
    assert works(store)
    kept = filled.with_name(f"{filled.name}.damaged-1")
    assert kept.is_dir() if damage is a_folder else kept.read_bytes() == before
    store.close()
    with cache_warnings(0), Store.open(filled) as store:
        assert store.info().entries == 10


def test_damaged_files_are_numbered(path: Path) -> None:
    Store.open(path).close()
    for _ in range(3):
        path.write_bytes(b"no database")
        with cache_warnings(1):
            Store.open(path).close()
    assert aside(path) == [f"{path.name}.damaged-{number}" for number in (1, 2, 3)]


def test_the_number_of_damaged_files_is_bounded(filled: Path) -> None:
    for number in range(1, 100):
        filled.with_name(f"{filled.name}.damaged-{number}-wal").touch()
    random_bytes(filled)
    with cache_warnings(1) as messages:
        store = Store.open(filled)
    assert "remove some" in messages[0] and filled.stat().st_size == 50_000
    assert keeps_nothing(store)


def test_side_files_go_with_the_damaged_file(filled: Path) -> None:
    wal, copy = filled.with_name(f"{filled.name}-wal"), filled.with_name("copy")
    with Store.open(filled) as store:
        store.put_many(TEN)
        shutil.copy(wal, copy)
    copy.rename(wal)
    random_bytes(filled)
    content = wal.read_bytes()
    with cache_warnings(1), Store.open(filled) as store:
        assert store.info().entries == 0
    assert filled.with_name(f"{filled.name}.damaged-1-wal").read_bytes() == content


def test_a_log_without_its_database_is_not_replayed(filled: Path) -> None:
    wal, copy = filled.with_name(f"{filled.name}-wal"), filled.with_name("copy")
    with Store.open(filled) as store:
        store.put_many(items(range(300, 400)))
        shutil.copy(wal, copy)
    filled.unlink()
    copy.rename(wal)
    with cache_warnings(0), Store.open(filled) as store:
        assert store.info().entries == 0
        assert works(store)
    assert {item.name for item in filled.parent.iterdir()} == {filled.name, filled.name + ".lock"}


def test_pages_that_turn_out_damaged_while_reading(filled: Path) -> None:
    size = filled.stat().st_size
    overwrite(filled, 4096, random.Random(2).randbytes(size - 4096))
    with cache_warnings(0):
        store = Store.open(filled)
    with cache_warnings(1):
        assert store.get_many(TEN) == {}
    assert works(store)
    assert aside(filled) == [f"{filled.name}.damaged-1"]


def test_a_header_that_falsely_says_read_only(filled: Path) -> None:
    overwrite(filled, 18, b"\x03")  # a write version that SQLite does not know
    with cache_warnings(1), Store.open(filled) as store:
        store.put_many(TEN)
        assert store.get_many(items(range(300))) == TEN
    assert aside(filled) == [f"{filled.name}.damaged-1"]


def test_pages_that_turn_out_damaged_while_writing(filled: Path) -> None:
    size = filled.stat().st_size
    overwrite(filled, 4096, random.Random(2).randbytes(size - 4096))
    with cache_warnings(1), Store.open(filled) as store:
        store.put_many(TEN)
        assert store.get_many(items(range(300))) == TEN


def test_a_table_dropped_under_an_open_store(filled: Path) -> None:
    with Store.open(filled) as store:
        assert store.get_many(TEN) == TEN
        alter(filled, "DROP TABLE entry")
        with cache_warnings(1):
            store.put_many(TEN)
        assert store.get_many(items(range(300))) == TEN


def test_a_file_removed_under_an_open_store(filled: Path) -> None:
    with cache_warnings(0), Store.open(filled) as store, Store.open(filled) as other:
        assert store.get_many(TEN) == other.get_many(TEN) == TEN
        filled.unlink()
        store.put_many({key(1): "1"})
        assert other.get_many(TEN) == {key(1): "1"}


@pytest.mark.thin(1)
@pytest.mark.sampled(9)
@pytest.mark.parametrize("seed", range(45))
def test_no_flipped_bit_ever_gives_a_wrong_value(seed: int, filled: Path) -> None:
    """A third of the bits are in the header and the first page, where they do the most harm."""
    chance, right = random.Random(seed), items(range(300))
    content = bytearray(filled.read_bytes())
    offset = chance.randrange((100, 4096, len(content))[seed % 3])
    content[offset] ^= 1 << chance.randrange(8)
    filled.write_bytes(content)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", CacheWarning)
        with Store.open(filled) as store:
            assert store.get_many(right).items() <= right.items()
            store.put_many(right)
            assert store.get_many(right).items() <= right.items()


def test_a_flipped_bit_in_a_value_costs_this_value_only(filled: Path) -> None:
    content = filled.read_bytes()
    offset = content.index(b'{"number": 137,') + 12
    overwrite(filled, offset, bytes([content[offset] ^ 1]))  # number 127 instead of 137
    right = items(range(300))
    with Store.open(filled) as store:
        with cache_warnings(1) as messages:
            assert store.get_many(right) == {k: v for k, v in right.items() if k != key(137)}
        assert "1 damaged" in messages[0]
        assert store.info().entries == 299
        store.put_many({key(137): value(137)})
        with cache_warnings(0):
            assert store.get_many(right) == right


def test_a_cut_within_the_last_page_costs_the_entries_there_only(filled: Path) -> None:
    filled.write_bytes(filled.read_bytes()[:-1000])
    right = items(range(300))
    with cache_warnings(1), Store.open(filled) as store:
        found = store.get_many(right)
        assert 290 < len(found) < 300 and found.items() <= right.items()
        store.put_many(right)
        assert store.get_many(right) == right


@pytest.mark.thin(1)
@pytest.mark.parametrize(
    "change",
    [
        "value = CAST(replace(CAST(value AS TEXT), 'number', 'nomber') AS BLOB)",
        "value = 12",
        "value = 1.5",
        "value = 'text'",
        "value = CAST(x'ff' AS TEXT)",
        "value = x''",
        "checksum = 'text'",
        "checksum = 3",
        "checksum = x''",
        (
            f"(checksum, value) = (SELECT checksum, value FROM entry WHERE key = CAST('{key(2)}' AS"
            " BLOB))"
        ),
    ],
)
def test_a_row_altered_by_other_means_is_absent_and_removed(change: str, filled: Path) -> None:
    alter(filled, f"UPDATE entry SET {change} WHERE key = CAST('{key(1)}' AS BLOB)")
    rest = {k: v for k, v in TEN.items() if k != key(1)}
    with Store.open(filled) as store:
        with cache_warnings(1):
            assert store.get_many(TEN) == rest
        with cache_warnings(0):
            assert store.get_many(TEN) == rest
        assert store.info().entries == 299
    assert aside(filled) == []


@pytest.mark.full
@pytest.mark.parametrize("damage", [random_bytes, older_schema, emptied])
def test_processes_that_find_the_same_damage_set_it_aside_once(
    damage: Callable[[Path], None], filled: Path
) -> None:
    damage(filled)
    workers = [start("meet", filled, number) for number in range(3)]
    assert [first_line(worker) for worker in workers] == ["ready\n"] * 3
    for worker in workers:
        assert worker.stdin is not None
        worker.stdin.write(b"go\n")
    lines = [finish(worker) for worker in workers]
    assert [line[0] for line in lines] == ["kept True"] * 3
    assert sorted(line[1] for line in lines) == ["warnings 0"] * 2 + ["warnings 1"]
    assert aside(filled) == [f"{filled.name}.damaged-1"]
    with cache_warnings(0), Store.open(filled) as store:
        assert store.get_many(items(range(300))) == items(range(3))


def test_two_stores_that_find_damage_one_after_the_other_keep_the_new_file(filled: Path) -> None:
    with Store.open(filled) as first, Store.open(filled) as second:
        assert first.get_many(TEN) == second.get_many(TEN) == TEN
        alter(filled, "DROP TABLE entry")
        with cache_warnings(1):
            first.put_many(items(range(3)))
            second.put_many(items(range(3, 6)))
        assert first.get_many(TEN) == second.get_many(TEN) == items(range(6))
