"""The store against real files, real damage and real processes."""

import contextlib
import gc
import os
import random
import shutil
import signal
import sqlite3
import stat
import subprocess
import sys
import tempfile
import threading
import time
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

sys.path.insert(0, str(Path(__file__).parent))
from store_worker import items, key, value

from disting.engine.database_file import APPLICATION_ID, SCHEMA, SCHEMA_VERSION
from disting.engine.store import CacheWarning, Store

WORKER = Path(__file__).with_name("store_worker.py")
ROOT = Path(__file__).parents[2]
TEN = items(range(10))


def start(*arguments: object) -> subprocess.Popen[bytes]:
    """A worker process; see store_worker.py for the tasks."""
    return subprocess.Popen(
        [sys.executable, str(WORKER), *map(str, arguments)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        bufsize=0,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )


def first_line(process: subprocess.Popen[bytes]) -> str:
    """Read unbuffered, so that the lines after it are left for finish or stop."""
    assert process.stdout is not None
    return process.stdout.readline().decode()


def finish(process: subprocess.Popen[bytes]) -> list[str]:
    """The lines a worker printed; it must end well and print no traceback."""
    output, errors = process.communicate(timeout=60)
    assert (process.returncode, errors) == (0, b"")
    return output.decode().splitlines()


def stop(process: subprocess.Popen[bytes]) -> list[str]:
    """Kill a worker at once; the lines it had printed."""
    process.send_signal(signal.SIGKILL)
    output, errors = process.communicate(timeout=60)
    assert (process.returncode, errors) == (-signal.SIGKILL, b"")
    return output.decode().splitlines()


@contextlib.contextmanager
def cache_warnings(number: int) -> Iterator[list[str]]:
    """Exactly this many cache warnings, and no other warning, arise in the block."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        messages: list[str] = []
        yield messages
        messages.extend(str(item.message) for item in caught)
    assert [item.category for item in caught] == [CacheWarning] * number, messages


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """Where a cache may be made."""
    return tmp_path / "cache.sqlite3"


@pytest.fixture
def filled(path: Path) -> Path:
    """A closed cache of 300 entries, about 350 kB."""
    with cache_warnings(0), Store.open(path) as store:
        store.put_many(items(range(300)))
    return path


def aside(path: Path) -> list[str]:
    """Names of the main files that were set aside."""
    return sorted(p.name for p in path.parent.glob("*.damaged-*") if p.name[-1].isdigit())


def alter(path: Path, *statements: str) -> None:
    """Change a database behind the store's back."""
    with contextlib.closing(sqlite3.connect(path, isolation_level=None)) as connection:
        for statement in statements:
            connection.execute(statement)


def overwrite(path: Path, offset: int, content: bytes) -> None:
    with path.open("r+b") as file:
        file.seek(offset)
        file.write(content)


def works(store: Store) -> bool:
    """Whether new entries can be written and read, without any warning."""
    with cache_warnings(0):
        store.put_many(items(range(1000, 1010)))
        return store.get_many(items(range(1000, 1010))) == items(range(1000, 1010))


def keeps_nothing(store: Store) -> bool:
    """Whether the store is without cache, silently."""
    with cache_warnings(0):
        store.put_many(TEN)
        return (store.get_many(TEN), store.info().entries, store.clear()) == ({}, 0, 0)


# Ordinary use


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


@settings(max_examples=100, deadline=None)
@given(st.dictionaries(st.text(max_size=70), st.text(), max_size=6))
def test_every_text_comes_back(texts: dict[str, str]) -> None:
    with Store.open(":memory:") as store:
        store.put_many(texts)
        assert store.get_many(texts) == texts
        assert store.info().entries == len(texts)


def test_large_and_strange_values_come_back_from_disk(path: Path) -> None:
    texts = {"empty": "", "nul": "a\0b", "large": "é" * 3_000_000, "\0": "\U0010ffff", "": "key of length 0"}
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


def test_a_present_key_is_read_in_far_less_than_a_fifth_of_a_millisecond(filled: Path) -> None:
    def seconds(number: int) -> float:
        begin = time.perf_counter()
        store.get_many((key(number),))
        return time.perf_counter() - begin

    with Store.open(filled) as store:
        assert sorted(seconds(number) for number in range(300))[150] < 0.2e-3


def test_a_closed_store_keeps_nothing(path: Path) -> None:
    store = Store.open(path)
    store.put_many(TEN)
    store.close()
    store.close()
    assert keeps_nothing(store)
    assert not path.with_name(path.name + "-wal").exists()


# Where the cache is


def test_without_variable_the_cache_is_in_the_users_cache_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
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
        monkeypatch.setenv("DISTING_CACHE", text)
        with Store.open() as store:
            assert works(store)
        assert (tmp_path / place).is_file()
    with Store.open(tmp_path / "e.db") as store:  # an argument has precedence
        assert store.info().path == str(tmp_path / "e.db")


@pytest.mark.parametrize("text", ["", "off"])
def test_the_variable_can_say_no_cache(text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("DISTING_CACHE", text)
    with cache_warnings(0):
        for store in (Store.open(), Store.open(text), Store.none()):
            assert keeps_nothing(store)
            assert store.info().path == ""
    assert list(tmp_path.iterdir()) == []


def test_a_cache_in_memory_is_private_and_leaves_no_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("DISTING_CACHE", ":memory:")
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


# Many processes, threads and forks


@pytest.mark.parametrize("journal", ["wal", "delete"])
def test_many_processes_share_the_same_keys(journal: str, path: Path) -> None:
    if journal == "delete":  # as it is where a write-ahead log is impossible
        Store.open(path).close()
        alter(path, "PRAGMA journal_mode = DELETE")
    workers = [start("share", path, seed, 60) for seed in range(6)]
    assert [finish(worker) for worker in workers] == [["wrong 0", "warnings 0"]] * 6
    with cache_warnings(0), Store.open(path) as store:
        found = store.get_many(items(range(200)))
        assert len(found) > 150 and found.items() <= items(range(200)).items()
    assert aside(path) == []


def test_processes_that_keep_replacing_the_file_do_not_disturb_each_other(path: Path) -> None:
    workers = [start("churn", path, 60) for _ in range(4)]
    assert [finish(worker) for worker in workers] == [["wrong 0", "warnings 0"]] * 4
    with cache_warnings(0), Store.open(path) as store:
        assert works(store)


def test_a_write_waits_for_another_process(filled: Path) -> None:
    with Store.open(filled, wait_seconds=20) as store:
        worker = start("hold", filled, 0.5)
        assert first_line(worker) == "held\n"
        begin = time.monotonic()
        assert works(store)
        assert time.monotonic() - begin > 0.2
        worker.communicate()


def test_a_file_locked_for_too_long_is_left_alone(filled: Path) -> None:
    worker = start("hold", filled, 30)
    assert first_line(worker) == "held\n"
    with Store.open(filled, wait_seconds=0.1) as store:
        with cache_warnings(1) as messages:
            store.put_many(TEN)
        assert "going on without cache" in messages[0]
        assert keeps_nothing(store)
    stop(worker)
    with cache_warnings(0), Store.open(filled) as store:
        assert store.info().entries == 300


def join(threads: list[threading.Thread]) -> None:
    for thread in threads:
        thread.join(30)
    assert not any(thread.is_alive() for thread in threads)


def test_threads_share_a_store(path: Path) -> None:
    wrong: list[object] = []

    def work(seed: int) -> None:
        chance = random.Random(seed)
        for _ in range(60):
            some = items(range(begin := chance.randrange(100), begin + 5))
            store.put_many(some)
            if store.get_many(some) != some:
                wrong.append(some)

    with cache_warnings(0), Store.open(path) as store:
        threads = [threading.Thread(target=work, args=(seed,), daemon=True) for seed in range(8)]
        for thread in threads:
            thread.start()
        join(threads)
    assert wrong == []


def in_child(work: Callable[[], bool]) -> int:
    """Run the work in a child of fork; its process number. The exit status tells what it returned."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # threads and fork are mixed on purpose
        child = os.fork()
    if child == 0:
        status = 9
        signal.alarm(20)  # a deadlock ends as a failure
        with contextlib.suppress(BaseException):
            status = 0 if work() else 1
        os._exit(status)
    return child


def test_commits_of_a_forked_child_outlive_the_close_of_its_parent(path: Path) -> None:
    """If the child shared SQLite's state with its parent, the parent would delete the log on closing."""
    (opened, open_end), (closed, close_end) = os.pipe(), os.pipe()
    store = Store.open(path)
    store.put_many({"parent": "1"})

    def work() -> bool:
        store.put_many({"child": "2"})
        os.write(open_end, b"x")
        os.read(closed, 1)
        store.put_many({"later": "3"})
        found = store.get_many(["parent", "child", "later"])
        os.write(open_end, b"x" if len(found) == 3 else b"-")
        os.kill(os.getpid(), signal.SIGKILL)
        return True

    child = in_child(work)
    os.read(opened, 1)
    assert store.get_many(["parent"]) == {"parent": "1"}
    store.close()
    os.write(close_end, b"x")
    assert os.read(opened, 1) == b"x"
    os.waitpid(child, 0)
    with cache_warnings(0), Store.open(path) as store:
        assert store.get_many(["parent", "child", "later"]) == {"parent": "1", "child": "2", "later": "3"}


@pytest.mark.parametrize("memory", [False, True])
def test_forks_amid_the_work_of_threads(path: Path, memory: bool) -> None:
    store = Store.open(":memory:" if memory else path)
    store.put_many({"before": "1"})
    done = threading.Event()

    def work() -> None:
        number = 0
        while not done.is_set():
            store.put_many({key(number % 50): value(number % 50)})
            number += 1

    threads = [threading.Thread(target=work, daemon=True) for _ in range(3)]
    for thread in threads:
        thread.start()
    children = [in_child(lambda: works(store) and "before" in store.get_many(["before"])) for _ in range(12)]
    done.set()
    join(threads)
    assert [os.waitpid(child, 0)[1] for child in children] == [0] * 12
    assert store.get_many(["before"]) == {"before": "1"}
    assert store.get_many(items(range(50))).items() <= items(range(50)).items()
    assert len(store.get_many(items(range(1000, 1010)))) == (0 if memory else 10)
    store.close()


def test_a_forgotten_store_does_not_live_on_in_the_fork_hooks(path: Path) -> None:
    store = Store.open(path)
    del store
    gc.collect()
    assert not path.with_name(path.name + "-wal").exists()
    assert os.waitpid(in_child(lambda: True), 0)[1] == 0


# Sudden death


def test_nothing_committed_is_lost_when_the_process_is_killed_again_and_again(path: Path) -> None:
    chance, committed = random.Random(5), 0
    for _ in range(15):
        worker = start("count", path)
        first = int(first_line(worker).removeprefix("from "))
        time.sleep(chance.uniform(0, 0.03))
        lines = stop(worker)
        # One more may have been committed just before it could be printed.
        assert first in (committed, committed + 1)
        assert lines == [f"done {number}" for number in range(first, first + len(lines))]
        committed = first + len(lines)
        with cache_warnings(0), Store.open(path) as store:
            assert store.get_many(items(range(committed))) == items(range(committed))
        with contextlib.closing(sqlite3.connect(path)) as connection:
            assert connection.execute("PRAGMA integrity_check").fetchall() == [("ok",)]
    assert committed > 100
    assert aside(path) == []


def test_a_kill_while_the_file_is_made_leaves_nothing_half_made(path: Path) -> None:
    chance = random.Random(6)
    for _ in range(10):
        worker = start("create", path)
        assert first_line(worker) == "ready\n"
        time.sleep(chance.uniform(0.01, 0.06))
        stop(worker)
        with cache_warnings(0), Store.open(path) as store:
            assert store.get_many(items(range(3))).items() <= items(range(3)).items()
            assert works(store)
            store.clear()
    assert aside(path) == []
    assert {item.name for item in path.parent.iterdir()} == {path.name, path.name + ".lock"}


# Damage


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
    alter(path, "CREATE TABLE entry (key, checksum, value)", "INSERT INTO entry VALUES ('a', 'b', 'c')")


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


@pytest.mark.parametrize("damage", DAMAGES)
def test_a_file_that_cannot_be_trusted_is_set_aside(damage: Callable[[Path], None], filled: Path) -> None:
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
        f"(checksum, value) = (SELECT checksum, value FROM entry WHERE key = CAST('{key(2)}' AS BLOB))",
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


@pytest.mark.parametrize("damage", [random_bytes, older_schema, emptied])
def test_processes_that_find_the_same_damage_set_it_aside_once(damage: Callable[[Path], None], filled: Path) -> None:
    damage(filled)
    workers = [start("meet", filled, number) for number in range(4)]
    assert [first_line(worker) for worker in workers] == ["ready\n"] * 4
    for worker in workers:
        assert worker.stdin is not None
        worker.stdin.write(b"go\n")
    lines = [finish(worker) for worker in workers]
    assert [line[0] for line in lines] == ["kept True"] * 4
    assert sorted(line[1] for line in lines) == ["warnings 0"] * 3 + ["warnings 1"]
    assert aside(filled) == [f"{filled.name}.damaged-1"]
    with cache_warnings(0), Store.open(filled) as store:
        assert store.get_many(items(range(300))) == items(range(4))


def test_two_stores_that_find_damage_one_after_the_other_keep_the_new_file(filled: Path) -> None:
    with Store.open(filled) as first, Store.open(filled) as second:
        assert first.get_many(TEN) == second.get_many(TEN) == TEN
        alter(filled, "DROP TABLE entry")
        with cache_warnings(1):
            first.put_many(items(range(3)))
            second.put_many(items(range(3, 6)))
        assert first.get_many(TEN) == second.get_many(TEN) == items(range(6))


# Caches that cannot be used


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


def a_name_too_long(tmp_path: Path) -> Path:
    return tmp_path / ("x" * 300)


@pytest.mark.parametrize("place", [below_a_file, in_proc, a_pipe, a_device, a_folder_in_use, a_name_too_long])
def test_a_cache_that_cannot_be_made_is_done_without(place: Callable[[Path], Path], tmp_path: Path) -> None:
    path = place(tmp_path)
    before = sorted(tmp_path.rglob("*"))
    with cache_warnings(1) as messages, Store.open(path) as store:
        store.put_many(TEN)
        assert store.get_many(TEN) == {}
    assert "going on without cache" in messages[0]
    assert keeps_nothing(store)
    assert sorted(tmp_path.rglob("*")) == before


@pytest.fixture
def public() -> Iterator[Path]:
    """A folder that other users can reach, unlike those of pytest."""
    with tempfile.TemporaryDirectory() as name:
        os.chmod(name, 0o755)
        yield Path(name)


def test_a_folder_without_permission_is_done_without(public: Path) -> None:
    os.chmod(public, 0o555)
    assert finish(start("nobody", public / "cache.sqlite3")) == ["found 0", "warnings 1"]
    assert list(public.iterdir()) == []


def test_a_file_without_permission_to_write_is_left_as_it_is(public: Path) -> None:
    path = public / "cache.sqlite3"
    with Store.open(path) as store:
        store.put_many(TEN)
    os.chmod(path, 0o444)
    os.chmod(public, 0o555)
    before = path.read_bytes()
    assert finish(start("nobody", path)) == ["found 0", "warnings 1"]
    assert path.read_bytes() == before


@pytest.mark.parametrize("size", [0, 5_000, 60_000])
def test_a_full_disk_is_done_without(size: int, path: Path) -> None:
    assert finish(start("limited", path, size)) == ["found 0", "warnings 1"]
    with cache_warnings(0), Store.open(path) as store:
        assert store.info().entries == 0
        assert works(store)


def test_a_full_disk_costs_nothing_that_was_there(filled: Path) -> None:
    assert finish(start("limited", filled, 60_000)) == ["found 0", "warnings 1"]
    with cache_warnings(0), Store.open(filled) as store:
        assert store.get_many(items(range(300))) == items(range(300))
    assert aside(filled) == []
