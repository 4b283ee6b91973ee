"""One store of many processes, threads and forks."""

import contextlib
import gc
import os
import random
import signal
import threading
import warnings
from collections.abc import Callable
from pathlib import Path

import pytest

from disting.store.store import Store
from tests.store.store_tools import (
    LONG,
    TEN,
    alter,
    aside,
    cache_warnings,
    finish,
    first_line,
    keeps_nothing,
    start,
    stop,
    works,
)
from tests.store.store_worker import items, key, value


@pytest.mark.full
@pytest.mark.parametrize(
    ("number", "rounds"), [(3, 30), pytest.param(8, 200, marks=pytest.mark.slow)]
)
@pytest.mark.parametrize("journal", ["wal", "delete"])
def test_many_processes_share_the_same_keys(
    journal: str, path: Path, number: int, rounds: int
) -> None:
    if journal == "delete":  # as it is where a write-ahead log is impossible
        Store.open(path).close()
        alter(path, "PRAGMA journal_mode = DELETE")
    workers = [start("share", path, seed, rounds) for seed in range(number)]
    assert [finish(worker) for worker in workers] == [["wrong 0", "warnings 0"]] * number
    with cache_warnings(0), Store.open(path) as store:
        found = store.get_many(items(range(200)))
        assert len(found) > 120 and found.items() <= items(range(200)).items()
    assert aside(path) == []


@pytest.mark.full
@pytest.mark.parametrize(
    ("number", "rounds"), [(3, 15), pytest.param(6, 200, marks=pytest.mark.slow)]
)
def test_processes_that_keep_replacing_the_file_do_not_disturb_each_other(
    path: Path, number: int, rounds: int
) -> None:
    workers = [start("churn", path, rounds) for _ in range(number)]
    assert [finish(worker) for worker in workers] == [["wrong 0", "warnings 0"]] * number
    with cache_warnings(0), Store.open(path) as store:
        assert works(store)


@pytest.mark.full
def test_a_write_waits_for_another_process(filled: Path) -> None:
    worker, found = start("hold", filled), []
    assert first_line(worker) == "held\n"
    with Store.open(filled, wait_seconds=LONG) as store:
        waiting = threading.Thread(target=lambda: found.append(works(store)), daemon=True)
        waiting.start()
        waiting.join(0.3)
        assert waiting.is_alive() and found == []
        worker.communicate(b"go on\n")
        join([waiting])
    assert found == [True]


@pytest.mark.full
def test_a_file_locked_for_too_long_is_left_alone(filled: Path) -> None:
    worker = start("hold", filled)
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
        thread.join(LONG)
    assert not any(thread.is_alive() for thread in threads)


@pytest.mark.full
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
    """Run the work in a child of fork; its process number. The exit status tells what it
    returned.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # threads and fork are mixed on purpose
        child = os.fork()
    if child == 0:
        status = 9
        signal.alarm(LONG)  # a deadlock ends as a failure
        with contextlib.suppress(BaseException):
            status = 0 if work() else 1
        os._exit(status)
    return child


@pytest.mark.full
def test_commits_of_a_forked_child_outlive_the_close_of_its_parent(path: Path) -> None:
    """If the child shared SQLite's state with its parent, the parent would delete the log on
    closing.
    """
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
        assert store.get_many(["parent", "child", "later"]) == {
            "parent": "1",
            "child": "2",
            "later": "3",
        }


@pytest.mark.full
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
    children = [
        in_child(lambda: works(store) and "before" in store.get_many(["before"])) for _ in range(12)
    ]
    done.set()
    join(threads)
    assert [os.waitpid(child, 0)[1] for child in children] == [0] * 12
    assert store.get_many(["before"]) == {"before": "1"}
    assert store.get_many(items(range(50))).items() <= items(range(50)).items()
    assert len(store.get_many(items(range(1000, 1010)))) == (0 if memory else 10)
    store.close()


@pytest.mark.full
def test_a_forgotten_store_does_not_live_on_in_the_fork_hooks(path: Path) -> None:
    store = Store.open(path)
    del store
    gc.collect()
    assert not path.with_name(path.name + "-wal").exists()
    assert os.waitpid(in_child(lambda: True), 0)[1] == 0
