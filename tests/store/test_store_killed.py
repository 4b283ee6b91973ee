"""Stores whose processes are killed."""

import contextlib
import random
import sqlite3
import time
from pathlib import Path

import pytest

from disting.store.store import Store
from tests.store.store_tools import aside, cache_warnings, first_line, start, stop, works
from tests.store.store_worker import items


@pytest.mark.full
@pytest.mark.parametrize("times", [3, pytest.param(30, marks=pytest.mark.slow)])
def test_nothing_committed_is_lost_when_the_process_is_killed_again_and_again(
    path: Path, times: int
) -> None:
    chance, committed = random.Random(5), 0
    for _ in range(times):
        worker = start("count", path)
        first = int(first_line(worker).removeprefix("from "))
        time.sleep(chance.uniform(0, 0.06))
        lines = stop(worker)
        # One more may have been committed just before it could be printed.
        assert first in (committed, committed + 1)
        assert lines == [f"done {number}" for number in range(first, first + len(lines))]
        committed = first + len(lines)
        with cache_warnings(0), Store.open(path) as store:
            assert store.get_many(items(range(committed))) == items(range(committed))
        with contextlib.closing(sqlite3.connect(path)) as connection:
            assert connection.execute("PRAGMA integrity_check").fetchall() == [("ok",)]
    assert committed > times
    assert aside(path) == []


@pytest.mark.full
@pytest.mark.parametrize("times", [3, pytest.param(20, marks=pytest.mark.slow)])
def test_a_kill_while_the_file_is_made_leaves_nothing_half_made(path: Path, times: int) -> None:
    chance = random.Random(6)
    for _ in range(times):
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
